#include "viewer/window/lit_scene.h"

#include <algorithm>
#include <utility>

#include "radiance4d/failure.h"
#include "runtime/projection/fastest_projection.h"
#include "runtime/propagation/fitting_format.h"
#include "runtime/propagation/global_propagation.h"

namespace lightwell {
namespace {

/// Seconds since the last call.
double lap(double& since) {
    const double now = steady_seconds();
    return now - std::exchange(since, now);
}

bool is_alike(const Light& one, const Light& other) {
    if (one.index() != other.index() || position_of(one) != position_of(other)) return false;
    if (const auto* point = std::get_if<PointLight>(&one))
        return (point->intensity == std::get<PointLight>(other).intensity).all();
    const auto& a = std::get<SpotLight>(one);
    const auto& b = std::get<SpotLight>(other);
    return (a.intensity == b.intensity).all() && a.direction == b.direction &&
           a.inner_angle == b.inner_angle && a.outer_angle == b.outer_angle;
}

}  // namespace

/// Textures of H E with all of E.
class LitScene::Exact {
  public:
    explicit Exact(const GlobalTransport& transport)
        : propagation_(transport),
          synthesis_(transport),
          indirect_(PackedField::Zero(4, transport.space.functions())) {}

    const TextureAtlas& textures(const PackedField& direct) {
        propagation_.apply(direct, indirect_);
        synthesis_.synthesise(indirect_);
        return synthesis_.atlas();
    }

  private:
    GlobalPropagation propagation_;
    TextureSynthesis synthesis_;
    PackedField indirect_;
};

LitScene::LitScene(std::shared_ptr<const OpenedOperator> opened, const GlLoader& loader,
                   ProjectionWay projection, std::optional<ValueFormat> rows)
    : LitScene(opened, chosen_projection(*opened, loader, projection), loader, rows) {}

LitScene::LitScene(std::shared_ptr<const OpenedOperator> opened, ChosenProjection chosen,
                   const GlLoader& loader, std::optional<ValueFormat> rows)
    : opened_(std::move(opened)),
      projection_(chosen.way),
      frame_(opened_->transport, std::move(chosen.projection),
             rows ? *rows : fitting_format(opened_->transport)),
      renderer_(opened_->transport, loader),
      canvas_(loader),
      finish_(loader("glFinish")) {
    LIGHTWELL_CHECK(finish_ != nullptr);
}

LitScene::~LitScene() = default;

bool LitScene::light(const std::vector<Light>& lights, const UpdateOptions& options,
                     bool wants_exact) {
    times_ = {};
    const bool changed = !lit_ || !shine_alike(*lit_, lights);
    const bool misses_exact = wants_exact && !exact_;
    if (!wants_exact) exact_.reset();
    if (!changed && is_at_rest() && !misses_exact) return false;

    report_ = frame_.light(lights, options);
    pace_.took(report_.update.coefficients, report_.propagation_seconds);
    double since = steady_seconds();
    if (report_.textures > 0 || !lit_) renderer_.upload(frame_.textures());
    if (changed) renderer_.set_lights(lights);
    times_.upload = lap(since);
    if (wants_exact) {
        if (!exact_) exact_ = std::make_unique<Exact>(opened_->transport);
        if (changed || misses_exact) renderer_.upload_exact(exact_->textures(frame_.direct()));
    }
    lit_ = lights;
    times_.projection = report_.projection_seconds;
    times_.propagation = report_.propagation_seconds;
    times_.synthesis = report_.synthesis_seconds;
    return true;
}

void LitScene::draw(const Camera& camera, const FrameView& view, int width, int height,
                    const PictureRows& rows) {
    look_from(camera);
    double since = steady_seconds();
    canvas_.draw(width, height, [&] { renderer_.draw(camera, view, width, height, rows); });
    finish_();
    times_.drawing = rows.from == 0 ? lap(since) : times_.drawing + lap(since);
}

void LitScene::look_from(const Camera& camera) {
    if (!frame_.is_glossy()) return;
    const FrameReport& report = frame_.look(camera.position);
    times_.synthesis += report.lobe_seconds;
    double since = steady_seconds();
    if (report.lobes > 0) renderer_.upload_lobes(frame_.lobes(), frame_.emitted_lobes());
    times_.upload += lap(since);
}

LinearPicture LitScene::linear(const Camera& camera, const FrameView& view, int width, int height) {
    look_from(camera);
    return renderer_.linear(camera, view, width, height);
}

Rgb LitScene::indirect_at(int quad, bool front, const Vec3& point) const {
    const RadianceSpace& space = opened_->transport.space;
    const int e = space.element_on(quad, front);
    if (e < 0) return Rgb::Zero();
    const auto element = static_cast<std::size_t>(e);
    const Vec2 uv = space.element(element).geometry.parameters(point);
    return frame_.textures().bilinear(element, uv[0], uv[1]).head<3>().cast<double>();
}

bool shine_alike(const std::vector<Light>& some, const std::vector<Light>& others) {
    return std::equal(some.begin(), some.end(), others.begin(), others.end(), is_alike);
}

}  // namespace lightwell
