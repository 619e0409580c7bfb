#pragma once

#include <functional>

#include "radiance4d/scene/quad.h"
#include "radiance4d/scene/scene.h"
#include "runtime/drawing/surface_drawing.h"
#include "viewer/images/image.h"

namespace lightwell {

/// Size of a picture and of the drawing behind it.
struct PictureSize {
    int width = 960;   ///< [pixels], at least 1
    int height = 720;  ///< [pixels], at least 1
    /// Samples a side in every pixel, on a regular grid: samples^2 are averaged. At least 1.
    int samples = 2;
    /// The picture is drawn in tiles of at most so many samples a side, which bounds the memory.
    int tile = 1024;
};

/// The light that leaves a surface point towards the eye, in the unit the picture shall have.
/// `quad` is the index of the quad in the drawing, `front` tells which of its sides is seen,
/// `to_eye` is a unit vector. Called from many threads at once.
using Shade = std::function<Rgb(int quad, bool front, const Vec3& position, const Vec3& to_eye)>;

/// The picture that the camera takes: the mean, in linear light, of the shade at the samples of
/// every pixel. Where nothing is seen it is black. The result does not depend on the number of
/// threads.
/// @throws InputError for a camera that cannot be used; SystemError if OpenGL fails.
Image render(const SurfaceDrawing& drawing, const Camera& camera, const PictureSize& size,
             const Shade& shade);

}  // namespace lightwell
