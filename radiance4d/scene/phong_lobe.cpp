#include "radiance4d/scene/phong_lobe.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "radiance4d/gauss_rule.h"

namespace lightwell {

namespace {

Vec3 mirrored(const Vec3& direction) {
    return {-direction[0], -direction[1], direction[2]};
}

}  // namespace

double UnitPhong::value(const Vec3& in, const Vec3& out) const {
    const double cosine = mirrored(in).dot(out);
    return cosine > 0 ? (n_ + 2) / (2 * M_PI) * std::pow(cosine, n_) : 0;
}

// The square is a lobe of twice the exponent: f_n^2 = (n+2)^2 / (4 pi^2) * 2 pi / (2 n + 2) f_2n.
double UnitPhong::square(double cosine) const {
    return (n_ + 2) * (n_ + 2) / (4 * M_PI * (n_ + 1)) * UnitPhong(2 * n_).albedo(cosine);
}

// In polar coordinates (alpha, phi) about the mirror direction, at theta from the normal, the
// cosine of the reflected light is A + B cos(phi), A = cos(theta) cos(alpha), B = sin(theta)
// sin(alpha), and its positive part integrates over phi to
//   2 pi A                              for alpha <= pi/2 - theta,
//   2 (A phi_0 + B sin(phi_0)) beyond,  cos(phi_0) = -A/B.
// With c = cos(alpha) what remains is Int_0^1 c^n (...) dc: closed above c = sin(theta), by Gauss's
// rule below, where c = sin(theta) (1 - s^2) takes away the root at the seam.
double UnitPhong::albedo(double cosine) const {
    static const GaussRule rule(48);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    double sum = 2 * M_PI * cosine * (1 - std::pow(sine, n_ + 2)) / (n_ + 2);
    // (1 - s^2)^n is below rounding beyond this s.
    const double end = std::min(1.0, std::sqrt(41 / std::max(n_, 1.0)));
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
        const double s = end * rule.nodes[k];
        const double c = sine * (1 - s * s);
        const double a = cosine * c, b = sine * std::sqrt(1 - c * c);
        if (!(b > 0)) continue;
        const double edge = std::acos(std::max(-1.0, -a / b));
        sum += rule.weights[k] * end * 2 * s * sine * std::pow(c, n_) * 2 *
               (a * edge + b * std::sin(edge));
    }
    return (n_ + 2) / (2 * M_PI) * sum;
}

Vec3 UnitPhong::sampled(const Vec3& given, const Vec2& square) const {
    const Vec3 axis = mirrored(given);
    const Vec3 across = axis.unitOrthogonal();
    const double cosine = std::pow(1 - square[0], 1 / (n_ + 1));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double azimuth = 2 * M_PI * square[1];
    return cosine * axis +
           sine * (std::cos(azimuth) * across + std::sin(azimuth) * axis.cross(across));
}

double UnitPhong::density(const Vec3& given, const Vec3& sampled) const {
    const double cosine = mirrored(given).dot(sampled);
    return cosine > 0 ? (n_ + 1) / (2 * M_PI) * std::pow(cosine, n_) : 0;
}

}  // namespace lightwell
