#include "viewer/commands/render_command.h"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"
#include "radiance4d/scene/direct_light.h"
#include "runtime/frame.h"
#include "runtime/outgoing/eye_radiance.h"
#include "runtime/outgoing/gathered_surfaces.h"
#include "runtime/projection/shadow_projection.h"
#include "runtime/propagation/lighting.h"
#include "solver/reading/scene_reader.h"
#include "viewer/commands/default_camera.h"
#include "viewer/commands/level_view.h"
#include "viewer/commands/lit_scene.h"
#include "viewer/commands/live_pictures.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/output.h"
#include "viewer/commands/picture_output.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/images/image_file.h"
#include "viewer/offscreen/gl_context.h"
#include "viewer/offscreen/render.h"

namespace lightwell {

namespace {

void heed_stop() {
    if (stop_requested()) throw Interrupted("stopped on request");
}

/// The light at every point that a picture may show.
class LitSurfaces {
  public:
    LitSurfaces(const OpenedOperator& opened, std::vector<Light> lights, const Vec3& eye,
                const RenderRequest& request)
        : opened_(opened),
          lights_(std::move(lights)),
          view_(request.view),
          direct_(opened.transport.scene, opened.visibility, opened.occluders),
          albedo_(mean_albedos(opened.transport.scene.materials)) {
        if (view_ == View::direct && !has_angles(opened.transport.space)) return;
        if (request.indirect == IndirectLight::textures) {
            frame_ = std::make_unique<Frame>(
                opened.transport, std::make_unique<ShadowProjection>(
                                      opened.transport.space, opened.quads, opened.occluders));
            frame_->light(lights_);
            frame_->look(eye);
            return;
        }
        lit_ = std::make_unique<LitScene>(opened, lights_);
        const RadianceSpace& space = opened.transport.space;
        // 1,024 rays a cell; more where polished surfaces show small bright images of lamps, which
        // fewer rays met by chance: walls were blotchy.
        const int strata = has_angles(space) ? 32 : 16;
        constexpr int points = 2;
        const bool gathers = request.indirect == IndirectLight::gathered;
        std::optional<FinalGather> gather;
        if (gathers) gather.emplace(lit_->gather(strata));
        if (view_ != View::direct)
            indirect_ = gathers ? gathered_surfaces(space, *gather, points, heed_stop)
                                : smooth_irradiance(space, lit_->lighting().indirect);
        if (lit_->glossy() == nullptr) return;
        const EyeRadiance::Look look = [&](std::size_t element, const Vec3& point,
                                           const Vec3& direction) {
            return gathers ? gather->from_lobe(element, point, direction)
                           : lit_->glossy()->from_lobe(element, point, direction);
        };
        constexpr int finer = 2;
        glossy_.emplace(space, eye, gathers ? finer : 0, look, heed_stop);
    }

    /// What the view shows of a side of a quad, in the view's unit.
    Rgb shown(int quad, bool front, const Vec3& position, const Vec3& to_eye) const {
        heed_stop();
        const Rgb light = irradiance(quad, front, position);
        if (view_ == View::lux) return light;
        const Material& material = opened_.transport.scene.material_of(quad);
        Rgb luminance = Rgb::Zero();
        if (front || material.reflecting == Sides::both)
            luminance += reflected(quad, front, position, to_eye, light);
        if (view_ != View::indirect && (front || material.emitting == Sides::both))
            luminance += material.emission;
        return luminance;
    }

  private:
    /// What a reflecting side makes of its irradiance, and, by its lobe, of the rest [cd/m2].
    Rgb reflected(int quad, bool front, const Vec3& position, const Vec3& to_eye,
                  const Rgb& irradiance) const {
        const int e = opened_.transport.space.element_on(quad, front);
        const auto element = static_cast<std::size_t>(e);
        if (e < 0 || !shows_lobe(element))
            return albedo_[opened_.transport.scene.material_number(quad)] / M_PI * irradiance;
        Rgb sum = opened_.transport.scene.material_of(quad).reflectance / M_PI * irradiance;
        const GatheredRadiance lobe = lobe_at(
            element, opened_.transport.space.element(element).geometry.parameters(position));
        if (view_ != View::direct) sum += lobe.indirect;
        if (view_ != View::indirect)
            sum += lobe.emitted +
                   lobe_of_lamps(opened_.transport, direct_, lights_, element, position, to_eye);
        return sum;
    }

    bool shows_lobe(std::size_t element) const {
        if (glossy_) return glossy_->shows(element);
        return frame_ && frame_->is_glossy() &&
               opened_.transport.space.element(element).angle.levels() > 0;
    }

    /// What an element's lobe sends to the eye of indirect and of emitted light.
    GatheredRadiance lobe_at(std::size_t element, const Vec2& uv) const {
        if (glossy_) return glossy_->at(element, uv);
        const auto read = [&](const TextureAtlas& atlas) -> Rgb {
            return atlas.bilinear(element, uv[0], uv[1]).head<3>().cast<double>();
        };
        return {read(frame_->lobes()), read(frame_->emitted_lobes())};
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
    std::unique_ptr<LitScene> lit_;
    std::optional<EyeRadiance> glossy_;  ///< where there are glossy surfaces
};

Camera chosen_camera(const RenderRequest& request, const OpenedOperator& opened) {
    const Scene& scene = opened.transport.scene;
    if (request.camera) return read_camera(*request.camera, scene.up);
    if (scene.camera) return *scene.camera;
    return default_camera(scene, opened.transport.space, opened.visibility);
}

}  // namespace

void run_render(const RenderRequest& request) {
    image_format(request.output);
    if (!request.path) {
        require_writable(request.output);
        require_not_read(request.output, {request.operator_file, request.lights.value_or(""),
                                          request.camera.value_or("")});
    }
    const OpenedOperator opened = open_operator(request.operator_file);
    const std::vector<Light> lights = chosen_lights(request.lights, opened.transport.scene);
    const Camera camera = chosen_camera(request, opened);
    if (request.path) {
        draw_path(opened, {*request.path, request.output, request.view, request.size,
                           request.samples, request.exposure, request.contours, camera, lights,
                           request.opengl, request.projection});
        return;
    }
    PictureOutput output(request.view, request.exposure, request.contours);
    if (request.live || request.view == View::coefficients) {
        LivePictures pictures(opened, request.view, request.size, request.samples, request.opengl,
                              request.projection);
        heed_stop();
        const Image drawn = pictures.drawn(lights, camera);
        heed_stop();
        output.write(drawn, request.output);
        return;
    }
    const std::unique_ptr<GlContext> context = make_context(request.opengl);
    const SurfaceDrawing drawing(opened.quads, context->loader());
    PictureSize size;
    size.width = request.size.width;
    size.height = request.size.height;
    size.samples = request.samples;
    if (request.view == View::level) {
        const CameraRays rays(camera, size.width, size.height);
        const Shade level = level_shade(opened.transport.space, rays);
        const Shade shade = [&level](int quad, bool front, const Vec3& position,
                                     const Vec3& to_eye) {
            heed_stop();
            return level(quad, front, position, to_eye);
        };
        output.write(render(drawing, camera, size, shade), request.output);
        return;
    }
    const LitSurfaces surfaces(opened, lights, camera.position, request);
    const Shade shade = [&surfaces](int quad, bool front, const Vec3& position,
                                    const Vec3& to_eye) {
        return surfaces.shown(quad, front, position, to_eye);
    };
    output.write(render(drawing, camera, size, shade), request.output);
}

}  // namespace lightwell
