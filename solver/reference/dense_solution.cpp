#include "solver/reference/dense_solution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>
#include <tbb/parallel_for.h>

#include "solver/reference/light_sources.h"

namespace lightwell {

namespace {

/// A column per channel.
using Channels = Eigen::MatrixX3d;

Channels columns_of(const std::vector<Rgb>& values) {
    Channels result(static_cast<Eigen::Index>(values.size()), 3);
    for (std::size_t k = 0; k < values.size(); ++k)
        result.row(static_cast<Eigen::Index>(k)) = values[k].matrix().transpose();
    return result;
}

std::vector<Rgb> colours_of(const Channels& columns) {
    std::vector<Rgb> result;
    for (Eigen::Index k = 0; k < columns.rows(); ++k)
        result.emplace_back(columns.row(k).transpose().array());
    return result;
}

/// Mean of a function over a cell, by area.
template <typename Value, typename Function>
Value mean_over(const Quad& cell, double area, const GaussRule& rule, Value sum,
                const Function& function) {
    for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
            const double u = rule.nodes[i], v = rule.nodes[j];
            const double weight = rule.weights[i] * rule.weights[j] * cell.jacobian(u, v) / area;
            sum += weight * function(cell.point(u, v));
        }
    return sum;
}

}  // namespace

DenseSolution::DenseSolution(const Scene& scene, const Visibility& visibility,
                             const std::vector<QuadSide>& sides, const DenseMesh& mesh)
    : scene_(scene),
      visibility_(visibility),
      visibility_points_(mesh.visibility_points),
      rule_(mesh.receiver_points),
      lamp_points_(mesh.lamp_points) {
    const double width = 1.0 / mesh.cells;
    for (const QuadSide& side : sides) {
        const Quad& front = scene.quads[static_cast<std::size_t>(side.quad)].quad;
        const Quad whole = side.front ? front : front.reversed();
        for (int v = 0; v < mesh.cells; ++v)
            for (int u = 0; u < mesh.cells; ++u) {
                const Quad shape =
                    whole.part(u * width, (u + 1) * width, v * width, (v + 1) * width);
                cells_.push_back({side, shape, shape.area()});
            }
    }
    const auto count = static_cast<Eigen::Index>(cells_.size());
    factors_.setZero(count, count);
    tbb::parallel_for(Eigen::Index{0}, count, [&](Eigen::Index i) {
        for (Eigen::Index j = 0; j < count; ++j)
            factors_(i, j) =
                factor(cells_[static_cast<std::size_t>(i)], cells_[static_cast<std::size_t>(j)]);
    });
    // Both directions of a pair were integrated; reciprocity says that they are one number.
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < i; ++j) {
            const double area_i = cells_[static_cast<std::size_t>(i)].area;
            const double area_j = cells_[static_cast<std::size_t>(j)].area;
            const double exchange = 0.5 * (area_i * factors_(i, j) + area_j * factors_(j, i));
            factors_(i, j) = exchange / area_i;
            factors_(j, i) = exchange / area_j;
        }
}

double DenseSolution::factor(const DenseCell& to, const DenseCell& from) const {
    if (to.side.quad == from.side.quad) return 0;
    const Vec3 normal = to.shape.normal();
    const Vec3 sender_normal = from.shape.normal();
    return mean_over(to.shape, to.area, rule_, 0.0, [&](const Vec3& point) {
        if (sender_normal.dot(point - from.shape.vertex[0]) <= 0) return 0.0;
        const double whole = point_to_quad_factor(point, normal, from.shape);
        return whole > 0 ? whole * visible_share(point, to, from) : 0.0;
    });
}

double DenseSolution::visible_share(const Vec3& point, const DenseCell& to,
                                    const DenseCell& from) const {
    const int n = visibility_points_;
    if (n == 0) return 1;
    const Vec3 normal = to.shape.normal();
    const Vec3 sender_normal = from.shape.normal();
    double all = 0, seen = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = (i + 0.5) / n, v = (j + 0.5) / n;
            const Vec3 target = from.shape.point(u, v);
            const Vec3 way = target - point;
            const double cosines =
                std::max(0.0, normal.dot(way)) * std::max(0.0, -sender_normal.dot(way));
            const double weight =
                cosines * from.shape.jacobian(u, v) / (way.squaredNorm() * way.squaredNorm());
            if (weight == 0) continue;
            all += weight;
            if (!visibility_.occluded(point, to.side.quad, target, from.side.quad)) seen += weight;
        }
    return all > 0 ? seen / all : 0;
}

std::vector<Rgb> DenseSolution::from_lamps(const std::vector<Light>& lights) const {
    const GaussRule rule(lamp_points_);
    std::vector<Rgb> result;
    for (const DenseCell& cell : cells_) {
        const Vec3 normal = cell.shape.normal();
        const auto arriving = [&](const Vec3& point) -> Rgb {
            Rgb sum = Rgb::Zero();
            for (const Light& light : lights) {
                const Vec3 way = position_of(light) - point;
                const double distance = way.norm();
                if (normal.dot(way) <= 0 ||
                    visibility_.occluded(point, cell.side.quad, position_of(light), free_point))
                    continue;
                sum += intensity_towards(light, -way / distance) * normal.dot(way) /
                       (distance * distance * distance);
            }
            return sum;
        };
        result.push_back(mean_over(cell.shape, cell.area, rule, Rgb(Rgb::Zero()), arriving));
    }
    return result;
}

std::vector<Rgb> DenseSolution::from_emitters() const {
    std::vector<Rgb> exitance;
    for (const DenseCell& cell : cells_)
        exitance.push_back(M_PI *
                           emitted_from(scene_.material_of(cell.side.quad), cell.side.front));
    return colours_of(factors_ * columns_of(exitance));
}

std::vector<Rgb> DenseSolution::indirect(const std::vector<Rgb>& direct) const {
    const Channels known = columns_of(direct);
    Channels result(known.rows(), 3);
    for (int channel = 0; channel < 3; ++channel) {
        Eigen::VectorXd albedo(known.rows());
        for (std::size_t k = 0; k < cells_.size(); ++k)
            albedo[static_cast<Eigen::Index>(k)] =
                albedo_of(scene_.material_of(cells_[k].side.quad), cells_[k].side.front)[channel];
        const Eigen::MatrixXd reflected = factors_ * albedo.asDiagonal();
        const Eigen::MatrixXd system =
            Eigen::MatrixXd::Identity(known.rows(), known.rows()) - reflected;
        result.col(channel) = system.partialPivLu().solve(reflected * known.col(channel));
    }
    return colours_of(result);
}

}  // namespace lightwell
