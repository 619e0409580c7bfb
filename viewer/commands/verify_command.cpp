#include "viewer/commands/verify_command.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/reference/error_estimate.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/output.h"
#include "viewer/commands/progress_line.h"
#include "viewer/commands/shown_ways.h"
#include "viewer/commands/verify_report.h"

namespace lightwell {

namespace {

/// The judge should be less noisy than what it judges, but no less than pays.
double judge_noise(const Provenance& provenance) {
    constexpr double least = 0.01, most = 0.05, share = 0.5;
    const double error =
        provenance.error_estimated > 0 ? provenance.error_estimated : provenance.error_asked;
    return std::clamp(share * error, least, most);
}

}  // namespace

void run_verify(const VerifyRequest& request) {
    OpenedOperator opened = open_operator(request.operator_file);
    opened.transport.scene = without_emission(std::move(opened.transport.scene));
    VerifyOptions options = request.options;
    options.noise = judge_noise(opened.transport.provenance);
    Verification verification;
    {
        std::optional<ProgressLine> line;
        const Progress progress = progress_on(
            line, request.progress, [](const std::string&, double share) { return share; });
        verification = verify(
            opened.transport.scene, opened.transport.space, opened.visibility, opened.occluders,
            {picture_way(opened), measure_way(opened), textures_way(opened)}, options, progress);
        progress.check();
    }
    const VerifyOutcome outcome{request.operator_file, opened.transport, options, verification};
    print_result(request.json ? json_verdict(outcome) : readable_verdict(outcome));
}

}  // namespace lightwell
