#include "solver/reading/mesh_reader.h"

#include <algorithm>
#include <filesystem>

#include "solver/reading/input_file.h"
#include "solver/reading/obj_reader.h"
#include "solver/reading/ply_reader.h"

namespace lightwell {

namespace {

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    });
    return extension;
}

}  // namespace

bool is_mesh_file(const std::string& path) {
    const std::string extension = extension_of(path);
    return extension == ".obj" || extension == ".ply";
}

PolygonSoup read_mesh(const std::string& path) {
    const std::string extension = extension_of(path);
    if (extension == ".obj") return read_obj(path);
    if (extension == ".ply") return read_ply(path);
    throw InputError(Place{path}, "geometry files end in .obj or .ply, not in " +
                                      in_quotes(extension) + "; convert the file to one of these");
}

}  // namespace lightwell
