#include "viewer/commands/render_command.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"
#include "radiance4d/scene/direct_light.h"
#include "runtime/drawing/frame_renderer.h"
#include "runtime/frame.h"
#include "runtime/outgoing/gathered_surfaces.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/lighting.h"
#include "solver/reading/input_file.h"
#include "solver/reading/scene_reader.h"
#include "viewer/commands/default_camera.h"
#include "viewer/commands/level_view.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/output.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/images/false_colour.h"
#include "viewer/images/image_file.h"
#include "viewer/images/tone.h"
#include "viewer/offscreen/gl_context.h"
#include "viewer/offscreen/render.h"

namespace lightwell {

namespace {

/// The light at every point that a picture may show.
class LitSurfaces {
  public:
    LitSurfaces(const OpenedOperator& opened, std::vector<Light> lights,
                const RenderRequest& request)
        : opened_(opened),
          lights_(std::move(lights)),
          view_(request.view),
          direct_(opened.transport.scene, opened.visibility, opened.occluders),
          albedo_(mean_albedos(opened.transport.scene.materials)) {
        if (view_ == View::direct) return;
        if (request.indirect == IndirectLight::textures) {
            frame_ = std::make_unique<Frame>(
                opened.transport, std::make_unique<ShadowProjection>(
                                      opened.transport.space, opened.quads, opened.occluders));
            frame_->light(lights_);
            return;
        }
        const Lighting lighting = light_scene(opened.transport, lights_, opened.quads,
                                              opened.occluders, Propagation::solved);
        indirect_ = request.indirect == IndirectLight::gathered
                        ? gathered(lighting)
                        : smooth_irradiance(opened.transport.space, lighting.indirect);
    }

    /// What the view shows of a side of a quad, in the view's unit.
    Rgb shown(int quad, bool front, const Vec3& position) const {
        heed_stop();
        const Rgb light = irradiance(quad, front, position);
        if (view_ == View::lux) return light;
        const Material& material = opened_.transport.scene.material_of(quad);
        Rgb luminance = Rgb::Zero();
        if (front || material.reflecting == Sides::both)
            luminance += albedo_[opened_.transport.scene.material_number(quad)] / M_PI * light;
        if (view_ != View::indirect && (front || material.emitting == Sides::both))
            luminance += material.emission;
        return luminance;
    }

  private:
    static void heed_stop() {
        if (stop_requested()) throw Interrupted("stopped on request");
    }

    std::vector<SmoothSurface> gathered(const Lighting& lighting) const {
        constexpr int strata = 16, points = 2;  // 1,024 rays a cell
        const RadianceSpace& space = opened_.transport.space;
        const FinalGather gather(opened_.transport, opened_.visibility,
                                 smooth_irradiance(space, lighting.direct + lighting.indirect),
                                 strata);
        return gathered_surfaces(space, gather, points, heed_stop);
    }

    /// [lx]
    Rgb irradiance(int quad, bool front, const Vec3& position) const {
        const Vec3 up = opened_.quads[static_cast<std::size_t>(quad)].normal();
        Rgb light = Rgb::Zero();
        if (view_ != View::indirect)
            light += direct_.irradiance(position, front ? up : Vec3(-up), quad, lights_);
        const int e = opened_.transport.space.element_on(quad, front);
        if (view_ != View::direct && e >= 0) {
            const auto element = static_cast<std::size_t>(e);
            const Vec2 uv = opened_.transport.space.element(element).geometry.parameters(position);
            light += frame_ ? Rgb(frame_->textures()
                                      .bilinear(element, uv[0], uv[1])
                                      .head<3>()
                                      .cast<double>())
                            : indirect_[element].at(uv[0], uv[1]);
        }
        return light;
    }

