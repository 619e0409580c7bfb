#include "solver/transport/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

namespace {

/// Polygons farther apart than this many times the sum of their reaches are integrated by points.
constexpr double far_ratio = 8;

/// Eight-point Gauss-Legendre rule on [0,1]: half of its symmetric nodes and weights.
constexpr std::array<double, 8> gauss_node = {
    0.019855071751231884, 0.10166676129318664, 0.23723379504183551, 0.40828267875217511,
    0.59171732124782489,  0.76276620495816449, 0.89833323870681336, 0.98014492824876812};
constexpr std::array<double, 8> gauss_weight = {
    0.050614268145188130, 0.11119051722668724, 0.15685332293894364, 0.18134189168918099,
    0.18134189168918099,  0.15685332293894364, 0.11119051722668724, 0.050614268145188130};

/// Sixteen-point Gauss-Legendre rule on [0,1].
constexpr std::array<double, 16> fine_node = {
    0.0052995325041750333, 0.02771248846338371, 0.067184398806084122, 0.12229779582249849,
    0.19106187779867811,   0.27099161117138632, 0.35919822461037054,  0.45249374508118129,
    0.54750625491881877,   0.64080177538962946, 0.72900838882861374,  0.80893812220132189,
    0.87770220417750155,   0.93281560119391582, 0.9722875115366163,   0.99470046749582497};
constexpr std::array<double, 16> fine_weight = {
    0.013576229705877048, 0.031126761969323947, 0.047579255841246393, 0.062314485627766938,
    0.074797994408288368, 0.084578259697501268, 0.091301707522461792, 0.094725305227534251,
    0.094725305227534251, 0.091301707522461792, 0.084578259697501268, 0.074797994408288368,
    0.062314485627766938, 0.047579255841246393, 0.031126761969323947, 0.013576229705877048};

/// Antiderivative in u of ln sqrt(u^2 + h^2).
double log_distance(double u, double h) {
    const double square = u * u + h * h;
    if (square == 0) return 0;
    const double angle = h == 0 ? 0 : h * std::atan(u / h);
    return 0.5 * u * std::log(square) - u + angle;
}

/// Antiderivative in u of log_distance(u, h).
double twice_log_distance(double u, double h) {
    const double square = u * u + h * h;
    if (square == 0) return 0;
    const double angle = h == 0 ? 0 : h * u * std::atan(u / h);
    return 0.25 * (u * u - h * h) * std::log(square) - 0.75 * u * u + angle;
}

struct Edge {
    Vec3 from;
    Vec3 unit;
    double length;
};

/// Int_0^b ln |x - (from + t unit)| dt.
double log_potential(const Vec3& x, const Edge& edge) {
    const Vec3 rest = x - edge.from;
    const double along = rest.dot(edge.unit);
    const double height = (rest - along * edge.unit).norm();
    return log_distance(edge.length - along, height) - log_distance(-along, height);
}

/// Int Int ln |x - y| ds dt over two parallel edges, in closed form.
double over_parallel_edges(const Edge& a, const Edge& b, double cosine) {
    const Vec3 rest = a.from - b.from;
    const double along = rest.dot(b.unit);
    const double height = (rest - along * b.unit).norm();
    // The point a.from + s a.unit projects to along + sigma s on b's line.
    const double sigma = cosine > 0 ? 1 : -1;
    const double start = along, end = along + sigma * a.length;
    // The inner integral is log_distance(b - c) + log_distance(c), which is odd in its argument, at
    // c = start + sigma s.
    const auto antiderivative = [&](double c) {
        return twice_log_distance(c, height) - twice_log_distance(b.length - c, height);
    };
    return sigma * (antiderivative(end) - antiderivative(start));
}

/// Int Int ln |x - y| ds dt over two edges that are not parallel: the inner integral in closed
/// form, the outer by Gauss between the places where the inner one bends sharply, with nodes drawn
/// towards them (s -> 3s^2 - 2s^3 turns an end behaviour s ln s into one that the rule integrates
/// to rounding).
double over_skew_edges(const Edge& a, const Edge& b) {
    const Vec3 middle_gap = (a.from + 0.5 * a.length * a.unit) - (b.from + 0.5 * b.length * b.unit);
    if (middle_gap.squaredNorm() > 4 * (a.length + b.length) * (a.length + b.length)) {
        double sum = 0;
        for (std::size_t k = 0; k < gauss_node.size(); ++k)
            sum += gauss_weight[k] * log_potential(a.from + gauss_node[k] * a.length * a.unit, b);
        return sum * a.length;
    }
    // Closest approach of the two lines, and the projections of b's ends on a.
    const double cosine = a.unit.dot(b.unit);
    const Vec3 rest = a.from - b.from;
    const double closest =
        (cosine * rest.dot(b.unit) - rest.dot(a.unit)) / std::max(1e-300, 1 - cosine * cosine);
    std::array<double, 5> stop = {0, closest, -rest.dot(a.unit),
                                  -rest.dot(a.unit) + b.length * cosine, a.length};
    for (double& s : stop)
        s = std::clamp(s, 0.0, a.length);
    std::sort(stop.begin(), stop.end());
    double sum = 0;
    for (std::size_t piece = 0; piece + 1 < stop.size(); ++piece) {
        const double width = stop[piece + 1] - stop[piece];
        if (width <= 1e-9 * a.length) continue;
        for (std::size_t k = 0; k < fine_node.size(); ++k) {
            const double w = fine_node[k];
            const double s = stop[piece] + width * w * w * (3 - 2 * w);
            sum += fine_weight[k] * width * 6 * w * (1 - w) * log_potential(a.from + s * a.unit, b);
        }
    }
    return sum;
}

using Edges = std::array<Edge, ConvexPolygon::capacity>;

int edges_of(const ConvexPolygon& polygon, const Vec3& origin, double scale, Edges& edges) {
    int n = 0;
    for (int i = 0; i < polygon.size(); ++i) {
        const Vec3 way = (polygon.after(i) - polygon[i]) / scale;
        const double length = way.norm();
        if (length > 0) edges[n++] = {(polygon[i] - origin) / scale, way / length, length};
    }
    return n;
}

/// Points [m] and their weights [m2]: three for every triangle of a fan.
struct Quadrature {
    static constexpr int capacity = 3 * (ConvexPolygon::capacity - 2);

