#include "radiance4d/scene/light_flux.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "radiance4d/scene/form_factor.h"

// A spot's intensity I depends on c = cos(angle to the axis) alone. With the azimuth phi about the
// axis, dw = -dc dphi, and by Green's theorem the flux through a spherical polygon is the integral
// of G(c) dphi along its boundary, counter-clockwise about its inside seen from outside the sphere,
// where G(c) = Int_c^1 I, provided the polygon does not hold the point c = -1, where G is not 0.
// If it does, G(c) - G(-1) takes the place of G(c), provided that it does not hold c = 1.
//
// On the great circle of an edge let s be the angle from its point nearest to the axis. Then
// c = cos b cos s and dphi = k ds / (1 - c^2), where k = +-sin b is the cosine between the axis and
// the normal of the circle's plane. G is 1 - c inside the inner cone and constant outside the outer
// one, which gives closed forms; on the ring between, the integrand is analytic and Gauss's rule on
// panels shorter than the distance to its poles s = +-i b is exact to rounding.

namespace lightwell {

namespace {

/// Intensity of a spot, relative to that on the axis, and its integral G.
class Profile {
  public:
    explicit Profile(const SpotLight& spot)
        : inner_(std::cos(spot.inner_angle * M_PI / 180)),
          outer_(std::cos(spot.outer_angle * M_PI / 180)) {}

    double inner() const { return inner_; }
    double outer() const { return outer_; }
    /// G on the ring outer <= c <= inner: 1 - inner + Int_c^inner (3t^2 - 2t^3).
    double on_ring(double c) const {
        const double width = inner_ - outer_;
        const double t = width > 0 ? std::clamp((c - outer_) / width, 0.0, 1.0) : 0;
        return 1 - inner_ + width * (0.5 - t * t * t * (1 - 0.5 * t));
    }
    /// G beyond the outer cone: the flux of the whole light over 2 pi.
    double total() const { return 1 - inner_ + 0.5 * (inner_ - outer_); }

  private:
    double inner_;
    double outer_;
};

/// An edge as a part of a great circle.
struct Arc {
    double cos_b = 1;  ///< cosine of the least angle between circle and axis, >= 0
    double k = 0;      ///< cosine between the axis and the circle's normal: +-sin b
    double from = 0;   ///< s of the first vertex, in [-pi, pi]
    double to = 0;     ///< s of the second vertex, from < to < from + pi

    double cosine(double s) const { return cos_b * std::cos(s); }
    /// 1 - c^2 without cancellation.
    double squared_sine(double s) const { return k * k + std::pow(cos_b * std::sin(s), 2); }

