#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "viewer/window/loading.h"
#include "viewer/window/probe.h"

namespace lightwell {

/// Reads the probe beside the drawing, so that following ten bounces of ten lamps holds up nobody.
class ProbeReader {
  public:
    ProbeReader() = default;
    ~ProbeReader();
    ProbeReader(const ProbeReader&) = delete;
    ProbeReader& operator=(const ProbeReader&) = delete;

    /// Says what is to be read. If it differs from what was read last, or is being read, that is
    /// begun; the reading there is goes at once.
    void want(const SharedOperator& opened, const std::vector<Light>& lights,
              const std::optional<ProbedPoint>& point);
    /// Takes over what has been read. @return whether that is new
    bool poll();
    bool is_reading() const { return work_.valid(); }
    /// What was wanted last; nothing before it is there.
    const std::optional<ProbeReading>& reading() const { return reading_; }

  private:
    struct Question {
        SharedOperator opened;
        std::vector<Light> lights;
        ProbedPoint point;
    };
    bool is_asked(const SharedOperator& opened, const std::vector<Light>& lights,
                  const ProbedPoint& point) const;
    void give_up();

    std::optional<Question> question_;
    std::optional<ProbeReading> reading_;
    std::future<ProbeReading> work_;
    std::shared_ptr<std::atomic<bool>> stops_;
};

}  // namespace lightwell
