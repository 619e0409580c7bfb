#pragma once

#include <memory>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "runtime/projection/cube_depth.h"
#include "runtime/projection/directed_cells.h"
#include "runtime/projection/element_cells.h"
#include "runtime/projection/light_projection.h"

namespace lightwell {

struct OcclusionQueryOptions {
    int side = 1024;  ///< of a face of the cube [pixels]
    /// Cells of fewer pixels are not looked at more closely.
    std::uint32_t fewest_pixels = 12;
};

/// Projection by occlusion queries, as in the paper (WRT section 5.1), for machines whose graphics
/// processor is faster than the processor.
///
/// The scene is drawn from the lamp into a cube of depth buffers. Then the elements that face the
/// lamp are drawn against it, their cells coarse to fine, all of one level in one batch: a query
/// counts the pixels that a cell covers, and another those that pass. Where all pass or none does a
/// cell is lit or dark, else its children are asked. So the level of precision follows from what a
/// quad takes up of the lamp's sky. The share of pixels that pass times the flux of the cell with
/// nothing before it is the flux on it: the solid angle of pixels, which differs fivefold over a
/// face, is in both counts.
class OcclusionQueryProjection : public LightProjection {
  public:
    /// The context that the loader belongs to must be current here, in project(), and at the end.
    OcclusionQueryProjection(const RadianceSpace& space, const std::vector<Quad>& quads,
                             const GlLoader& loader, const OcclusionQueryOptions& options = {});

    void project(const std::vector<Light>& lights, PackedField& direct) override;

    /// Queries in the last projection.
    std::uint64_t queries() const { return queries_; }

  private:
    struct Pending {
        std::size_t element;
        Cell cell;
        float share;  ///< of its parent
    };

    static std::vector<Quad> parts_of(const RadianceSpace& space);
    static std::vector<int> quads_of(const RadianceSpace& space);
    void find_shares(const Light& light);
    void look_at(const std::vector<Pending>& level, std::vector<Pending>& next);

    OcclusionQueryOptions options_;
    std::vector<ElementCells> cells_;        ///< by element
    std::vector<std::uint32_t> first_part_;  ///< by element: its cells of all levels are parts
    std::vector<std::vector<float>> share_;  ///< visible share, by element and finest cell
    std::vector<PackedField> flux_;          ///< scratch, by element
    std::vector<std::unique_ptr<DirectedCells>> directed_;  ///< by element, of glossy ones
    std::vector<Pending> level_, next_;                     ///< scratch
    std::vector<CountedPart> counted_;                      ///< scratch
    CubeDepth depth_;
    std::uint64_t queries_ = 0;
};

}  // namespace lightwell
