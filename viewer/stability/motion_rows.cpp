#include "viewer/stability/motion_rows.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "runtime/frame.h"
#include "runtime/projection/shadow_projection.h"
#include "viewer/stability/case_scenes.h"
#include "viewer/stability/lit_scene.h"

namespace lightwell::stability {

namespace {

std::unique_ptr<Frame> frame_of(const LitScene& lit) {
    return std::make_unique<Frame>(
        lit.transport(),
        std::make_unique<ShadowProjection>(lit.transport().space, lit.quads(), lit.occluders()));
}

double distance(const PackedField& a, const PackedField& b) {
    return (a - b).matrix().norm() / b.matrix().norm();
}

}  // namespace

// A lamp that moves by a centimetre a frame: what the frame gets wrong must not jump.
std::vector<Finding> flicker() {
    const LitScene lit(office(), 0.05);
    const std::unique_ptr<Frame> frame = frame_of(lit);
    constexpr int steps = 200, every = 97;
    Eigen::ArrayXXd error(steps, lit.transport().space.functions() / every);
    for (int step = 0; step < steps; ++step) {
        const std::vector<Light> lights = {lamp({1.4, 1 + 0.01 * step, 1.9})};
        frame->light(lights);
        const Lighting truth = lit.light(lights);
        const Eigen::ArrayXd found =
            lit.cells(unpacked(PackedField(frame->direct() + frame->indirect())));
        const Eigen::ArrayXd wanted = lit.cells(truth.direct + truth.indirect);
        for (Eigen::Index k = 0; k < error.cols(); ++k)
            error(step, k) = found[every * k] / wanted[every * k] - 1;
    }
    const auto now = error.middleRows(1, steps - 2);
    const Eigen::ArrayXXd second = error.topRows(steps - 2) - 2 * now + error.bottomRows(steps - 2);
    const Eigen::ArrayXXd first = error.bottomRows(steps - 1) - error.topRows(steps - 1);
    return {{"second difference of the error, rms", std::sqrt(second.square().mean()), 2e-3},
            {"largest step of the error", first.abs().maxCoeff(), 5e-3}};
}

// There and back, and a thousand lamps anywhere: X is what it would be from nothing.
std::vector<Finding> ghosting() {
    const LitScene lit(office(), 0.1);
    const std::unique_ptr<Frame> frame = frame_of(lit);
    const std::vector<Light> here = {lamp({1.4, 2.5, 1.9})}, there = {lamp({4, 1, 1})};
    UpdateOptions hurried;
    hurried.budget = 200;
    const auto rest = [&] {
        for (int k = 0; k <= hurried.frames_to_rest; ++k)
            frame->light(here, hurried);
        return frame->indirect();
    };
    const PackedField fresh = rest();
    for (const auto& lights : {there, here})
        frame->light(lights, hurried);
    const double there_and_back = distance(rest(), fresh);
    // Where everything may be multiplied, X is exact in every frame, and rounding may pile up.
    std::mt19937 random(17);
    std::uniform_real_distribution<double> share(0.1, 0.9);
    for (int edit = 0; edit < 1000; ++edit) {
        const double x = 5 * share(random), y = 4 * share(random), z = 3 * share(random);
        frame->light({lamp({x, y, z})});
    }
    frame->light(here);
    const double after_edits = distance(frame->indirect(), fresh);
    return {{"ghost of a lamp that went and came back", there_and_back, 1e-5},
            {"drift after 1,000 edits", after_edits, 1e-5}};
}

}  // namespace lightwell::stability
