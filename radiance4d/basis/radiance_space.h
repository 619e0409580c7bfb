#pragma once

#include <cstdint>
#include <vector>

#include "radiance4d/basis/haar.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// Which part of a finest cell light can reach: 8 x 8 samples, bit 8 j + i for the sample at ((i +
/// .5)/8, (j + .5)/8) of the cell's parameters. The rest is buried under something that stands on
/// the surface or almost touches it.
using OpenMask = std::uint64_t;
constexpr OpenMask all_open = ~OpenMask{0};

/// One side of a quad that takes part in transport, with its own basis b = b_space * b_angle: the
/// standard construction between two 2D trees (every spatial function with every angular one).
struct Element {
    int quad = 0;       ///< index into Scene::quads
    bool front = true;  ///< which side of it
    Quad geometry;      ///< the quad as seen from this side: the normal points to the air
    HaarBasis space;    ///< over (u,v)
    CellTree angle;     ///< over (s,t); one cell on diffuse surfaces
    /// By finest cell; empty where nothing is buried. The space's areas are those of the open
    /// parts.
    std::vector<OpenMask> open;
    std::uint32_t first = 0;  ///< number of the element's first basis function in the space

    /// Basis functions of the element.
    std::uint32_t functions() const { return space.tree().functions() * angle.functions(); }
    double area() const { return space.area(Cell{}); }
    /// The polygon of a spatial cell.
    Quad cell(const Cell& cell) const;
    /// Whether light can reach the point (u,v): its bit of the mask.
    bool is_sample_open(double u, double v) const;
    /// Sets `space` for a tree and `open` masks (or none).
    void set_space(const CellTree& tree, std::vector<OpenMask> masks);
};

/// The finite-dimensional space that radiance fields live in: the orthonormal functions of all
/// elements, one after the other. Within an element, function = spatial function * (number of
/// angular functions) + angular function.
class RadianceSpace {
  public:
    RadianceSpace() = default;
    /// Elements in the given order; their `first` is set here.
    explicit RadianceSpace(std::vector<Element> elements);

    const std::vector<Element>& elements() const { return elements_; }
    const Element& element(std::size_t e) const { return elements_[e]; }
    /// Number of basis functions.
    std::uint32_t functions() const { return functions_; }
    /// Element that a basis function belongs to.
    std::size_t element_of(std::uint32_t function) const;
    /// Element on a side of a quad; -1 where that side takes no part.
    int element_on(int quad, bool front) const;
    /// Sum of the elements' areas [m2].
    double area() const { return area_; }

  private:
    std::vector<Element> elements_;
    std::vector<int> by_side_;  // 2 * quad + (front ? 0 : 1) -> element or -1
    std::uint32_t functions_ = 0;
    double area_ = 0;
};

/// Whether any element has angular functions.
bool has_angles(const RadianceSpace& space);

}  // namespace lightwell
