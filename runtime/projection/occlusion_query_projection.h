#pragma once

#include <memory>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "runtime/projection/directed_cells.h"
#include "runtime/projection/element_cells.h"
#include "runtime/projection/light_projection.h"
#include "runtime/projection/visible_shares.h"

namespace lightwell {

/// Projection by occlusion queries, as in the paper (WRT section 5.1), for machines whose graphics
/// processor is faster than the processor.
///
/// The share of pixels that pass (see VisibleShares) times the flux of the cell with nothing before
/// it is the flux on it: the solid angle of pixels, which differs fivefold over a face of a cube,
/// is in both counts.
class OcclusionQueryProjection : public LightProjection {
  public:
    /// Keeps a reference to the occluders, which belong to `quads`. The context that the loader
    /// belongs to must be current here, in project(), and at the end.
    OcclusionQueryProjection(const RadianceSpace& space, const std::vector<Quad>& quads,
                             const OccluderTree& occluders, const GlLoader& loader,
                             const OcclusionQueryOptions& options = {});

    void project(const std::vector<Light>& lights, PackedField& direct) override;

    /// Queries in the last projection.
    std::uint64_t queries() const { return queries_; }

  private:
    void add(const Light& light);

    std::vector<ElementCells> cells_;  ///< by element
    int finer_;                        ///< levels that cells are looked at below the finest
    RadianceSpace finer_space_;
    std::vector<ElementCells> finer_cells_;                 ///< by element
    std::vector<std::vector<float>> unoccluded_;            ///< by element and finer cell [lm/cd]
    std::vector<PackedField> flux_;                         ///< scratch, by element
    std::vector<std::unique_ptr<DirectedCells>> directed_;  ///< by element, of glossy ones
    VisibleShares shares_;
    std::uint64_t queries_ = 0;
};

}  // namespace lightwell
