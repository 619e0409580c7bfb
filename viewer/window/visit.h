#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiance4d/scene/visibility.h"
#include "runtime/drawing/frame_view.h"
#include "runtime/propagation/incremental_update.h"
#include "viewer/window/input.h"
#include "viewer/window/light_edits.h"
#include "viewer/window/walk_camera.h"

namespace lightwell {

/// What keys and panel ask for beyond a change of the visit itself.
enum class Command {
    save_lights,  ///< lights and view to Visit::lights_file
    load_lights,  ///< and back
    picture_png,  ///< the picture to the next free file of Visit::picture_stem
    picture_exr,
    reload,         ///< the file that is shown
    save_operator,  ///< what was computed here to Visit::operator_file
    expose,         ///< exposure and lux scale by the picture, once
    first_camera,   ///< back to where the visit began
    quit
};

/// A place on a surface whose light is read.
struct ProbedPoint {
    Vec3 position = Vec3::Zero();  ///< [m]
    int quad = 0;
    bool front = true;
};

/// All that a person who visits a scene has set: where they stand, which lights shine, what is
/// shown.
struct Visit {
    WalkCamera camera;
    LightEdits edits;
    std::optional<std::size_t> selected;  ///< a light
    std::optional<ProbedPoint> probed;

    FrameView view;
    UpdateOptions update;       ///< its budget counts unless there is a time
    double update_seconds = 0;  ///< that a frame's product may take; 0: see the budget
    bool adapts = false;        ///< exposure and lux scale follow the picture all the time
    bool through_walls = false;
    bool shows_panel = true;
    bool shows_handles = true;
    bool shows_help = false;
    bool charts_drawing = true;  ///< the chart of frame times holds the drawing, too
    bool looks_freely = false;   ///< the cursor is captured and turns the view

    std::string lights_file;
    std::string picture_stem;
    std::string operator_file;
    std::vector<Command> commands;      ///< not carried out yet
    std::vector<std::string> messages;  ///< what happened, the newest last
    bool has_news = false;              ///< the newest is shown over the picture

    explicit Visit(const WalkCamera& stands) : camera(stands) {}

    void ask(Command command) { commands.push_back(command); }
    void say(std::string message);
    /// A key or a button that goes down has read the news.
    void heed(const Input& input);
    const EditedLight* selected_light() const;
    /// Adds a light before the eye, at most half way to what is looked at, and selects it.
    /// @param arm  how far away it is at most [m]
    void add_light(const Visibility& visibility, double arm = 1);
    /// The selected light, if any, is removed.
    void remove_selected();
    /// Undo or redo; what changes by it is selected, and the selection dropped where its light is
    /// gone.
    void undo();
    void redo();
};

/// The surface that a ray from the eye along a unit direction meets.
std::optional<ProbedPoint> surface_along(const Visibility& visibility, const Vec3& eye,
                                         const Vec3& direction);

}  // namespace lightwell
