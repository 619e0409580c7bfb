#pragma once

#include <memory>
#include <string>
#include <vector>

#include "viewer/offscreen/gl_context.h"
#include "viewer/window/input.h"

namespace lightwell {

/// A window on the desktop with an OpenGL 3.3 core context, current on return. One at a time, and
/// only on the program's first thread, as GLFW has it.
class GlWindow : public GlContext {
  public:
    /// @param width, height  of its content [pixels]
    /// @throws SystemError if there is no display, or no OpenGL 3.3 on it
    GlWindow(const std::string& title, int width, int height);
    ~GlWindow() override;

    void make_current() override;
    GlFunction function(const char* name) const override;
    std::string description() const override;

    /// What has happened since the last call. Waits for something to happen, but no longer than
    /// `patience` [s].
    std::vector<Input> inputs(double patience);
    /// Shows what was drawn.
    void show();

    bool is_closed() const;
    /// Size of the content [pixels].
    SizeInput size() const;
    /// Asks for another size of the content; the desktop may give one later, or none.
    void resize(const SizeInput& size);
    /// How much larger than usual text and lines must be on this display.
    double scale() const;
    void set_title(const std::string& title);
    /// A captured cursor is hidden and moves without end, for looking around.
    void capture_cursor(bool captured);

  private:
    struct Callbacks;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lightwell
