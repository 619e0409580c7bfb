#pragma once

#include <array>
#include <optional>

#include "viewer/window/handles.h"
#include "viewer/window/input.h"
#include "viewer/window/visit.h"

namespace lightwell {

/// What the panel takes for itself: input that is not meant for the scene.
struct PanelClaims {
    bool mouse = false;
    bool keyboard = false;
};

/// What keys and mouse do to a visit.
///
/// Walking as in Blender's walk mode. The left button takes hold of a light's handle, picks a
/// light, reads a surface's light where it clicks, and looks around where it drags; the right one
/// only looks around. Shortcuts are in help_text().
class Gestures {
  public:
    /// Takes one input for a picture of width x height pixels.
    void take(const Input& input, const PanelClaims& claims, Visit& visit,
              const Visibility& visibility, int width, int height);
    /// Walks on for as long as the keys that are down say. @param walls null: nothing stops
    void advance(double seconds, Visit& visit, const Walls* walls);

    /// The handle under the cursor, or in the hand.
    Handle handle() const { return drag_ ? drag_->handle() : hovered_; }
    /// Whether more frames follow without input: somebody walks.
    bool is_walking() const;
    /// Whether a light is in the hand: it will move on.
    bool is_dragging() const { return drag_.has_value(); }

  private:
    bool held(Key key) const { return held_[static_cast<std::size_t>(key)]; }
    void press(Key key, Visit& visit, const Visibility& visibility);
    void press_with_control(Key key, Visit& visit);
    void press_left(Visit& visit, const CameraRays& rays);
    void release_left(Visit& visit, const Visibility& visibility, const CameraRays& rays);
    void move(const Vec2& to, bool claimed, Visit& visit, const CameraRays& rays);
    void let_go(Visit& visit);

    std::array<bool, key_count> held_ = {};
    std::optional<Vec2> cursor_;   ///< as last told; empty before, and when it may have jumped
    std::optional<Vec2> pressed_;  ///< where the left button went down, on no handle
    std::optional<HandleDrag> drag_;
    Handle hovered_ = Handle::none;
    bool is_looking_ = false;  ///< by a button that is down
};

/// What the keys and the mouse do, for the overlay: pairs of what is done and what it does.
struct HelpLine {
    const char* gesture;
    const char* effect;
};
extern const std::array<HelpLine, 24> help_lines;

}  // namespace lightwell
