#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/shadow.h"
#include "runtime/projection/element_cells.h"
#include "runtime/projection/light_projection.h"

namespace lightwell {

struct ShadowProjectionOptions {
    /// Error of the flux on an element that sampling its shadow edges may leave, relative to that
    /// flux; > 0.
    double edge_error = 1e-3;
};

/// What the last projection did.
struct ShadowProjectionReport {
    std::uint64_t lit_cells = 0;   ///< finest cells that see all of a lamp
    std::uint64_t edge_cells = 0;  ///< finest cells that a shadow's edge may run through
    std::uint64_t rays = 0;        ///< from lamps to points where several edges meet
};

/// Projection by looking at the scene from the lamp: shadows first, rays where shadows are not
/// enough.
///
/// An element's cells are looked at coarse to fine, against the shadows of the quads that stand
/// between it and the lamp: a cell that no shadow reaches is lit, one that a single quad covers is
/// dark, and nothing is too thin to be noticed. Where an edge runs through a finest cell the cell
/// is cut along it. Where several do, it is cut in four again and again, until rays, tested against
/// the few quads whose edges run there, may speak for the rest. Lit cells get their flux by Gauss's
/// rule, or exactly if they are near or at the rim of a cone.
///
/// A single ray to every cell would take longer than all of this, and misses what is thinner than
/// their distance.
///
/// Nothing is allocated once the scratch space has grown to what the scene needs.
class ShadowProjection : public LightProjection {
  public:
    /// Keeps a reference to the occluders, which belong to `quads`.
    ShadowProjection(const RadianceSpace& space, std::vector<Quad> quads,
                     const OccluderTree& occluders, const ShadowProjectionOptions& options = {});
    ~ShadowProjection() override;

    void project(const std::vector<Light>& lights, PackedField& direct) override;

    const ShadowProjectionReport& report() const { return report_; }

  private:
    struct Scratch;
    class ElementVisit;

    std::vector<Quad> quads_;
    const OccluderTree& occluders_;
    ShadowProjectionOptions options_;
    std::vector<ElementCells> cells_;           ///< by element
    std::vector<int> quad_of_;                  ///< by element
    std::vector<std::size_t> order_;            ///< elements, largest first
    std::vector<std::vector<Shadow>> shadows_;  ///< by lamp and quad, of this frame
    std::vector<Scratch> scratch_;              ///< by element
    ShadowProjectionReport report_;
};

}  // namespace lightwell
