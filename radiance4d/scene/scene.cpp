#include "radiance4d/scene/scene.h"

#include <fmt/format.h>

namespace lightwell {

std::string Scene::describe(int quad) const {
    const Place place{geometry_file, quads[static_cast<std::size_t>(quad)].line, 0};
    return fmt::format("quad {} ({})", quad, place.to_string());
}

}  // namespace lightwell