    const OpenedOperator& opened_;
    std::vector<Light> lights_;
    View view_;
    DirectLight direct_;
    std::vector<Rgb> albedo_;              ///< mean, by material
    std::vector<SmoothSurface> indirect_;  ///< by element, unless it is in textures:
    std::unique_ptr<Frame> frame_;
};

Camera chosen_camera(const RenderRequest& request, const OpenedOperator& opened) {
    const Scene& scene = opened.transport.scene;
    if (request.camera) return read_camera(*request.camera, scene.up);
    if (scene.camera) return *scene.camera;
    return default_camera(scene, opened.transport.space, opened.visibility);
}

Image for_display(const Image& light, const RenderRequest& request) {
    switch (request.view) {
        case View::lux:
            return false_coloured(light, FalseColour());
        case View::level:
            return light;
        default:
            return develop(light,
                           {automatic_exposure(light) + request.exposure, ToneCurve::filmic});
    }
}

void write_picture(const Image& light, const RenderRequest& request) {
    WriteReport report;
    if (image_format(request.output) == ImageFormat::png)
        report = write_png(for_display(light, request), request.output);
    else
        report = write_exr(light,
                           request.view == View::lux     ? "lx"
                           : request.view == View::level ? "display"
                                                         : "cd/m2",
                           request.output);
    if (report.non_finite_pixels > 0)
        print_message(fmt::format("{}: warning: {} pixels were not finite and are black",
                                  request.output, report.non_finite_pixels));
}

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
        default:
            return Picture::total;
    }
}

Image drawn_live(const OpenedOperator& opened, const std::vector<Light>& lights,
                 const Camera& camera, const RenderRequest& request, const GlContext& context) {
    Frame frame(opened.transport, std::make_unique<ShadowProjection>(
                                      opened.transport.space, opened.quads, opened.occluders));
    frame.light(lights);
    FrameRenderer renderer(opened.transport, context.loader());
    renderer.set_lights(lights);
    renderer.upload(frame.textures());
    FrameView view;
    view.picture = picture_of(request.view);
    view.samples = request.samples;
    const LinearPicture picture =
        renderer.linear(camera, view, request.size.width, request.size.height);
    Image image(picture.width, picture.height);
    for (std::size_t p = 0; p < image.pixels().size(); ++p)
        image.pixels()[p] = Eigen::Map<const Image::Pixel>(picture.rgb.data() + 3 * p);
    return image;
}

}  // namespace

View view_argument(const std::string& option, const std::string& text) {
    const std::pair<const char*, View> views[] = {{"total", View::total},
                                                  {"direct", View::direct},
                                                  {"indirect", View::indirect},
                                                  {"lux", View::lux},
                                                  {"level", View::level}};
    for (const auto& [name, view] : views)
        if (text == name) return view;
    throw InputError(Place{option},
                     in_quotes(text) + " is not a view: total, direct, indirect, lux or level");
}

void run_render(const RenderRequest& request) {
    image_format(request.output);
    require_writable(request.output);
    const OpenedOperator opened = open_operator(request.operator_file);
    const std::vector<Light> lights = chosen_lights(request.lights, opened.transport.scene);
    const Camera camera = chosen_camera(request, opened);
    const std::unique_ptr<GlContext> context = make_offscreen_context();
    if (request.live) {
        write_picture(drawn_live(opened, lights, camera, request, *context), request);
        return;
    }
    const SurfaceDrawing drawing(opened.quads, context->loader());
    PictureSize size;
    size.width = request.size.width;
    size.height = request.size.height;
    size.samples = request.samples;
    if (request.view == View::level) {
        const CameraRays rays(camera, size.width, size.height);
        write_picture(render(drawing, camera, size, level_shade(opened.transport.space, rays)),
                      request);
        return;
    }
    const LitSurfaces surfaces(opened, lights, request);
    const Shade shade = [&surfaces](int quad, bool front, const Vec3& position, const Vec3&) {
        return surfaces.shown(quad, front, position);
    };
    write_picture(render(drawing, camera, size, shade), request);
}

}  // namespace lightwell
