#include "viewer/commands/scene_argument.h"

#include <filesystem>

namespace lightwell {

ReadScene read_scene_argument(const std::string& path, AlbedoAboveOne above_one,
                              const BareGeometry& bare) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (!fs::is_directory(path, error)) return read_scene(path, above_one, bare);
    const fs::path file = fs::path(path) / "scene.toml";
    if (!fs::exists(file, error)) throw InputError(Place{path}, "is a folder without a scene.toml");
    return read_scene(file.string(), above_one, bare);
}

}  // namespace lightwell
