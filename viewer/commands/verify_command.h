#pragma once

#include <string>

#include "solver/reference/verification.h"

namespace lightwell {

/// What `lightwell verify` was asked for.
struct VerifyRequest {
    std::string operator_file;  ///< .gto
    VerifyOptions options;
    bool json = false;     ///< the verdict as one JSON object
    bool progress = true;  ///< a progress line, where standard error is a terminal
};

/// Measures the error of an operator file afresh and prints it on standard output; progress goes to
/// standard error.
/// @throws as read_operator_file and verify
void run_verify(const VerifyRequest& request);

}  // namespace lightwell
