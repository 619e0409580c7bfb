#include "runtime/drawing/lamp_records.h"

#include <cmath>

namespace lightwell {

namespace {

Record record(const Eigen::Array3d& three, double fourth) {
    return {static_cast<float>(three[0]), static_cast<float>(three[1]),
            static_cast<float>(three[2]), static_cast<float>(fourth)};
}

}  // namespace

void append_records(const Light& light, const SceneScale& scale, std::vector<Record>& records) {
    const double square = scale.extent * scale.extent;
    records.push_back(record(scale.scaled(position_of(light)), 0));
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        const double radian = M_PI / 180;
        records.push_back(record(spot->intensity / square, std::cos(spot->inner_angle * radian)));
        records.push_back(record(spot->direction, std::cos(spot->outer_angle * radian)));
    } else {
        records.push_back(record(std::get<PointLight>(light).intensity / square, -2));
        records.push_back(record(Vec3::UnitZ(), -3));
    }
}

}  // namespace lightwell
