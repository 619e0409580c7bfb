#pragma once

#include <memory>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "runtime/outgoing/lobe_synthesis.h"
#include "runtime/outgoing/texture_synthesis.h"
#include "runtime/projection/light_projection.h"
#include "runtime/propagation/incremental_update.h"

namespace lightwell {

/// What a frame's light cost, stage by stage.
struct FrameReport {
    double projection_seconds = 0;   ///< lamps to E
    double propagation_seconds = 0;  ///< E to X = H E
    double synthesis_seconds = 0;    ///< X to textures
    UpdateReport update;
    std::size_t textures = 0;  ///< synthesised in this frame
    double lobe_seconds = 0;   ///< X to what lobes send towards the eye
    std::size_t lobes = 0;     ///< elements whose lobes were looked at anew for the eye
};

/// The online pipeline: E of the lamps, X = H E, textures of the indirect illuminance. What is left
/// to whoever draws is direct light, and reflectance / pi.
///
/// A frame allocates nothing once scratch space has grown to what the scene needs.
class Frame {
  public:
    /// Keeps no reference to the transport, to whose space the projection must belong.
    Frame(const GlobalTransport& transport, std::unique_ptr<LightProjection> projection,
          ValueFormat format = ValueFormat::single);
    Frame(const Frame&) = delete;
    Frame& operator=(const Frame&) = delete;

    /// Lights the scene with these lamps, beside its own emitting quads.
    const FrameReport& light(const std::vector<Light>& lamps, const UpdateOptions& options = {});
    /// Brings what glossy surfaces send towards the eye up to date, after light() or where the eye
    /// has moved. Scenes without gloss cost nothing.
    const FrameReport& look(const Vec3& eye);
    bool is_glossy() const { return lobes_.is_needed(); }

    /// E with the emitting quads' share, and X = H E.
    const PackedField& direct() const { return direct_; }
    const PackedField& indirect() const { return update_.indirect(); }
    /// Indirect illuminance [lx], one texture per element of the space.
    const TextureAtlas& textures() const { return synthesis_.atlas(); }
    /// Luminance that lobes send towards the eye [cd/m2], of indirect light and of that of emitting
    /// quads, one texture per element of the space.
    const TextureAtlas& lobes() const { return lobes_.atlas(); }
    const TextureAtlas& emitted_lobes() const { return emitted_lobes_.atlas(); }

  private:
    std::unique_ptr<LightProjection> projection_;
    GlobalPropagation propagation_;
    IncrementalUpdate update_;
    TextureSynthesis synthesis_;
    LobeSynthesis lobes_, emitted_lobes_;
    PackedField emitted_;  ///< the emitting quads' share of E
    PackedField direct_;
    FrameReport report_;
};

}  // namespace lightwell
