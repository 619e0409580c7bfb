#include "runtime/outgoing/gathered_surfaces.h"

#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

Rgb cell_mean(const Element& element, const Vec3& normal, const Cell& cell,
              const FinalGather& gather, int points) {
    const ParameterRect rect = element.space.tree().rect(cell);
    Rgb sum = Rgb::Zero();
    double open_area = 0;
    for (int i = 0; i < points; ++i)
        for (int j = 0; j < points; ++j) {
            const double u = rect.u0 + (i + 0.5) / points * (rect.u1 - rect.u0);
            const double v = rect.v0 + (j + 0.5) / points * (rect.v1 - rect.v0);
            const Rgb light = gather.irradiance(element.geometry.point(u, v), normal, element.quad);
            if (!(light > 0).any()) continue;
            const double area = element.geometry.jacobian(u, v);
            sum += area * light;
            open_area += area;
        }
    return open_area > 0 ? Rgb(sum / open_area) : Rgb(Rgb::Zero());
}

}  // namespace

std::vector<SmoothSurface> gathered_surfaces(const RadianceSpace& space, const FinalGather& gather,
                                             int points, const std::function<void()>& check) {
    std::vector<SmoothSurface> surfaces;
    surfaces.reserve(space.elements().size());
    for (const Element& element : space.elements()) {
        const CellTree& tree = element.space.tree();
        const Vec3 normal = element.geometry.normal();
        Eigen::Array<double, Eigen::Dynamic, 3> means(tree.functions(), 3);
        tbb::parallel_for(std::uint32_t{0}, tree.functions(), [&](std::uint32_t index) {
            check();
            means.row(index) =
                cell_mean(element, normal, {tree.levels(), index}, gather, points).transpose();
        });
        surfaces.emplace_back(tree, means);
    }
    return surfaces;
}

}  // namespace lightwell
