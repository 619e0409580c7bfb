#include "viewer/commands/live_pictures.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "solver/reading/path_reader.h"
#include "viewer/commands/picture_output.h"
#include "viewer/commands/progress_line.h"

namespace lightwell {

namespace {

Picture picture_of(View view) {
    switch (view) {
        case View::direct:
            return Picture::direct;
        case View::indirect:
            return Picture::indirect;
        case View::lux:
            return Picture::lux;
        case View::level:
            return Picture::level;
        case View::coefficients:
            return Picture::coefficients;
        case View::total:
            break;
    }
    return Picture::total;
}

FrameView frame_view(View view, int samples) {
    FrameView result;
    result.picture = picture_of(view);
    result.samples = samples;
    return result;
}

int checked_samples(int samples) {
    constexpr int most = 4;
    if (samples > most)
        throw InputError(Place{"--samples"},
                         fmt::format("{}: live pictures take at most {}", samples, most));
    return samples;
}

/// "walk.png", picture 0 of 250: "walk-0001.png".
std::string numbered(const std::string& output, int frame, int frames) {
    const std::filesystem::path path(output);
    const int digits = std::max(4, static_cast<int>(std::to_string(frames).size()));
    const std::string name = fmt::format("{}-{:0{}}{}", path.stem().string(), frame + 1, digits,
                                         path.extension().string());
    return (path.parent_path() / name).string();
}

}  // namespace

LivePictures::LivePictures(const OpenedOperator& opened, View view, const PixelSize& size,
                           int samples, OffscreenGl opengl, ProjectionWay projection)
    : context_(make_context(opengl)),
      frame_(opened.transport,
             chosen_projection(opened, context_->loader(), projection).projection),
      renderer_(opened.transport, context_->loader()),
      view_(frame_view(view, checked_samples(samples))),
      size_(size) {}

Image LivePictures::drawn(const std::vector<Light>& lights, const Camera& camera) {
    frame_.light(lights);
    renderer_.set_lights(lights);
    renderer_.upload(frame_.textures());
    if (frame_.is_glossy() && frame_.look(camera.position).lobes > 0)
        renderer_.upload_lobes(frame_.lobes(), frame_.emitted_lobes());
    const LinearPicture picture = renderer_.linear(camera, view_, size_.width, size_.height);
    Image image(picture.width, picture.height);
    for (std::size_t p = 0; p < image.pixels().size(); ++p)
        image.pixels()[p] = Eigen::Map<const Image::Pixel>(picture.rgb.data() + 3 * p);
    return image;
}

void draw_path(const OpenedOperator& opened, const PathRequest& request) {
    const Keyframes keyframes = read_path(request.path_file, opened.transport.scene.up);
    const int frames = keyframes.frames();
    require_writable(numbered(request.output, 0, frames));
    LivePictures pictures(opened, request.view, request.size, request.samples, request.opengl,
                          request.projection);
    PictureOutput output(request.view, request.exposure, request.contours);
    std::optional<ProgressLine> line;
    const Progress progress =
        progress_on(line, true, [](const std::string&, double share) { return share; });
    for (int frame = 0; frame < frames; ++frame) {
        if (progress.stop_requested())
            throw Interrupted(
                fmt::format("stopped on request; {} of {} pictures are there", frame, frames));
        progress.say(fmt::format("picture {} of {}", frame + 1, frames), 1.0 * frame / frames);
        const double time = keyframes.time_of(frame);
        const Camera camera = keyframes.camera.empty() ? request.camera : keyframes.camera_at(time);
        try {
            output.write(pictures.drawn(keyframes.lights_at(time, request.lights), camera),
                         numbered(request.output, frame, frames));
        } catch (const InputError& error) {
            throw InputError(Place{request.path_file},
                             fmt::format("at {:g} s: {}", time, error.what()));
        }
    }
}

}  // namespace lightwell
