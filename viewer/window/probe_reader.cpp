#include "viewer/window/probe_reader.h"

#include <algorithm>
#include <chrono>

#include "viewer/window/lit_scene.h"

namespace lightwell {

ProbeReader::~ProbeReader() {
    give_up();
}

void ProbeReader::want(const SharedOperator& opened, const std::vector<Light>& lights,
                       const std::optional<ProbedPoint>& point) {
    if (!point || !opened) {
        give_up();
        question_.reset();
        reading_.reset();
        return;
    }
    if (is_asked(opened, lights, *point)) return;
    give_up();
    reading_.reset();
    question_ = Question{opened, lights, *point};
    stops_ = std::make_shared<std::atomic<bool>>(false);
    work_ = std::async(std::launch::async, [question = *question_, stops = stops_] {
        return read_probe(*question.opened, question.lights, question.point,
                          [&stops] { return stops->load(); });
    });
}

bool ProbeReader::poll() {
    if (!is_reading() || work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return false;
    reading_ = work_.get();
    return true;
}

bool ProbeReader::is_asked(const SharedOperator& opened, const std::vector<Light>& lights,
                           const ProbedPoint& point) const {
    return question_ && question_->opened == opened && question_->point.quad == point.quad &&
           question_->point.front == point.front && question_->point.position == point.position &&
           shine_alike(question_->lights, lights);
}

/// Ends what goes on; it is at most one bounce away from its end.
void ProbeReader::give_up() {
    if (!is_reading()) return;
    stops_->store(true);
    work_.wait();
    work_ = {};
}

}  // namespace lightwell
