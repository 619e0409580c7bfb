#include "radiance4d/scene/ggx_lobe.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lightwell {

// Lambda(mu) = (sqrt(1 + alpha^2 (1 - mu^2)/mu^2) - 1)/2, so mu (1 + Lambda) and mu Lambda stay
// finite as mu goes to 0. Below, `hidden` is mu Lambda.
double UnitGgx::hidden(double cosine) const {
    const double square = cosine * cosine;
    return 0.5 * (std::sqrt(square + alpha_ * alpha_ * (1 - square)) - cosine);
}

/// D: how many facets have this normal, their areas per area of the surface [1/sr].
double UnitGgx::facets(const Vec3& half) const {
    const double a2 = alpha_ * alpha_;
    // cos^2 (a^2 - 1) + 1 as sin^2 + a^2 cos^2, which does not cancel near the normal.
    const double spread = half.head<2>().squaredNorm() + a2 * half[2] * half[2];
    return a2 / (M_PI * spread * spread);
}

double UnitGgx::value(const Vec3& in, const Vec3& out) const {
    // G2 / (4 mu_i mu_o) = 1 / (4 (mu_i mu_o + mu_o [mu_i Lambda_i] + mu_i [mu_o Lambda_o])).
    const double mu_i = in[2], mu_o = out[2];
    const double below = mu_i * mu_o + mu_o * hidden(mu_i) + mu_i * hidden(mu_o);
    if (!(mu_i > 0 && mu_o > 0)) return 0;
    return facets((in + out).normalized()) / (4 * below);
}

// What is drawn takes the peak away. Half of the square suffices, the rest mirrors it. The steep
// facets, which mirror light below the surface, are few and lie at the end of the radii: these are
// spaced by the cube.
template <typename Weight>
double UnitGgx::mean_reflected(double cosine, const Weight& weight) const {
    constexpr int radii = 128, turns = 192;
    const Vec3 given(std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine);
    double sum = 0;
    for (int i = 0; i < radii; ++i) {
        const double left = 1 - (i + 0.5) / radii;
        for (int j = 0; j < turns; ++j) {
            const double turn = 0.25 + 0.5 * (j + 0.5) / turns;
            const Vec3 out = sampled(given, {1 - left * left * left, turn});
            if (!(out[2] > 0)) continue;
            // (1 + Lambda_i) / (1 + Lambda_i + Lambda_o), both sides times mu_i mu_o.
            const double seen = out[2] * (cosine + hidden(cosine));
            sum += 3 * left * left * weight(given, out) * seen / (seen + cosine * hidden(out[2]));
        }
    }
    return sum / (radii * turns);
}

double UnitGgx::albedo(double cosine) const {
    return mean_reflected(cosine, [](const Vec3&, const Vec3&) { return 1.0; });
}

double UnitGgx::square(double cosine) const {
    return mean_reflected(cosine,
                          [this](const Vec3& in, const Vec3& out) { return value(in, out); });
}

Vec3 UnitGgx::sampled(const Vec3& given, const Vec2& square) const {
    // Stretch to a hemisphere, pick from its projection, shrink again.
    const Vec3 view = Vec3(alpha_ * given[0], alpha_ * given[1], given[2]).normalized();
    const double level = std::hypot(view[0], view[1]);
    const Vec3 first = level > 0 ? Vec3(-view[1] / level, view[0] / level, 0) : Vec3::UnitX();
    const Vec3 second = view.cross(first);
    const double radius = std::sqrt(square[0]);
    const double across = radius * std::cos(2 * M_PI * square[1]);
    const double share = 0.5 * (1 + view[2]);
    const double along = (1 - share) * std::sqrt(std::max(0.0, 1 - across * across)) +
                         share * radius * std::sin(2 * M_PI * square[1]);
    const Vec3 picked = across * first + along * second +
                        std::sqrt(std::max(0.0, 1 - across * across - along * along)) * view;
    const Vec3 half =
        Vec3(alpha_ * picked[0], alpha_ * picked[1], std::max(1e-12, picked[2])).normalized();
    return 2 * given.dot(half) * half - given;
}

double UnitGgx::density(const Vec3& given, const Vec3& sampled) const {
    const double cosine = given[2];
    if (!(cosine > 0 && sampled[2] > 0)) return 0;
    return facets((given + sampled).normalized()) / (4 * (cosine + hidden(cosine)));
}

}  // namespace lightwell
