#include "viewer/images/image_file.h"

#include <algorithm>
#include <filesystem>

namespace lightwell {

ImageFormat image_format(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (extension == ".png") return ImageFormat::png;
    if (extension == ".exr") return ImageFormat::exr;
    throw InputError(path + ": a picture's name must end in .png or .exr" +
                     (extension.empty() ? "" : ", not " + extension));
}

}  // namespace lightwell
