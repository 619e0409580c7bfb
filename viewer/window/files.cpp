#include "viewer/window/files.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"
#include "solver/reading/scene_reader.h"
#include "solver/reading/toml_table.h"
#include "viewer/images/false_colour.h"
#include "viewer/images/image_file.h"
#include "viewer/images/tone.h"
#include "viewer/window/light_text.h"

namespace lightwell {

Image image_of(const LinearPicture& picture) {
    Image image(picture.width, picture.height);
    for (std::size_t k = 0; k < image.pixels().size(); ++k)
        image.pixels()[k] =
            Image::Pixel(picture.rgb[3 * k], picture.rgb[3 * k + 1], picture.rgb[3 * k + 2]);
    return image;
}

std::string unit_of(Picture picture) {
    switch (picture) {
        case Picture::total:
        case Picture::direct:
        case Picture::indirect:
            return "cd/m2";
        case Picture::lux:
            return "lx";
        default:
            return "display";
    }
}

Image for_display(const Image& light, const FrameView& view) {
    const std::string unit = unit_of(view.picture);
    if (unit == "cd/m2")
        return develop(light,
                       {view.exposure, view.tone_curve ? ToneCurve::filmic : ToneCurve::clip});
    if (unit != "lx") return light;
    FalseColour style;
    style.maximum = view.lux_maximum;
    style.divisions = view.lux_divisions;
    style.contours = view.contours;
    return false_coloured(light, style);
}

void write_picture(LitScene& scene, const Visit& visit, int width, int height,
                   const std::string& path) {
    FrameView view = visit.view;
    view.samples = std::max(2, view.samples);
    const Image light = image_of(scene.linear(visit.camera.camera(), view, width, height));
    const WriteReport report = image_format(path) == ImageFormat::png
                                   ? write_png(for_display(light, view), path)
                                   : write_exr(light, unit_of(view.picture), path);
    if (report.non_finite_pixels > 0)
        throw SystemError(fmt::format("{}: {} pixels were not finite and are black", path,
                                      report.non_finite_pixels));
}

std::string next_free_name(const std::string& stem, const std::string& extension) {
    for (int number = 1;; ++number) {
        const std::string name = fmt::format("{}-{:04}{}", stem, number, extension);
        std::error_code error;
        if (!std::filesystem::exists(name, error)) return name;
    }
}

void save_lights(const Visit& visit) {
    std::vector<DimmedLight> lights;
    for (const EditedLight& edited : visit.edits.lights())
        lights.push_back({edited.light, edited.dimmer, edited.on});
    write_atomically(visit.lights_file, lights_and_camera_text(lights, visit.camera.camera()));
}

std::vector<EditedLight> edited(const std::vector<DimmedLight>& lights) {
    std::vector<EditedLight> all;
    for (const DimmedLight& dimmed : lights)
        all.push_back({dimmed.light, dimmed.on, dimmed.dimmer});
    return all;
}

std::vector<EditedLight> edited_lights(const std::string& path) {
    return edited(read_dimmed_lights(path));
}

void load_lights(const std::string& path, const Vec3& up, Visit& visit) {
    const std::vector<EditedLight> lights = edited_lights(path);
    const bool has_camera = TomlTable::read(path).has("camera");
    if (has_camera) {
        const double speed = visit.camera.speed();
        visit.camera = WalkCamera(read_camera(path, up), up);
        visit.camera.set_speed(speed);
    }
    visit.edits.replace(lights);
    if (lights.empty())
        visit.selected.reset();
    else
        visit.selected = std::min(visit.selected.value_or(0), lights.size() - 1);
}

void expose(LitScene& scene, Visit& visit, double aspect) {
    constexpr int height = 90;
    const int width = std::clamp(static_cast<int>(height * aspect), 1, 4 * height);
    const auto seen = [&](Picture picture) {
        FrameView view;
        view.picture = picture;
        return image_of(scene.linear(visit.camera.camera(), view, width, height));
    };
    visit.view.exposure = automatic_exposure(seen(Picture::total));
    visit.view.lux_maximum = automatic_maximum(seen(Picture::lux));
}

FileKind kind_of(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::is_directory(path, error)) return FileKind::scene;
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (extension == ".gto") return FileKind::operator_file;
    if (extension == ".obj" || extension == ".ply") return FileKind::scene;
    if (extension == ".toml")
        return TomlTable::read(path).has("geometry") ? FileKind::scene : FileKind::lights;
    throw InputError(Place{path},
                     "is neither an operator (.gto), nor a scene (.toml, .obj, .ply, a folder), "
                     "nor lights (.toml)");
}

}  // namespace lightwell
