#pragma once

#include <string>

#include "radiance4d/operator/global_transport.h"
#include "solver/reference/verification.h"

namespace lightwell {

/// What there is to say about a finished verification.
struct VerifyOutcome {
    const std::string& file;
    const GlobalTransport& transport;
    const VerifyOptions& options;
    const Verification& verification;
};

/// One JSON object with the keys that the README documents.
std::string json_verdict(const VerifyOutcome& outcome);

/// The same for people.
std::string readable_verdict(const VerifyOutcome& outcome);

}  // namespace lightwell
