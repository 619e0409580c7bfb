#include "viewer/window/loading.h"

#include <new>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "viewer/commands/progress_line.h"
#include "viewer/commands/scene_argument.h"
#include "viewer/window/first_look.h"

namespace lightwell {

std::string message_of(const std::exception_ptr& failure) {
    try {
        std::rethrow_exception(failure);
    } catch (const std::bad_alloc&) {
        return "the memory of this machine does not suffice";
    } catch (const std::exception& error) {
        return error.what();
    }
}

Loading::Loading(Work work) {
    thread_ = std::thread([this, work = std::move(work)] { run(work); });
}

Loading::~Loading() {
    stops_ = true;
    thread_.join();
}

LoadingState Loading::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

SharedOperator Loading::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(delivered_, nullptr);
}

void Loading::run(const Work& work) {
    std::exception_ptr failure;
    try {
        Desk desk(*this);
        work(desk);
    } catch (const Interrupted&) {
        // Only the owner stops it, and knows.
    } catch (...) {
        failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    state_.is_over = true;
    state_.failure = failure;
}

void Loading::Desk::begin(const std::string& doing) {
    const std::lock_guard lock(loading_.mutex_);
    loading_.state_.doing = doing;
    loading_.state_.share = 0;
}

Progress Loading::Desk::progress() {
    Progress progress;
    progress.stop_requested = [&loading = loading_] { return loading.stops_.load(); };
    progress.report = [&loading = loading_](const std::string& stage, double share) {
        const std::lock_guard lock(loading.mutex_);
        loading.state_.share = share_of_precomputation(stage, share);
    };
    return progress;
}

void Loading::Desk::say(std::string message) {
    const std::lock_guard lock(loading_.mutex_);
    loading_.state_.said.push_back(std::move(message));
}

void Loading::Desk::deliver(OpenedOperator opened) {
    auto shared = std::make_shared<const OpenedOperator>(std::move(opened));
    const std::lock_guard lock(loading_.mutex_);
    loading_.delivered_ = std::move(shared);
}

Loading::Work reading_of(const std::string& path) {
    return [path](Loading::Desk& desk) {
        desk.begin("reading " + path);
        desk.deliver(open_operator(path));
    };
}

Loading::Work precomputation_of(const std::string& path, const SceneComputation& how) {
    return [path, how](Loading::Desk& desk) {
        desk.begin("reading " + path);
        const ReadScene read = read_scene_argument(path, how.above_one, how.bare);
        for (const Warning& warning : read.report.warnings)
            desk.say(warning.to_string());
        // Direct light is there at once.
        desk.deliver(opened(first_look(read.scene), read.lights));
        const std::vector<double> steps = errors_on_the_way(how.error);
        for (const double step : steps) {
            desk.begin(fmt::format("{}computing to {:.3g} %",
                                   step == steps.front() ? "this is direct light; " : "",
                                   100 * step));
            PrecomputeOptions options;
            options.error = step;
            options.max_memory = how.max_memory;
            // What is only on the way need not be judged.
            if (step != how.error) options.most_attempts = 0;
            PrecomputeReport report;
            GlobalTransport transport = precompute(read.scene, options, desk.progress(), report);
            desk.progress().check();
            transport.provenance.program = "lightwell " LIGHTWELL_VERSION;
            desk.deliver(opened(std::move(transport), read.lights));
        }
    };
}

std::vector<double> errors_on_the_way(double error) {
    constexpr double coarsest = 0.3, factor = 3;
    std::vector<double> errors;
    for (double step = coarsest; step > 1.5 * error; step /= factor)
        errors.push_back(step);
    errors.push_back(error);
    return errors;
}

}  // namespace lightwell
