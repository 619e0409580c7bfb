#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "radiance4d/operator/global_transport.h"
#include "solver/precompute.h"

namespace lightwell {

/// What there is to say about a finished precomputation.
struct PrecomputeOutcome {
    const GlobalTransport& transport;
    const PrecomputeReport& report;  ///< its seconds include reading and writing
    std::string file;                ///< that was written
    std::uint64_t bytes = 0;         ///< its size
};

/// One JSON object with the keys that the README documents.
std::string json_report(const PrecomputeOutcome& outcome);

/// The same for people who see such a report for the first time.
std::string readable_report(const PrecomputeOutcome& outcome);

}  // namespace lightwell
