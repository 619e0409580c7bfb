#include "runtime/frame.h"

#include <utility>

#include "runtime/projection/fastest_projection.h"

namespace lightwell {

namespace {

/// Seconds between calls.
class StageClock {
  public:
    double lap() {
        const double since = std::exchange(since_, steady_seconds());
        return since_ - since;
    }

  private:
    double since_ = steady_seconds();
};

}  // namespace

Frame::Frame(const GlobalTransport& transport, std::unique_ptr<LightProjection> projection,
             ValueFormat format)
    : projection_(std::move(projection)),
      propagation_(transport, format),
      update_(transport.space, propagation_),
      synthesis_(transport),
      lobes_(transport),
      emitted_lobes_(transport),
      emitted_(packed(propagated(transport.bounce, emission_of(transport.scene, transport.space)))),
      direct_(PackedField::Zero(4, transport.space.functions())) {
    emitted_lobes_.take(emitted_);
}

const FrameReport& Frame::light(const std::vector<Light>& lamps, const UpdateOptions& options) {
    StageClock clock;
    projection_->project(lamps, direct_);
    direct_ += emitted_;
    report_.projection_seconds = clock.lap();

    report_.update = update_.update(direct_, options);
    report_.propagation_seconds = clock.lap();

    report_.textures = synthesis_.synthesise(update_.indirect());
    report_.synthesis_seconds = clock.lap();
    return report_;
}

const FrameReport& Frame::look(const Vec3& eye) {
    StageClock clock;
    lobes_.take(update_.indirect());
    report_.lobes = lobes_.synthesise(eye) + emitted_lobes_.synthesise(eye);
    report_.lobe_seconds = clock.lap();
    return report_;
}

}  // namespace lightwell
