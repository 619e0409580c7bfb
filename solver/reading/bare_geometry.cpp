#include "solver/reading/bare_geometry.h"

#include <map>

#include "solver/reading/mesh_reader.h"

namespace lightwell {

std::string assumed_of(const std::string& path, const BareGeometry& bare) {
    if (!is_mesh_file(path) || (bare.metres_per_unit && bare.up)) return "";
    if (bare.up) return "lengths are in metres";
    return bare.metres_per_unit ? "z points up" : "lengths are in metres and z points up";
}

std::optional<double> metres_in(const std::string& unit) {
    static const std::map<std::string, double> metres = {
        {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
    const auto found = metres.find(unit);
    return found == metres.end() ? std::nullopt : std::optional<double>(found->second);
}

bool is_unit(double metres) {
    return metres >= 1e-9 && metres <= 1e9;
}

std::optional<Vec3> axis_called(const std::string& name) {
    if (name == "x") return Vec3::UnitX();
    if (name == "y") return Vec3::UnitY();
    if (name == "z") return Vec3::UnitZ();
    return std::nullopt;
}

}  // namespace lightwell
