#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "runtime/drawing/frame_renderer.h"
#include "runtime/frame.h"
#include "runtime/propagation/paced_budget.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/projection_choice.h"
#include "viewer/window/picture_canvas.h"
#include "viewer/window/stage_times.h"

namespace lightwell {

/// A scene as it is lit and drawn: the online pipeline with its renderer, in one OpenGL context,
/// which must be current whenever a method is called, and at the end.
class LitScene {
  public:
    /// @param projection  of lamps; the fastest is measured here
    /// @param rows        how the rows of H are held; none: see fitting_format
    LitScene(std::shared_ptr<const OpenedOperator> opened, const GlLoader& loader,
             ProjectionWay projection = ProjectionWay::fastest,
             std::optional<ValueFormat> rows = std::nullopt);
    ~LitScene();

    const std::shared_ptr<const OpenedOperator>& opened() const { return opened_; }
    const FrameRenderer& renderer() const { return renderer_; }

    /// How lamps are projected; never ProjectionWay::fastest.
    ProjectionWay projection() const { return projection_; }
    /// How many coefficients can be multiplied in so many seconds, by what the frames so far took.
    std::uint32_t budget(double seconds) const { return pace_.budget(seconds); }

    /// Lights the scene anew where the lights have changed, or where X is not exact yet.
    /// @param wants_exact  keep textures of the exact product too, for Picture::difference
    /// @return whether that may have changed the picture
    bool light(const std::vector<Light>& lights, const UpdateOptions& options, bool wants_exact);
    /// Whether light() with the same lights would change nothing.
    bool is_at_rest() const { return report_.update.pending == 0; }

    /// Draws a picture, or some rows of it, and keeps it; returns when these are complete.
    void draw(const Camera& camera, const FrameView& view, int width, int height,
              const PictureRows& rows = {});
    /// Puts the picture kept over the framebuffer that is bound, from its lower left corner on.
    void show() { canvas_.show(); }
    LinearPicture linear(const Camera& camera, const FrameView& view, int width, int height);

    /// Indirect illuminance [lx] at a point of a surface, as the picture shows it.
    Rgb indirect_at(int quad, bool front, const Vec3& point) const;
    /// Of the last light() and a draw() after it.
    const StageTimes& times() const { return times_; }
    const UpdateReport& update() const { return report_.update; }

  private:
    class Exact;

    LitScene(std::shared_ptr<const OpenedOperator> opened, ChosenProjection chosen,
             const GlLoader& loader, std::optional<ValueFormat> rows);
    /// Has glossy surfaces show what they send towards the camera.
    void look_from(const Camera& camera);

    std::shared_ptr<const OpenedOperator> opened_;
    ProjectionWay projection_;
    Frame frame_;
    PacedBudget pace_;
    FrameRenderer renderer_;
    PictureCanvas canvas_;
    void (*finish_)();  ///< glFinish
    std::optional<std::vector<Light>> lit_;
    FrameReport report_;
    std::unique_ptr<Exact> exact_;
    StageTimes times_;
};

/// Whether two lists hold the same lights, names aside.
bool shine_alike(const std::vector<Light>& some, const std::vector<Light>& others);

}  // namespace lightwell