    /// Azimuth gained from s0 to s1: the integral of k / (1 - c^2).
    double azimuth(double s0, double s1) const {
        // Across the axis the two directions have the coordinates (k cos s, sin s), up to a turn.
        const double x0 = k * std::cos(s0), y0 = std::sin(s0);
        const double x1 = k * std::cos(s1), y1 = std::sin(s1);
        return std::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1);
    }
    /// The integral of (1 - c) k / (1 - c^2) = k / (1 + c).
    double full(double s0, double s1) const {
        const auto primitive = [&](double s) {
            return 2 * std::atan2(k * std::sin(0.5 * s), (1 + cos_b) * std::cos(0.5 * s));
        };
        return primitive(s1) - primitive(s0);
    }
};

/// Where an edge runs through the axis the integrand is bounded and panels need not shrink for
/// ever.
constexpr double shortest_panel = 1e-9;

/// Gauss-Legendre rule of 10 points on [-1, 1]: positive half of the symmetric nodes.
constexpr std::array<std::array<double, 2>, 5> gauss{{{0.14887433898163122, 0.29552422471475287},
                                                      {0.43339539412924719, 0.26926671930999636},
                                                      {0.67940956829902441, 0.21908636251598204},
                                                      {0.86506336668898451, 0.14945134915058059},
                                                      {0.97390652851717172, 0.066671344308688138}}};

/// The integral of (G - base) dphi over a part of an arc that lies between the two cones.
double over_ring(const Arc& arc, const Profile& profile, double base, double s0, double s1) {
    const double middle = 0.5 * (s0 + s1), half = 0.5 * (s1 - s0);
    // The poles of the integrand lie at the multiples of pi, b beside the real axis.
    const double beyond = std::max(0.0, std::abs(std::remainder(middle, M_PI)) - half);
    const double pole = std::min(1.0, std::hypot(beyond, arc.k));
    if (half > 0.5 * pole && half > shortest_panel)
        return over_ring(arc, profile, base, s0, middle) +
               over_ring(arc, profile, base, middle, s1);
    double sum = 0;
    for (const auto& [node, weight] : gauss)
        for (const double s : {middle - half * node, middle + half * node})
            sum += weight * (profile.on_ring(arc.cosine(s)) - base) / arc.squared_sine(s);
    return half * arc.k * sum;
}

/// The integral of (G - base) dphi along an arc.
double along(const Arc& arc, const Profile& profile, double base) {
    // An arc shorter than a half-turn meets either cone at most twice.
    std::array<double, 6> stop;
    stop.fill(arc.to);
    stop[0] = arc.from;
    std::size_t count = 1;
    for (const double limit : {profile.inner(), profile.outer()})
        if (std::abs(limit) < arc.cos_b) {
            const double s = std::acos(limit / arc.cos_b);
            for (const double crossing : {-s, s, 2 * M_PI - s})
                if (crossing > arc.from && crossing < arc.to) stop[count++] = crossing;
        }
    std::sort(stop.begin(), stop.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < stop.size() && stop[i] < arc.to; ++i) {
        const double s0 = stop[i], s1 = stop[i + 1];
        const double c = arc.cosine(0.5 * (s0 + s1));
        if (c >= profile.inner())
            sum += arc.full(s0, s1) - (base == 0 ? 0 : base * arc.azimuth(s0, s1));
        else if (c <= profile.outer())
            sum += base == profile.total() ? 0 : (profile.total() - base) * arc.azimuth(s0, s1);
        else
            sum += over_ring(arc, profile, base, s0, s1);
    }
    return sum;
}

/// The arc from `start` to `end`, both seen from the light, whose plane has the unit normal
/// `across`.
Arc arc_between(const Vec3& start, const Vec3& end, const Vec3& across, const Vec3& axis) {
    Arc arc;
    arc.k = across.dot(axis);
    const Vec3 projected = axis - arc.k * across;
    arc.cos_b = projected.norm();
    const Vec3 nearest = arc.cos_b > 0 ? Vec3(projected / arc.cos_b) : start.normalized();
    arc.from = std::atan2(start.dot(across.cross(nearest)), start.dot(nearest));
    arc.to = arc.from + std::atan2(start.cross(end - start).norm(), start.dot(end));
    return arc;
}

/// Flux of a spot of unit intensity through a polygon given relative to the light [lm/cd].
double spot_flux(const SpotLight& spot, const ConvexPolygon& seen) {
    const Profile profile(spot);
    std::array<Arc, ConvexPolygon::capacity> arcs;
    std::size_t count = 0;
    // How far inside the polygon the axis and its opposite lie: sines of angles.
    double axis_inside = 1, opposite_inside = 1;
    for (int i = 0; i < seen.size(); ++i) {
        const Vec3 &start = seen[i], &end = seen.after(i);
        const Vec3 product = start.cross(end - start);
        const double length = product.norm();
        if (!(length > 0)) continue;
        const Arc arc = arc_between(start, end, product / length, spot.direction);
        axis_inside = std::min(axis_inside, arc.k);
        opposite_inside = std::min(opposite_inside, -arc.k);
        arcs[count++] = arc;
    }
    const double base = axis_inside > opposite_inside ? 0 : profile.total();
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        sum += along(arcs[i], profile, base);
    return std::max(0.0, sum);
}

}  // namespace

Rgb flux(const Light& light, const ConvexPolygon& polygon) {
    const double angle = signed_solid_angle(position_of(light), polygon);
    if (angle == 0) return Rgb::Zero();
    const auto* spot = std::get_if<SpotLight>(&light);
    if (spot == nullptr || spot->inner_angle >= 180)
        return std::abs(angle) * intensity_towards(light, Vec3::UnitZ());
    const ConvexPolygon seen = polygon.moved(-spot->position);
    // Counter-clockwise seen from the light is clockwise seen from outside the sphere.
    return spot_flux(*spot, angle > 0 ? seen.reversed() : seen) * spot->intensity;
}

Rgb flux(const Light& light, const std::vector<ConvexPolygon>& pieces) {
    Rgb sum = Rgb::Zero();
    for (const ConvexPolygon& piece : pieces)
        sum += flux(light, piece);
    return sum;
}

}  // namespace lightwell
