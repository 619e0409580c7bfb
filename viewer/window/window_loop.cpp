#include "viewer/window/window_loop.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <tuple>
#include <utility>

#include <GL/glcorearb.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "runtime/projection/fastest_projection.h"
#include "solver/reading/input_file.h"
#include "solver/reading/scene_reader.h"
#include "solver/reading/toml_table.h"
#include "viewer/commands/default_camera.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/window/files.h"
#include "viewer/window/panel.h"
#include "viewer/window/recording.h"
#include "viewer/window/window_picture.h"

namespace lightwell {

namespace {

constexpr double idle_patience = 0.1;     // between looks at files and loading [s]
constexpr double usual_frame = 1.0 / 60;  // [s]
constexpr int frames_after_input = 3;     // ImGui needs some to settle
constexpr std::int64_t largest_recording = std::int64_t{64} << 20;

std::optional<std::vector<InputFrame>> replay_of(const ViewRequest& request) {
    if (!request.replay) return std::nullopt;
    return input_from_text(read_text(*request.replay, largest_recording), *request.replay);
}

/// What files of this visit are called by default, in the current folder.
std::string stem_of(const std::string& path) {
    const std::filesystem::path file = std::filesystem::path(path).lexically_normal();
    const bool is_file_in_folder = file.filename() == "scene.toml" && file.has_parent_path();
    const std::filesystem::path named =
        file.has_filename() && !is_file_in_folder ? file : file.parent_path();
    const std::string stem = named.stem().string();
    return stem.empty() ? "lightwell" : stem;
}

WalkCamera first_camera_of(const OpenedOperator& opened, const ViewRequest& request) {
    const Scene& scene = opened.transport.scene;
    if (request.camera) return {read_camera(*request.camera, scene.up), scene.up};
    if (request.lights && TomlTable::read(*request.lights).has("camera"))
        return {read_camera(*request.lights, scene.up), scene.up};
    if (scene.camera) return {*scene.camera, scene.up};
    return {default_camera(scene, opened.transport.space, opened.visibility), scene.up};
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
            frames_to_draw_ = frames_after_input;
        if (pace_.owes_a_fine_picture() || gestures_.is_walking() ||
            (scene_ && !scene_->is_at_rest()))
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
    show_help(visit_);
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
}

void WindowLoop::draw_picture() {
    const bool is_lit_anew = scene_->light(visit_.edits.shining(), visit_.update,
                                           visit_.view.picture == Picture::difference);
    if (visit_.adapts && is_lit_anew) expose();
    const Shown wanted{visit_.camera.camera(), visit_.view, picture_width_, height_};
    const bool changes = is_lit_anew || !shown_ || !is_same(*shown_, wanted);
    const bool was_coarse = pace_.owes_a_fine_picture();
    // What is replayed shall look the same on every machine.
    const int coarseness = replay_ ? 1 : pace_.coarseness(changes, steady_seconds());
    if (changes || (was_coarse && coarseness == 1)) {
        FrameView drawn = wanted.view;
        drawn.coarseness = coarseness;
        if (coarseness > 1) drawn.samples = 1;
        scene_->draw(wanted.camera, drawn, wanted.width, wanted.height);
        pace_.took(scene_->times().drawing);
        history_.add(scene_->times());
    }
    shown_ = wanted;
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
            if (scene_)
                load_lights(visit_.lights_file, scene_->opened()->transport.scene.up, visit_);
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
            if (scene_) write_operator_file(visit_.operator_file, scene_->opened()->transport);
            visit_.say("the operator is in " + visit_.operator_file);
            break;
        case Command::expose:
            if (scene_) expose();
            break;
        case Command::first_camera:
            if (first_camera_) visit_.camera = *first_camera_;
            break;
        case Command::quit:
            quits_ = true;
            break;
    }
}

void WindowLoop::expose() {
    lightwell::expose(*scene_, visit_, static_cast<double>(picture_width_) / height_);
}

void WindowLoop::save_picture(const std::string& extension) {
    if (!scene_) return;
    const std::string path = next_free_name(visit_.picture_stem, extension);
    write_picture(*scene_, visit_, picture_width_, height_, path);
    visit_.say("the picture is in " + path);
}

void WindowLoop::open(const std::string& path) {
    const FileKind kind = kind_of(path);
    if (kind == FileKind::lights)
        throw InputError(Place{path}, "holds lights, not a scene; give it after --lights");
    loading_ = std::make_unique<Loading>(kind == FileKind::operator_file
                                             ? reading_of(path)
                                             : precomputation_of(path, request_.error));
    path_ = path;
    if (kind == FileKind::operator_file)
        watch_.emplace(path);
    else
        watch_.reset();
}

void WindowLoop::take_drop(const std::string& path) {
    if (kind_of(path) == FileKind::lights) {
        if (scene_) load_lights(path, scene_->opened()->transport.scene.up, visit_);
        visit_.lights_file = path;
        return;
    }
    open(path);
    is_new_visit_ = true;
}

void WindowLoop::take_loaded() {
    if (!loading_) return;
    loading_state_ = loading_->state();
    if (const SharedOperator opened = loading_->take()) enter(opened);
    if (!loading_state_.is_over) return;
    loading_.reset();
    if (!loading_state_.failure) return;
    if (!scene_) std::rethrow_exception(loading_state_.failure);
    visit_.say(message_of(loading_state_.failure));
}

void WindowLoop::enter(const SharedOperator& opened) {
    auto scene = std::make_unique<LitScene>(opened, window_.loader());
    if (is_new_visit_) begin_visit(*opened);
    if (visit_.probed && visit_.probed->quad >= static_cast<int>(opened->quads.size()))
        visit_.probed.reset();
    scene_ = std::move(scene);
    shown_.reset();
    walls_.emplace(opened->quads, walker_radius(opened->quads));
    scene_->light(visit_.edits.shining(), visit_.update, false);
    if (is_new_visit_) expose();
    is_new_visit_ = false;
    window_.set_title("Lightwell: " + opened->transport.scene.name);
    const Provenance& provenance = opened->transport.provenance;
    visit_.say(fmt::format("{}: {} quads, computed to {:.3g} %", path_, opened->quads.size(),
                           100 * provenance.error_asked));
    frames_to_draw_ = frames_after_input;
}

void WindowLoop::begin_visit(const OpenedOperator& opened) {
    const Scene& scene = opened.transport.scene;
    visit_ = Visit(first_camera_of(opened, request_));
    visit_.edits = LightEdits(chosen_lights(request_.lights, scene));
    if (!visit_.edits.lights().empty()) visit_.selected = 0;
    // What the command line names is for the first visit.
    request_.lights.reset();
    request_.camera.reset();
    first_camera_ = visit_.camera;
    const std::string stem = stem_of(path_);
    visit_.lights_file = stem + ".lights.toml";
    visit_.picture_stem = stem;
    visit_.operator_file = stem + ".gto";
}

std::string WindowLoop::summary() const {
    using Json = nlohmann::ordered_json;
    const auto triple = [](const auto& v) { return Json::array({v[0], v[1], v[2]}); };
    Json json;
    json["eye"] = triple(visit_.camera.position());
    json["forward"] = triple(visit_.camera.forward());
    json["speed"] = visit_.camera.speed();
    json["size"] = {width_, height_};
    json["picture"] = static_cast<int>(visit_.view.picture) + 1;
    json["exposure"] = visit_.view.exposure;
    json["help"] = visit_.shows_help;
    json["panel"] = visit_.shows_panel;
    json["lights"] = Json::array();
    for (const EditedLight& edited : visit_.edits.lights())
        json["lights"].push_back({{"name", name_of(edited.light)},
                                  {"type", edited.light.index() == 0 ? "point" : "spot"},
                                  {"on", edited.on},
                                  {"dimmer", edited.dimmer},
                                  {"position", triple(position_of(edited.light))},
                                  {"intensity", triple(full_intensity_of(edited.light))}});
    if (visit_.selected) json["selected"] = *visit_.selected;
    if (visit_.probed) json["probed"] = triple(visit_.probed->position);
    if (visit_.probed && probe_.reading())
        json["probe"] = {{"direct", probe_.reading()->direct()},
                         {"indirect", probe_.reading()->indirect()},
                         {"bounces", probe_.reading()->bounces()}};
    json["messages"] = visit_.messages;
    return json.dump(2) + "\n";
}

}  // namespace lightwell
