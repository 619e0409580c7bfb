#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/plane_quads.h"
#include "runtime/projection/lamp_view.h"

namespace lightwell {

/// A part of a scene, to be counted by the pixels that a lamp sees of it.
struct CountedPart {
    static constexpr int all_views = -1;

    std::uint32_t part = 0;     ///< index into LampDepth's parts
    int view = all_views;       ///< the only one that it is counted in
    std::uint32_t all = 0;      ///< pixels that it covers, seen from the lamp
    std::uint32_t visible = 0;  ///< those with nothing before them
};

/// What a lamp sees, as the depth buffers of up to six views (of a cube, or of single quads looked
/// at more closely), and occlusion queries against them (WRT section 5.1). The views lie side by
/// side in one depth buffer.
///
/// The context that the loader belongs to must be current whenever a method is called, and at the
/// end. Every method leaves framebuffer 0 and no program or vertex array bound.
class LampDepth {
  public:
    static constexpr std::size_t most_views = 6;

    /// @param quads  what hides
    /// @param parts  what can be counted: parts of those quads, and `quad_of` says of which each
    /// @param side   of a view [pixels]
    /// @throws SystemError if OpenGL lacks a function, or memory, or does not accept the shaders.
    LampDepth(const std::vector<Quad>& quads, const std::vector<Quad>& parts,
              const std::vector<int>& quad_of, int side, const GlLoader& loader);
    ~LampDepth();
    LampDepth(const LampDepth&) = delete;
    LampDepth& operator=(const LampDepth&) = delete;

    /// Draws all quads as seen from a lamp. Surfaces nearer than a hundred-thousandth of the
    /// scene's extent are not seen.
    /// @param views  at most six
    void look_from(const Vec3& lamp, const std::vector<LampView>& views);

    /// Counts the pixels of parts, by queries that are all issued before the first is read.
    /// @return how many queries it took
    std::size_t count(std::vector<CountedPart>& parts);

  private:
    struct Query {
        std::size_t counted;  ///< index into the parts being counted
        std::size_t quad;     ///< of those drawn
    };

    void begin(bool counts_hidden, bool is_depth_kept);
    void end() const;
    /// @param nearness  by how much more than 1 all is drawn nearer than it is
    void select_view(std::size_t view, float nearness);
    bool reaches(std::uint32_t part, std::size_t view) const;
    void issue(const std::vector<Query>& queries, std::size_t first_name);

    GlFunctions gl_;
    int side_;
    Vec3 centre_;    ///< the origin of what is drawn
    double extent_;  ///< of the scene [m]
    std::size_t occluder_count_;
    std::vector<Quad> parts_;
    GlObject program_;
    PlaneQuads drawn_;  ///< what hides, then the parts
    GlObject framebuffer_, depth_;
    std::vector<unsigned> names_;                         ///< of query objects
    std::array<std::vector<Query>, most_views> queries_;  ///< scratch, by view
    std::vector<LampView> views_;
    Vec3 lamp_ = Vec3::Zero();  ///< from the centre
};

}  // namespace lightwell
