#pragma once

#include <string>

#include "radiance4d/scene/dimmed_light.h"
#include "viewer/images/image.h"
#include "viewer/window/lit_scene.h"
#include "viewer/window/visit.h"

namespace lightwell {

/// The picture with the light's own numbers.
Image image_of(const LinearPicture& picture);
/// The unit of what a picture's linear form holds, for write_exr.
std::string unit_of(Picture picture);
/// What the window shows, from the linear picture.
Image for_display(const Image& light, const FrameView& view);

/// Writes the picture as the visit's view asks to a .png (as seen) or .exr (the light itself), four
/// samples a pixel.
/// @throws as write_png, write_exr and FrameRenderer::linear
void write_picture(LitScene& scene, const Visit& visit, int width, int height,
                   const std::string& path);

/// "stem-0001.png", or the first number that no file has yet.
std::string next_free_name(const std::string& stem, const std::string& extension);

/// Writes the lights, those that are off included, and the view to visit.lights_file.
void save_lights(const Visit& visit);
/// Lights as they are edited.
std::vector<EditedLight> edited(const std::vector<DimmedLight>& lights);
/// The lights of a file as they are edited. @throws as read_lights
std::vector<EditedLight> edited_lights(const std::string& path);
/// Reads lights, and the view if the file has one. @throws as read_lights
void load_lights(const std::string& path, const Vec3& up, Visit& visit);

/// Sets exposure and the scale of lux by a small picture of what is seen.
void expose(LitScene& scene, Visit& visit, double aspect);

/// What a file is to the window.
enum class FileKind { operator_file, scene, lights };
/// By its extension; a .toml that names no geometry holds lights.
/// @throws InputError if it is none of these, or cannot be read
FileKind kind_of(const std::string& path);

}  // namespace lightwell
