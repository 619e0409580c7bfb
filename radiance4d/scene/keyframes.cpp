#include "radiance4d/scene/keyframes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightwell {

namespace {

/// Slope of a key between two spans of lengths h [s] and slopes s: zero at a turning point, else
/// Brodlie's weighted harmonic mean (Fritsch and Butland 1984, equation 5).
double slope_between(double h0, double s0, double h1, double s1) {
    if (!(s0 * s1 > 0)) return 0;
    const double alpha = (h0 + 2 * h1) / (3 * (h0 + h1));
    return s0 * s1 / (alpha * s1 + (1 - alpha) * s0);
}

/// The number that `value` gives for a key, at a time.
template <typename Key, typename Value>
double interpolated(const std::vector<Key>& keys, double time, const Value& value) {
    if (time <= keys.front().time) return value(keys.front());
    if (time >= keys.back().time) return value(keys.back());
    const auto after = static_cast<std::size_t>(
        std::upper_bound(keys.begin(), keys.end(), time,
                         [](double t, const Key& key) { return t < key.time; }) -
        keys.begin());
    const auto span = [&](std::size_t k) { return keys[k + 1].time - keys[k].time; };
    const auto slope = [&](std::size_t k) {
        return (value(keys[k + 1]) - value(keys[k])) / span(k);
    };
    const auto slope_at = [&](std::size_t k) {
        if (k == 0) return slope(0);
        if (k + 1 == keys.size()) return slope(k - 1);
        return slope_between(span(k - 1), slope(k - 1), span(k), slope(k));
    };
    const std::size_t before = after - 1;
    const double h = span(before), t = (time - keys[before].time) / h;
    const double low = value(keys[before]), high = value(keys[after]);
    // Cubic Hermite.
    const double rise = t * t * (3 - 2 * t);
    return low + (high - low) * rise +
           h * t * (1 - t) * ((1 - t) * slope_at(before) - t * slope_at(after));
}

template <typename Key, typename Three>
Vec3 interpolated_vector(const std::vector<Key>& keys, double time, const Three& three) {
    Vec3 result;
    for (int axis = 0; axis < 3; ++axis)
        result[axis] = interpolated(keys, time, [&](const Key& key) { return three(key)[axis]; });
    return result;
}

Light light_at(const std::vector<LightKey>& keys, double time) {
    Light light = keys.front().light;
    std::visit(
        [&](auto& kind) {
            using Kind = std::decay_t<decltype(kind)>;
            const auto of = [](const LightKey& key) -> const Kind& {
                return std::get<Kind>(key.light);
            };
            kind.position = interpolated_vector(
                keys, time, [&](const LightKey& key) { return of(key).position; });
            kind.intensity = interpolated_vector(keys, time, [&](const LightKey& key) {
                                 return Vec3(of(key).intensity.matrix());
                             }).array();
            if constexpr (std::is_same_v<Kind, SpotLight>) {
                const Vec3 direction = interpolated_vector(
                    keys, time, [&](const LightKey& key) { return of(key).direction; });
                // Half-way between opposite directions there is none; then the first one stays.
                if (direction.norm() > 1e-9) kind.direction = direction.normalized();
                kind.inner_angle = interpolated(
                    keys, time, [&](const LightKey& key) { return of(key).inner_angle; });
                kind.outer_angle =
                    std::max(kind.inner_angle, interpolated(keys, time, [&](const LightKey& key) {
                                 return of(key).outer_angle;
                             }));
            }
        },
        light);
    return light;
}

}  // namespace

double Keyframes::begin() const {
    double first = camera.empty() ? std::numeric_limits<double>::infinity() : camera.front().time;
    for (const std::vector<LightKey>& keys : lights)
        first = std::min(first, keys.front().time);
    return std::isfinite(first) ? first : 0;
}

double Keyframes::end() const {
    double last = camera.empty() ? begin() : camera.back().time;
    for (const std::vector<LightKey>& keys : lights)
        last = std::max(last, keys.back().time);
    return last;
}

int Keyframes::frames() const {
    // A last picture that rounding puts just beyond the end counts.
    return 1 + static_cast<int>(std::floor((end() - begin()) * frames_per_second + 1e-6));
}

Camera Keyframes::camera_at(double time) const {
    LIGHTWELL_CHECK_OP(camera.size(), >, std::size_t{0});
    Camera result;
    result.position =
        interpolated_vector(camera, time, [](const CameraKey& key) { return key.camera.position; });
    result.target =
        interpolated_vector(camera, time, [](const CameraKey& key) { return key.camera.target; });
    result.up =
        interpolated_vector(camera, time, [](const CameraKey& key) { return key.camera.up; });
    result.vertical_angle =
        interpolated(camera, time, [](const CameraKey& key) { return key.camera.vertical_angle; });
    return result;
}

std::vector<Light> Keyframes::lights_at(double time, std::vector<Light> others) const {
    for (const std::vector<LightKey>& keys : lights) {
        const Light moved = light_at(keys, time);
        const auto known = std::find_if(others.begin(), others.end(), [&](const Light& light) {
            return name_of(light) == name_of(moved);
        });
        if (known != others.end())
            *known = moved;
        else
            others.push_back(moved);
    }
    return others;
}

}  // namespace lightwell
