#pragma once

#include <functional>
#include <optional>

#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// A picture that is kept, so that what lies over it can change without it being drawn again.
class PictureCanvas {
  public:
    /// The context that the loader belongs to must be current here, in all methods, and at the end.
    /// @throws SystemError if OpenGL lacks a function
    explicit PictureCanvas(const GlLoader& loader);

    /// Lets `picture` draw width x height pixels into the framebuffer that is bound then. Leaves
    /// the framebuffer that it found.
    void draw(int width, int height, const std::function<void()>& picture);
    /// Puts what was drawn over the framebuffer that is bound, from its lower left corner on.
    /// Nothing where nothing was drawn.
    void show();

  private:
    struct Images {
        int width, height;
        GlObject colour, framebuffer;
    };

    GlFunctions gl_;
    void (*blit_)(int, int, int, int, int, int, int, int, unsigned, unsigned) = nullptr;
    std::optional<Images> images_;
};

}  // namespace lightwell
