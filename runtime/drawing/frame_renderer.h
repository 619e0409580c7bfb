#pragma once

#include <memory>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/drawing/frame_view.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/linear_picture.h"
#include "runtime/drawing/texture_atlas.h"

namespace lightwell {

/// How finely lamps look at the scene.
struct FrameRendererOptions {
    /// Side of a face of the cube in which a lamp sees the scene [pixels], at least 16. What a lamp
    /// sees narrower than a pixel of it, 90 / side degrees, may cast no shadow. Edges of shadows
    /// are exact whatever the side.
    int lamp_side = 512;
};

/// Draws a scene in real time: direct light per pixel with shadows, indirect light from textures.
///
/// Direct light of lamps is exact but for what their maps miss: they hold no depths but indices of
/// quads, and a surface point is in shadow if the segment to the lamp passes one of the quads that
/// the map shows round about. So shadows need no bias, at any scale, and their edges are where they
/// belong, smoothed over a pixel of the picture.
///
/// Light of emitting quads is Lambert's formula, exact where all of the quad is seen. Where
/// something may stand between (EmitterShafts), it is summed over 3 x 3 cells of the emitter, each
/// less the share of it that is hidden, estimated edge by edge: 0.2 % off on average in a room with
/// blocks, a few per cent in places of its penumbras.
///
/// The context that the loader belongs to must be current whenever a method is called, and at the
/// end. Every method leaves the framebuffer that it found, and no program or vertex array bound.
class FrameRenderer {
  public:
    /// Keeps no reference to the transport.
    /// @throws SystemError if OpenGL lacks a function or does not accept the shaders.
    FrameRenderer(const GlobalTransport& transport, const GlLoader& loader,
                  const FrameRendererOptions& options = {});
    ~FrameRenderer();
    FrameRenderer(const FrameRenderer&) = delete;
    FrameRenderer& operator=(const FrameRenderer&) = delete;

    /// The lamps to draw with, beside the scene's emitting quads. Only lamps that have moved look
    /// at the scene again.
    void set_lights(const std::vector<Light>& lamps);
    /// The indirect illuminance [lx], one texture per element of the space (Frame::textures). Dark
    /// before the first call.
    void upload(const TextureAtlas& textures);
    /// The same by the exact product, for Picture::difference.
    void upload_exact(const TextureAtlas& textures);

    /// What lobes send towards the eye that draws next, of indirect light and of that of emitting
    /// quads (LobeSynthesis); both are laid out alike. Dark before the first call.
    void upload_lobes(const TextureAtlas& indirect, const TextureAtlas& emitted);

    /// Draws into the framebuffer that is bound, from its lower left corner on, as sRGB-encoded
    /// colours; GL_FRAMEBUFFER_SRGB is switched off. Depth there is neither read nor written.
    /// @param rows  others stay as they are there; all, if the view is coarse
    /// @throws InputError for a camera that cannot be used; SystemError if OpenGL fails.
    void draw(const Camera& camera, const FrameView& view, int width, int height,
              const PictureRows& rows = {});

    /// The same picture before exposure, tone curve and false colours: cd/m2 for total, direct and
    /// indirect, lx for lux, the linear light of a display in [0,1] for the rest.
    /// @throws as draw
    LinearPicture linear(const Camera& camera, const FrameView& view, int width, int height);

    /// The most coefficients of the operator on one side of a quad: the top of the ramp of
    /// Picture::coefficients, which is logarithmic.
    std::uint64_t most_coefficients() const;
    /// The deepest level of a side's cells: the top of the ramp of Picture::level.
    int deepest_level() const;

  private:
    class Drawing;
    std::unique_ptr<Drawing> drawing_;
};

}  // namespace lightwell
