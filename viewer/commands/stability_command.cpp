#include "viewer/commands/stability_command.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "radiance4d/failure.h"
#include "viewer/commands/output.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/stability/stability_rows.h"

namespace lightwell {

namespace {

using stability::Finding;
using stability::StabilityRow;

const char* verdict(const Finding& finding) {
    if (finding.meets()) return "met";
    return finding.holds() ? "known limit" : "FAILED";
}

nlohmann::ordered_json json_of(const StabilityRow& row, const std::vector<Finding>& findings) {
    nlohmann::ordered_json json;
    json["row"] = row.name;
    json["failure"] = row.failure;
    json["scene"] = row.scene;
    for (const Finding& finding : findings) {
        nlohmann::ordered_json one;
        one["what"] = finding.what;
        one["reached"] = finding.reached;
        one["wanted"] = finding.wanted;
        if (finding.known_limit > 0) one["known_limit"] = finding.known_limit;
        one["verdict"] = verdict(finding);
        json["findings"].push_back(one);
    }
    return json;
}

std::string text_of(const StabilityRow& row, const std::vector<Finding>& findings) {
    std::string text = fmt::format("{:<4} {}: {}\n", row.name, row.failure, row.scene);
    for (const Finding& finding : findings) {
        text += fmt::format("     {:<11}  {:>9.3g} of {:<7.3g}  {}", verdict(finding),
                            finding.reached, finding.wanted, finding.what);
        if (finding.known_limit > 0)
            text += fmt::format(" (known limit {:.3g})", finding.known_limit);
        text += '\n';
    }
    return text;
}

}  // namespace

void run_stability(bool json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    int met = 0, limits = 0, failed = 0;
    for (const StabilityRow& row : stability::stability_rows()) {
        if (stop_requested()) throw Interrupted("stopped on request");
        const std::vector<Finding> findings = row.measure();
        for (const Finding& finding : findings)
            ++(finding.meets() ? met : finding.holds() ? limits : failed);
        if (json)
            rows.push_back(json_of(row, findings));
        else
            print_result(text_of(row, findings));
    }
    if (json)
        print_result(nlohmann::ordered_json{
                         {"rows", rows}, {"met", met}, {"known_limits", limits}, {"failed", failed}}
                         .dump(2) +
                     "\n");
    else
        print_result(
            fmt::format("{} criteria met, {} known limits, {} failed\n", met, limits, failed));
    if (failed > 0)
        throw SystemError(fmt::format("{} criteria of the stability table failed", failed));
}

}  // namespace lightwell
