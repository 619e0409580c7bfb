#include "runtime/projection/fastest_projection.h"

#include <gtest/gtest.h>

namespace lightwell {
namespace {

/// Takes a number of seconds, the first time another, on a clock of its own.
class TimedProjection : public LightProjection {
  public:
    TimedProjection(double first, double later, double& clock)
        : seconds_(first), later_(later), clock_(clock) {}

    void project(const std::vector<Light>& lights, PackedField& direct) override {
        EXPECT_EQ(lights.size(), 1U);
        EXPECT_EQ(direct.cols(), 7);
        clock_ += seconds_;
        seconds_ = later_;
    }

  private:
    double seconds_, later_;
    double& clock_;
};

TEST(FastestProjection, CountsTheSecondTime) {
    double now = 100;
    std::vector<std::unique_ptr<LightProjection>> ways;
    ways.push_back(std::make_unique<TimedProjection>(1, 3, now));
    ways.push_back(std::make_unique<TimedProjection>(90, 2, now));
    ways.push_back(std::make_unique<TimedProjection>(1, 2, now));
    const LightProjection* const wanted = ways[1].get();
    const auto chosen = fastest_projection(std::move(ways), {PointLight()}, {PointLight()}, 7,
                                           [&now] { return now; });
    EXPECT_EQ(chosen.get(), wanted);
}

TEST(FastestProjection, NobodyWaitsForAllLightsOfOneThatIsFarTooSlowForFew) {
    double now = 100;
    std::vector<std::unique_ptr<LightProjection>> ways;
    ways.push_back(std::make_unique<TimedProjection>(0.01, 0.01, now));
    ways.push_back(std::make_unique<TimedProjection>(4, 4, now));
    const LightProjection* const wanted = ways[0].get();
    const auto chosen = fastest_projection(std::move(ways), {PointLight()}, {PointLight()}, 7,
                                           [&now] { return now; });
    EXPECT_EQ(chosen.get(), wanted);
    EXPECT_NEAR(now, 108.02, 1e-9);
}

TEST(FastestProjection, TheClockGoesForwards) {
    const double before = steady_seconds();
    EXPECT_GE(steady_seconds(), before);
}

}  // namespace
}  // namespace lightwell
