#pragma once

#include <functional>
#include <string>

namespace lightwell {

/// How long work tells the outside where it is, and learns that it should stop. Both members may be
/// empty. They are called from several threads at once.
struct Progress {
    /// Told now and then: the stage's name and the finished share of it in [0,1].
    std::function<void(const std::string& stage, double share)> report;
    /// Asked now and then: true means stop; the work then throws Interrupted.
    std::function<bool()> stop_requested;

    void say(const std::string& stage, double share) const {
        if (report) report(stage, share);
    }
    /// @throws Interrupted if the outside asks to stop.
    void check() const;
};

}  // namespace lightwell