    std::array<Vec3, capacity> point;
    std::array<double, capacity> weight;
    int size = 0;

    void append(const Vec3& at, double area) {
        point[size] = at;
        weight[size++] = area;
    }
};

/// A rule of degree 3 on a quad, of degree 2 on other polygons.
Quadrature quadrature(const ConvexPolygon& polygon) {
    Quadrature rule;
    if (polygon.size() == 4) {
        const Quad quad{{polygon[0], polygon[1], polygon[2], polygon[3]}};
        constexpr double low = 0.21132486540518713, high = 0.78867513459481287;
        for (const double v : {low, high})
            for (const double u : {low, high})
                rule.append(quad.point(u, v), 0.25 * quad.jacobian(u, v));
        return rule;
    }
    for (int i = 2; i < polygon.size(); ++i) {
        const std::array<Vec3, 3> corner = {polygon[0], polygon[i - 1], polygon[i]};
        const double area = 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        for (int k = 0; k < 3; ++k)
            rule.append((4 * corner[k] + corner[(k + 1) % 3] + corner[(k + 2) % 3]) / 6, area / 3);
    }
    return rule;
}

}  // namespace

double kernel(const Vec3& x, const Vec3& normal_x, const Vec3& y, const Vec3& normal_y) {
    const Vec3 way = y - x;
    const double height_x = way.dot(normal_x), height_y = -way.dot(normal_y);
    if (height_x <= 0 || height_y <= 0) return 0;
    const double square = way.squaredNorm();
    return height_x * height_y / (M_PI * square * square);
}

double exchange_area_by_contour(const Facet& x, const Facet& y) {
    // Lengths are measured in units of the pair's size: ln r then has no large constant part to
    // cancel.
    const Vec3 origin = x.centre();
    const double scale = x.reach() + y.reach() + (y.centre() - origin).norm();
    Edges edge_x, edge_y;
    const int nx = edges_of(x, origin, scale, edge_x), ny = edges_of(y, origin, scale, edge_y);
    double sum = 0;
    for (int i = 0; i < nx; ++i) {
        for (int j = 0; j < ny; ++j) {
            const double cosine = edge_x[i].unit.dot(edge_y[j].unit);
            if (std::abs(cosine) < 1e-15) continue;
            const bool parallel = std::abs(cosine) > 1 - 1e-13;
            sum += cosine * (parallel ? over_parallel_edges(edge_x[i], edge_y[j], cosine)
                                      : over_skew_edges(edge_x[i], edge_y[j]));
        }
    }
    return std::max(0.0, sum * scale * scale / (2 * M_PI));
}

double exchange_area_by_points(const Facet& x, const Facet& y) {
    const Quadrature rule_x = quadrature(x), rule_y = quadrature(y);
    double sum = 0;
    for (int i = 0; i < rule_x.size; ++i) {
        double inner = 0;
        for (int j = 0; j < rule_y.size; ++j)
            inner +=
                rule_y.weight[j] * kernel(rule_x.point[i], x.normal, rule_y.point[j], y.normal);
        sum += rule_x.weight[i] * inner;
    }
    return sum;
}

double exchange_area(const Facet& x, const Facet& y) {
    const double distance = (y.centre() - x.centre()).norm();
    return distance > far_ratio * (x.reach() + y.reach()) ? exchange_area_by_points(x, y)
                                                          : exchange_area_by_contour(x, y);
}

}  // namespace lightwell
