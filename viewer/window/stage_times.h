#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace lightwell {

/// Seconds that a frame took, stage by stage. A stage that was not needed took none.
struct StageTimes {
    double projection = 0;   ///< lamps to E
    double propagation = 0;  ///< E to X by the global transport operator
    double synthesis = 0;    ///< X to textures, the product with the BRDF of glossy surfaces in it
    double upload = 0;       ///< textures and lamps to OpenGL, shadows
    double drawing = 0;      ///< the picture

    static constexpr std::size_t stages = 5;
    std::array<double, stages> in_order() const {
        return {projection, propagation, synthesis, upload, drawing};
    }
};
constexpr std::array<const char*, StageTimes::stages> stage_names = {
    "projection", "GTO", "BRDF, synthesis", "upload", "drawing"};

/// The last frames' times, for a chart.
class StageHistory {
  public:
    static constexpr std::size_t length = 120;  ///< frames

    void add(const StageTimes& times);
    /// Oldest first; at most `length`.
    std::vector<StageTimes> frames() const;
    /// The median of a stage over the frames that needed it; 0 if none did.
    double median(std::size_t stage) const;

  private:
    std::vector<StageTimes> ring_;
    std::size_t next_ = 0;
};

}  // namespace lightwell
