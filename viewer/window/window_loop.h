#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/window/drawing_pace.h"
#include "viewer/window/file_watch.h"
#include "viewer/window/gestures.h"
#include "viewer/window/gl_window.h"
#include "viewer/window/lit_scene.h"
#include "viewer/window/loading.h"
#include "viewer/window/panel_context.h"
#include "viewer/window/probe_reader.h"
#include "viewer/window/stage_times.h"
#include "viewer/window/view_request.h"
#include "viewer/window/visit.h"

namespace lightwell {

/// A visit to a scene in a window, from opening to closing.
class WindowLoop {
  public:
    /// Opens the window and begins to load.
    /// @throws SystemError if there is no display or no OpenGL 3.3, InputError for arguments
    explicit WindowLoop(const ViewRequest& request);
    ~WindowLoop();

    /// Until the window is closed, or what is replayed has ended.
    /// @throws InputError if what the request names cannot be shown; SystemError if OpenGL fails
    void run();

    /// What the visit has come to, as a JSON object: eye, lights, picture, probe, messages.
    std::string summary() const;

  private:
    /// What a picture shows, its light aside.
    struct Shown {
        Camera camera;
        FrameView view;
        int width, height;
    };
    static bool is_same(const Shown& a, const Shown& b);
    static constexpr int frames_after_change = 3;  ///< the panel needs some to settle

    InputFrame next_input();
    void wait_for_rest();
    void take(const InputFrame& frame);
    void take_size(const SizeInput& size);
    void show_panels();
    void draw(const InputFrame& frame);
    void draw_picture();
    std::optional<DrawingPace::Part> next_part(bool changes);
    void expose();
    void write(const PictureInput& wanted);

    void attempt(const std::function<void()>& work);
    void carry_out(Command command);
    void save_operator();
    void save_picture(const std::string& extension);

    void open(const std::string& path);
    void take_drop(const std::string& path);
    void take_lights(const std::string& path);
    void take_loaded();
    void enter(const SharedOperator& opened);
    ProjectionWay way_of_projecting(const OpenedOperator& opened, bool was_lit) const;
    void begin_visit(const OpenedOperator& opened);

    ViewRequest request_;
    GlWindow window_;
    GlFunctions gl_;
    PanelContext panel_;
    std::optional<std::vector<InputFrame>> replay_;
    std::size_t replayed_ = 0;
    std::string recorded_;
    int width_, height_;  ///< of the window's content [pixels]
    int picture_width_;   ///< of the picture beside the panel [pixels]
    DrawingPace pace_;
    std::optional<Shown> shown_;  ///< by the picture that is kept
    double last_frame_;
    int frames_to_draw_ = 3;
    bool quits_ = false;

    std::string path_;  ///< of what is shown, or on its way
    bool is_new_visit_ = true;
    std::optional<FileWatch> watch_;
    std::unique_ptr<Loading> loading_;
    LoadingState loading_state_;
    std::unique_ptr<LitScene> scene_;
    Visit visit_;
    std::optional<WalkCamera> first_camera_;
    std::optional<Walls> walls_;
    Gestures gestures_;
    ProbeReader probe_;
    StageHistory history_;
};

}  // namespace lightwell
