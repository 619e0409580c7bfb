#include "viewer/commands/resumed_precompute.h"

#include <nlohmann/json.hpp>

#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"

namespace lightwell {

namespace {

/// A number that was set by hand, unless it is set anew.
void take_number(const nlohmann::json& json, const char* key, std::optional<double>& number) {
    const auto found = json.find(key);
    if (!number && found != json.end() && found->is_number()) number = found->get<double>();
}

}  // namespace

std::string options_json(const PrecomputeOptions& options) {
    nlohmann::ordered_json json;
    json["error"] = options.error;
    json["oracle"] = options.oracle == OracleKind::geometric ? "geometric" : "variation";
    if (options.cell_size) json["cell_size"] = *options.cell_size;
    if (options.oracle_tolerance) json["oracle_tolerance"] = *options.oracle_tolerance;
    if (options.truncation) json["truncation"] = *options.truncation;
    if (options.diffuse) json["diffuse"] = true;
    json["attempts"] = options.most_attempts;
    return json.dump();
}

ReadScene take_up(PrecomputeRequest& request) {
    const OperatorFileInfo info = inspect_operator_file(request.resumed);
    const nlohmann::json asked = nlohmann::json::parse(info.options_json);
    PrecomputeOptions& options = request.options;
    if (!request.is_error_given) options.error = info.provenance.error_asked;
    if (!(options.error > 0))
        throw InputError(request.resumed +
                         ": it does not say which error it was computed for; say --error");
    options.oracle =
        info.provenance.oracle == "variation" ? OracleKind::variation : OracleKind::geometric;
    take_number(asked, "cell_size", options.cell_size);
    take_number(asked, "oracle_tolerance", options.oracle_tolerance);
    take_number(asked, "truncation", options.truncation);
    options.diffuse = options.diffuse || asked.value("diffuse", false);
    options.earlier = info.provenance;
    if (request.output.empty()) request.output = request.resumed;
    return {info.scene, info.lights, {}};
}

}  // namespace lightwell
