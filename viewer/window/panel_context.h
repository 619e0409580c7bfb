#pragma once

#include <array>
#include <vector>

#include "viewer/window/gestures.h"
#include "viewer/window/input.h"

namespace lightwell {

/// Dear ImGui, fed with our input and drawn into the current OpenGL 3.3 context. One at a time.
class PanelContext {
  public:
    /// @param scale  of text and lines, 1 on a usual display
    /// @throws SystemError if OpenGL does not accept its shaders
    explicit PanelContext(double scale);
    ~PanelContext();
    PanelContext(const PanelContext&) = delete;
    PanelContext& operator=(const PanelContext&) = delete;

    /// Begins a frame of width x height pixels. Between begin() and draw() ImGui's functions may be
    /// called.
    /// @return what of the input is for the panel
    PanelClaims begin(const InputFrame& frame, int width, int height);
    /// Draws what was asked for into the framebuffer that is bound.
    void draw();

  private:
    std::array<bool, 3> button_held_ = {};
    std::array<bool, key_count> key_held_ = {};
};

}  // namespace lightwell
