#include "viewer/window/window_loop.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <tuple>
#include <utility>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "runtime/projection/fastest_projection.h"
#include "solver/reading/input_file.h"
#include "solver/reading/scene_reader.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/window/files.h"
#include "viewer/window/first_look.h"
#include "viewer/window/memory_in_use.h"
#include "viewer/window/panel.h"
#include "viewer/window/recording.h"
#include "viewer/window/window_picture.h"

namespace lightwell {

namespace {

constexpr double idle_patience = 0.1;     // between looks at files and loading [s]
constexpr double usual_frame = 1.0 / 60;  // [s]
constexpr std::int64_t largest_recording = std::int64_t{64} << 20;

std::optional<std::vector<InputFrame>> replay_of(const ViewRequest& request) {
    if (!request.replay) return std::nullopt;
    return input_from_text(read_text(*request.replay, largest_recording), *request.replay);
}

bool is_same(const FrameView& a, const FrameView& b) {
    const auto all = [](const FrameView& v) {
        return std::make_tuple(v.picture, v.exposure, v.tone_curve, v.bilinear, v.samples,
                               v.lux_maximum, v.lux_divisions, v.contours, v.difference_range);
    };
    return all(a) == all(b);
}

bool is_same(const Camera& a, const Camera& b) {
    return a.position == b.position && a.target == b.target && a.up == b.up &&
           a.vertical_angle == b.vertical_angle;
}

}  // namespace

bool WindowLoop::is_same(const Shown& a, const Shown& b) {
    return lightwell::is_same(a.camera, b.camera) && lightwell::is_same(a.view, b.view) &&
           a.width == b.width && a.height == b.height;
}

WindowLoop::WindowLoop(const ViewRequest& request)
    : request_(request),
      window_("Lightwell", request.size.width, request.size.height),
      gl_(window_.loader()),
      panel_(window_.scale()),
      replay_(replay_of(request)),
      width_(window_.size().width),
      height_(window_.size().height),
      picture_width_(width_),
      last_frame_(steady_seconds()),
      visit_(WalkCamera({}, Vec3::UnitZ())) {
    if (request_.record) require_writable(*request_.record);
    open(request_.subject);
}

WindowLoop::~WindowLoop() = default;

void WindowLoop::run() {
    double last_look = last_frame_;
    while (!window_.is_closed() && !quits_ && !stop_requested()) {
        if (replay_) wait_for_rest();
        if (replay_ && replayed_ == replay_->size()) break;
        const InputFrame frame = next_input();
        constexpr double between_looks = 0.5;  // at the file
        if (last_frame_ - last_look > between_looks || replay_) {
            last_look = last_frame_;
            if (watch_ && !loading_ && watch_->has_changed()) visit_.ask(Command::reload);
        }
        take_loaded();
        probe_.poll();
        if (!frame.inputs.empty() || loading_ || probe_.is_reading() || !visit_.commands.empty())
            frames_to_draw_ = frames_after_change;
        if (pace_.owes_more() || gestures_.is_walking() || (scene_ && !scene_->is_at_rest()))
            frames_to_draw_ = std::max(frames_to_draw_, 1);
        if (frames_to_draw_ == 0 && !replay_) continue;
        --frames_to_draw_;
        take(frame);
        draw(frame);
    }
    if (request_.record) write_atomically(*request_.record, recorded_);
}

InputFrame WindowLoop::next_input() {
    if (replay_) {
        window_.inputs(0);
        return (*replay_)[replayed_++];
    }
    const bool was_idle = frames_to_draw_ <= 0;
    InputFrame frame;
    frame.inputs = window_.inputs(was_idle || loading_ ? idle_patience : 0);
    const double now = steady_seconds();
    // Nobody walked while nothing was drawn.
    frame.seconds = was_idle ? usual_frame : now - last_frame_;
    last_frame_ = now;
    if (request_.record) recorded_ += text_of(frame);
    return frame;
}

/// For a replay that is the same every time: nothing goes on beside it.
void WindowLoop::wait_for_rest() {
    constexpr std::chrono::milliseconds pause(2);
    while (loading_ && !stop_requested()) {
        take_loaded();
        std::this_thread::sleep_for(pause);
    }
    while (probe_.is_reading() && !probe_.poll())
        std::this_thread::sleep_for(pause);
}

void WindowLoop::take(const InputFrame& frame) {
    for (const Input& input : frame.inputs)
        if (const auto* size = std::get_if<SizeInput>(&input)) take_size(*size);
    for (const Input& input : frame.inputs)
        visit_.heed(input);
    const PanelClaims claims = panel_.begin(frame, width_, height_);
    // In a narrow window the panel lies over the picture.
    const bool is_beside = visit_.shows_panel && width_ > 2 * panel_width();
    picture_width_ = is_beside ? width_ - panel_width() : width_;
    const Walls* walls = walls_ && !visit_.through_walls ? &*walls_ : nullptr;
    if (scene_) {
        const bool looked_freely = visit_.looks_freely;
        for (const Input& input : frame.inputs)
            gestures_.take(input, claims, visit_, scene_->opened()->visibility, picture_width_,
                           height_);
        if (visit_.looks_freely != looked_freely && !replay_)
            window_.capture_cursor(visit_.looks_freely);
        gestures_.advance(frame.seconds, visit_, walls);
    }
    for (const Input& input : frame.inputs)
        if (const auto* drop = std::get_if<DropInput>(&input))
            attempt([&] { take_drop(drop->path); });
    if (!gestures_.is_dragging())
        probe_.want(scene_ ? scene_->opened() : nullptr, visit_.edits.shining(), visit_.probed);
    show_panels();
    for (const Command command : std::exchange(visit_.commands, {}))
        attempt([&] { carry_out(command); });
}

void WindowLoop::take_size(const SizeInput& size) {
    if (replay_) {
        window_.resize(size);
        // The desktop takes its time, and may have its own mind.
        for (int k = 0; k < 50 && window_.size().width != size.width; ++k)
            window_.inputs(0.02);
    }
    const SizeInput now = window_.size();
    if (now.width <= 0 || now.height <= 0) return;
    width_ = now.width;
    height_ = now.height;
}

void WindowLoop::show_panels() {
    const PanelSubject subject{visit_,
                               scene_.get(),
                               probe_,
                               history_,
                               loading_ ? &loading_state_ : nullptr,
                               gestures_.handle(),
                               picture_width_,
                               height_};
    show_overlay(subject);
    if (visit_.shows_panel) show_panel(subject);
    show_loading(subject);
    show_help(subject);
}

void WindowLoop::draw(const InputFrame& frame) {
    gl_.bind_framebuffer(GL_FRAMEBUFFER, 0);
    const float darkness[] = {0.02F, 0.02F, 0.02F, 1};
    gl_.clear_bufferfv(GL_COLOR, 0, darkness);
    if (scene_) {
        draw_picture();
        scene_->show();
    }
    panel_.draw();
    for (const Input& input : frame.inputs)
        if (const auto* wanted = std::get_if<PictureInput>(&input)) write(*wanted);
    window_.show();
    for (const Input& input : frame.inputs)
        if (const auto* asked = std::get_if<MemoryInput>(&input))
            write_atomically(asked->path, fmt::format("{}\n", bytes_in_use()));
}

void WindowLoop::draw_picture() {
    UpdateOptions update = visit_.update;
    if (visit_.update_seconds > 0) update.budget = scene_->budget(visit_.update_seconds);
    const bool is_lit_anew =
        scene_->light(visit_.edits.shining(), update, visit_.view.picture == Picture::difference);
    if (visit_.adapts && is_lit_anew) expose();
    const Shown wanted{visit_.camera.camera(), visit_.view, picture_width_, height_};
    const bool changes = is_lit_anew || !shown_ || !is_same(*shown_, wanted);
    if (const auto part = next_part(changes)) {
        FrameView drawn = wanted.view;
        drawn.coarseness = part->coarseness;
        if (part->coarseness > 1) drawn.samples = 1;
        const double begin = steady_seconds();
        scene_->draw(wanted.camera, drawn, wanted.width, wanted.height, part->rows);
        pace_.took(steady_seconds() - begin);
        if (part->rows.to == 1) history_.add(scene_->times());
    }
    shown_ = wanted;
}

std::optional<DrawingPace::Part> WindowLoop::next_part(bool changes) {
    if (!replay_) return pace_.next(changes, steady_seconds());
    // What is replayed shall look the same on every machine.
    return changes ? std::optional(DrawingPace::Part()) : std::nullopt;
}

void WindowLoop::write(const PictureInput& wanted) {
    if (wanted.whole_window)
        write_window_picture(gl_, width_, height_, wanted.path);
    else if (scene_)
        write_picture(*scene_, visit_, picture_width_, height_, wanted.path);
}

void WindowLoop::attempt(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        visit_.say(error.what());
    } catch (const SystemError& error) {
        visit_.say(error.what());
    }
}

