#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// A part of a scene, to be counted by the pixels that a lamp sees of it.
struct CountedPart {
    std::uint32_t part = 0;     ///< index into CubeDepth's parts
    std::uint32_t all = 0;      ///< pixels that it covers, seen from the lamp
    std::uint32_t visible = 0;  ///< those with nothing before them
};

/// What a lamp sees, as the depth buffers of a cube map, and occlusion queries against it (WRT
/// section 5.1). The six faces lie side by side in one depth buffer.
///
/// The context that the loader belongs to must be current whenever a method is called, and at the
/// end. Every method leaves framebuffer 0 and no program or vertex array bound.
class CubeDepth {
  public:
    /// @param quads  what hides
    /// @param parts  what can be counted: parts of those quads, and `quad_of` says of which each
    /// @param side   of a face [pixels]
    /// @throws SystemError if OpenGL lacks a function, or memory, or does not accept the shaders.
    CubeDepth(const std::vector<Quad>& quads, const std::vector<Quad>& parts,
              const std::vector<int>& quad_of, int side, const GlLoader& loader);
    ~CubeDepth();
    CubeDepth(const CubeDepth&) = delete;
    CubeDepth& operator=(const CubeDepth&) = delete;

    /// Draws all quads as seen from a lamp. Surfaces nearer than a hundred-thousandth of the
    /// scene's extent are not seen.
    void look_from(const Vec3& lamp);

    /// Counts the pixels of parts, by queries that are all issued before the first is read.
    /// @return how many queries it took
    std::size_t count(std::vector<CountedPart>& parts);

    /// All pixels of the six faces.
    double pixels() const { return 6.0 * side_ * side_; }

  private:
    struct Query {
        std::size_t counted;  ///< index into the parts being counted
        unsigned first;       ///< index of the element to draw
    };

    void begin(bool counts_hidden, bool is_depth_kept);
    void end() const;
    /// @param nearness  by how much more than 1 all is drawn nearer than it is
    void select_face(int face, float nearness);
    bool reaches_face(std::uint32_t part, int face) const;
    void issue(const std::vector<Query>& queries, std::size_t first_name);

    GlFunctions gl_;
    int side_;
    Vec3 centre_;    ///< the origin of what is drawn
    double extent_;  ///< of the scene [m]
    unsigned occluder_count_;
    std::vector<Quad> parts_;
    GlObject program_, vertex_array_, vertices_, elements_, framebuffer_, depth_;
    std::vector<unsigned> names_;                ///< of query objects
    std::array<std::vector<Query>, 6> queries_;  ///< scratch, by face
    Vec3 lamp_ = Vec3::Zero();                   ///< from the centre
};

}  // namespace lightwell
