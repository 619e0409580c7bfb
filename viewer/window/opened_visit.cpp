// What a window is opened on, and what comes of it: scenes, their visits, and the end's summary.
#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "radiance4d/failure.h"
#include "solver/reading/mesh_reader.h"
#include "solver/reading/scene_reader.h"
#include "solver/reading/toml_table.h"
#include "viewer/commands/default_camera.h"
#include "viewer/window/files.h"
#include "viewer/window/first_look.h"
#include "viewer/window/window_loop.h"

namespace lightwell {

namespace {

constexpr double far_away = 1e6;  // [m]

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

bool emits(const Scene& scene) {
    return std::any_of(scene.quads.begin(), scene.quads.end(), [&](const SceneQuad& quad) {
        return scene.materials[static_cast<std::size_t>(quad.material)].emission.maxCoeff() > 0;
    });
}

}  // namespace

void WindowLoop::open(const std::string& path) {
    const FileKind kind = kind_of(path);
    if (kind == FileKind::lights)
        throw InputError(Place{path}, "holds lights, not a scene; give it after --lights");
    const bool is_named = path == request_.subject;
    if (is_named && kind == FileKind::operator_file && request_.computation.bare.says_anything())
        throw InputError(Place{path}, "is an operator, and knows its unit");
    SceneComputation how = request_.computation;
    if (!is_named && !is_mesh_file(path)) how.bare = BareGeometry();
    loading_ = std::make_unique<Loading>(
        kind == FileKind::operator_file ? reading_of(path) : precomputation_of(path, how));
    path_ = path;
    if (kind == FileKind::operator_file)
        watch_.emplace(path);
    else
        watch_.reset();
}

void WindowLoop::take_drop(const std::string& path) {
    if (kind_of(path) == FileKind::lights) {
        take_lights(path);
        visit_.lights_file = path;
        return;
    }
    open(path);
    is_new_visit_ = true;
}

void WindowLoop::take_lights(const std::string& path) {
    if (!scene_) return;
    load_lights(path, scene_->opened()->transport.scene.up, visit_);
    const std::size_t count = visit_.edits.lights().size();
    visit_.say(fmt::format("{} {} from {}", count, count == 1 ? "lamp" : "lamps", path));
}

void WindowLoop::take_loaded() {
    if (!loading_) return;
    loading_state_ = loading_->state();
    if (const SharedOperator opened = loading_->take()) enter(opened);
    if (!loading_state_.is_over) return;
    loading_.reset();
    for (const std::string& message : loading_state_.said)
        visit_.say(message);
    if (!loading_state_.failure) return;
    if (!scene_) std::rethrow_exception(loading_state_.failure);
    visit_.say(message_of(loading_state_.failure));
}

void WindowLoop::enter(const SharedOperator& opened) {
    const bool was_lit = !is_new_visit_ && scene_ && is_computed(scene_->opened()->transport);
    auto scene = std::make_unique<LitScene>(opened, window_.loader(),
                                            way_of_projecting(*opened, was_lit), request_.rows);
    if (is_new_visit_) begin_visit(*opened);
    if (visit_.probed && visit_.probed->quad >= static_cast<int>(opened->quads.size()))
        visit_.probed.reset();
    scene_ = std::move(scene);
    shown_.reset();
    walls_.emplace(opened->quads, walker_radius(opened->quads));
    scene_->light(visit_.edits.shining(), visit_.update, false);
    history_.add(scene_->times());
    // Within a frame, when it is known how much of the window the picture has.
    if (!was_lit) visit_.ask(Command::expose);
    window_.set_title("Lightwell: " + opened->transport.scene.name);
    is_new_visit_ = false;
    frames_to_draw_ = frames_after_change;
    if (!is_computed(opened->transport)) return;
    visit_.say(fmt::format("{}: {} quads, computed to {:.3g} %", path_, opened->quads.size(),
                           100 * opened->transport.provenance.error_asked));
    const std::string assumption = assumption_text(path_, request_.computation.bare);
    if (!was_lit && !assumption.empty()) visit_.say(assumption);
}

/// Measuring takes seconds in large scenes: once for a scene, and not for the first look at it.
ProjectionWay WindowLoop::way_of_projecting(const OpenedOperator& opened, bool was_lit) const {
    if (request_.projection != ProjectionWay::fastest) return request_.projection;
    if (was_lit) return scene_->projection();
    return is_computed(opened.transport) ? ProjectionWay::fastest : ProjectionWay::rays;
}

void WindowLoop::begin_visit(const OpenedOperator& opened) {
    const Scene& scene = opened.transport.scene;
    visit_ = Visit(first_camera_of(opened, request_));
    visit_.edits =
        LightEdits(request_.lights ? edited_lights(*request_.lights) : edited(opened.lights));
    if (!visit_.edits.lights().empty()) visit_.selected = 0;
    // In the dark, nobody would find the button that adds a lamp.
    if (visit_.edits.lights().empty() && !emits(scene)) {
        visit_.add_light(opened.visibility, far_away);
        visit_.edits = LightEdits(visit_.edits.lights());  // nobody's edit, for nobody to undo
    }
    // What the command line names is for the first visit.
    request_.lights.reset();
    request_.camera.reset();
    first_camera_ = visit_.camera;
    history_ = StageHistory();
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
