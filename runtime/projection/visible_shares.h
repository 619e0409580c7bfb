#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/scene/occluder_tree.h"
#include "runtime/projection/element_cells.h"
#include "runtime/projection/lamp_depth.h"

namespace lightwell {

struct OcclusionQueryOptions {
    int side = 1024;  ///< of a view [pixels]
    /// Cells of fewer pixels are not looked at more closely.
    std::uint32_t fewest_pixels = 12;
    /// Share of the flux on an element that its pixels may leave open, before it gets a view of its
    /// own.
    double error = 1e-3;
    /// Views that an element may get, each of what the last one has found to be lit.
    int most_looks = 3;
    /// Levels below the finest cells that are looked at where the light on a cell is uneven; in
    /// large scenes as many of them as there is room for.
    int finer_levels = 2;
};

/// How much a lamp sees of the cells of all elements, by occlusion queries.
///
/// First the scene is drawn from the lamp into a cube of depth buffers. Then the elements that face
/// the lamp and have something before them are drawn against it, their cells coarse to fine, all of
/// one level in one batch: a query counts the pixels that a cell covers, and another those that
/// pass. Where all pass or none does a cell is lit or dark, else its children are asked. So the
/// level of precision follows from what a quad takes up of the lamp's sky.
///
/// A shadow's edge that runs along pixels is off by up to half of one. Where that may be too much
/// of the flux on an element, the element is looked at once more, in a view that it fills, or in
/// parts, if the lamp is near; and if it is mostly dark, in one that its lit part fills.
class VisibleShares {
  public:
    /// Keeps references to the cells, by element, and to the occluders, which belong to `quads`.
    /// The context that the loader belongs to must be current here, in find(), and at the end.
    /// @param finer  so many of the cells' levels, the finest ones, are looked at only where the
    ///               light on a cell is uneven
    VisibleShares(const RadianceSpace& space, const std::vector<ElementCells>& cells, int finer,
                  const std::vector<Quad>& quads, const OccluderTree& occluders,
                  const GlLoader& loader, const OcclusionQueryOptions& options);

    /// @param lamp  where it stands [m]
    /// @param flux  by element and finest cell, with nothing before it, in any unit
    void find(const Vec3& lamp, const std::vector<std::vector<float>>& flux);

    /// Visible share, by finest cell.
    const std::vector<float>& of(std::size_t element) const { return looked_at_[element].share; }

    /// Queries since the last call.
    std::uint64_t take_queries();

  private:
    struct Pending {
        std::size_t element;
        Cell cell;
        float share;  ///< of its parent
        int view;
    };
    struct Closer {
        std::size_t element;
        ParameterRect rect;
        LampView view;
    };
    struct LookedAt {
        std::vector<float> share;          ///< by finest cell
        std::vector<std::uint32_t> mixed;  ///< pixels of the cell that it was counted in, else 0
        std::uint64_t pixels = 0;          ///< of all that was looked at
        ParameterRect rect{0, 1, 0, 1};    ///< what was looked at
    };

    static std::vector<Quad> parts_of(const RadianceSpace& space);
    static std::vector<int> quads_of(const RadianceSpace& space);
    bool has_something_before(std::size_t element, const Vec3& lamp);
    void look_round(const Vec3& lamp);
    void look_closer(const Vec3& lamp, const std::vector<std::size_t>& elements);
    void plan(const Vec3& lamp, std::size_t element, const ParameterRect& rect, int halvings);
    void add_cells_within(const ParameterRect& rect, const Cell& cell, const Pending& like);
    void look_at_level();
    void settle(const Pending& pending, const CountedPart& seen);
    bool is_worth_splitting(std::size_t element, const Cell& cell) const;
    void fill(std::size_t element, const Cell& cell, float share, std::uint32_t mixed);
    double lit_flux(std::size_t element, const std::vector<float>& flux) const;
    bool is_uncertain(std::size_t element, const std::vector<float>& flux, double all) const;
    /// What is lit and the cells about it.
    ParameterRect lit_rect(std::size_t element) const;

    OcclusionQueryOptions options_;
    const std::vector<ElementCells>& cells_;
    int finer_;
    const std::vector<std::vector<float>>* flux_ = nullptr;  ///< of the call to find()
    std::vector<double> whole_flux_;                         ///< by element, of the call to find()
    const OccluderTree& occluders_;
    std::vector<Quad> geometry_;             ///< by element
    std::vector<int> quad_;                  ///< by element
    std::vector<std::uint32_t> first_part_;  ///< by element: its cells of all levels are parts
    std::vector<LookedAt> looked_at_;        ///< by element
    std::vector<int> before_;                ///< scratch
    std::vector<std::size_t> uncertain_;     ///< scratch
    std::vector<Closer> closer_;             ///< scratch
    std::vector<LampView> views_;            ///< scratch
    std::vector<Pending> level_, next_;      ///< scratch
    std::vector<CountedPart> counted_;       ///< scratch
    LampDepth depth_;
    std::uint64_t queries_ = 0;
};

}  // namespace lightwell