void WindowLoop::carry_out(Command command) {
    switch (command) {
        case Command::save_lights:
            save_lights(visit_);
            visit_.say("lights and view are in " + visit_.lights_file);
            break;
        case Command::load_lights:
            take_lights(visit_.lights_file);
            break;
        case Command::picture_png:
            save_picture(".png");
            break;
        case Command::picture_exr:
            save_picture(".exr");
            break;
        case Command::reload:
            open(path_);
            break;
        case Command::save_operator:
            save_operator();
            break;
        case Command::expose:
            if (scene_) expose();
            break;
        case Command::first_camera:
            if (!first_camera_) break;
            first_camera_->set_speed(visit_.camera.speed());
            visit_.camera = *first_camera_;
            break;
        case Command::quit:
            quits_ = true;
            break;
    }
}

void WindowLoop::expose() {
    lightwell::expose(*scene_, visit_, static_cast<double>(picture_width_) / height_);
}

void WindowLoop::save_operator() {
    if (!scene_) return;
    const OpenedOperator& opened = *scene_->opened();
    if (!is_computed(opened.transport)) return visit_.say("there is no operator yet");
    write_operator_file(visit_.operator_file, opened.transport, "{}", opened.lights);
    visit_.say("the operator is in " + visit_.operator_file);
}

void WindowLoop::save_picture(const std::string& extension) {
    if (!scene_) return;
    const std::string path = next_free_name(visit_.picture_stem, extension);
    write_picture(*scene_, visit_, picture_width_, height_, path);
    visit_.say("the picture is in " + path);
}

}  // namespace lightwell
