#include "viewer/commands/verify_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "viewer/commands/output.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Interval& interval) {
    return Json{{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json json_of(const Vec3& place) {
    return Json::array({place[0], place[1], place[2]});
}

Json percentiles_json(const std::array<double, 4>& values, double factor) {
    Json json;
    for (std::size_t k = 0; k < values.size(); ++k)
        json[fmt::format("{:g}", error_percentiles[k])] = factor * values[k];
    return json;
}

Json json_of(const ErrorSize& size) {
    Json json;
    json["relative_l2"] = json_of(size.relative_l2);
    json["bias"] = json_of(size.bias);
    json["percentiles_per_cent"] = percentiles_json(size.relative, 100);
    json["percentiles_lux"] = percentiles_json(size.lux, 1);
    return json;
}

/// Relative error of the worst place [%]; of a dark one, of what is shown there.
double per_cent(const WorstPlace& worst) {
    const double measure = std::max(worst.judged, worst.shown);
    return measure > 0 ? 100 * (worst.shown - worst.judged) / measure : 0;
}

Json json_of(const WorstPlace& worst, const Scene& scene) {
    Json json;
    json["position"] = json_of(worst.point.position);
    json["normal"] = json_of(worst.point.normal);
    json["quad"] = worst.point.quad;
    if (worst.point.quad >= 0) json["material"] = scene.material_of(worst.point.quad).name;
    json["lamp"] = json_of(worst.lamp);
    json["shown_lux"] = worst.shown;
    json["true_lux"] = worst.judged;
    json["noise_lux"] = worst.noise;
    return json;
}

std::string text_of(const Vec3& place) {
    return fmt::format("({:.3f}, {:.3f}, {:.3f})", place[0], place[1], place[2]);
}

std::string text_of(const std::string& what, const ErrorSize& size) {
    const auto in_per_cent = [](const Interval& i) {
        return fmt::format("{:5.2f} % ({:.2f} to {:.2f})", 100 * i.value, 100 * i.low,
                           100 * i.high);
    };
    std::string text = fmt::format("    {:<9} {:<25} bias {}\n", what,
                                   in_per_cent(size.relative_l2), in_per_cent(size.bias));
    text += fmt::format("    {:<9}", "");
    for (std::size_t k = 0; k < error_percentiles.size(); ++k)
        text += fmt::format(" {}{:g} % of surface: {}, {:.2g} lx", k == 0 ? "" : "| ",
                            error_percentiles[k], percent(size.relative[k]), size.lux[k]);
    return text + "\n";
}

std::string meaning_of(const std::string& way) {
    if (way == "picture") return "as the basis shows it, smoothed (what --error is about)";
    if (way == "measure") return "as measure gathers it at each point";
    return "as a moving lamp shows it";
}

}  // namespace

std::string json_verdict(const VerifyOutcome& outcome) {
    const Verification& verification = outcome.verification;
    const Provenance& provenance = outcome.transport.provenance;
    Json json;
    json["file"] = outcome.file;
    json["lights"] = verification.lights;
    json["points"] = outcome.options.points;
    json["seed"] = outcome.options.seed;
    json["rays"] = verification.rays;
    json["judge_noise"] = verification.noise;
    json["confidence"] = 0.95;
    json["lamp_flux"] = verified_flux;
    json["error_asked"] = provenance.error_asked;
    json["error_estimated"] = provenance.error_estimated;
    for (const ShownError& one : verification.shown)
        json[one.name] = Json{{"indirect", json_of(one.indirect)},
                              {"total", json_of(one.total)},
                              {"worst_place", json_of(one.worst, outcome.transport.scene)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string readable_verdict(const VerifyOutcome& outcome) {
    const Verification& verification = outcome.verification;
    const Provenance& provenance = outcome.transport.provenance;
    std::string text = fmt::format(
        "{}: judged by path tracing, {} lamps of {:g} lm, {} places, {} rays; in brackets 95 % "
        "confidence\n",
        outcome.file, verification.lights, verified_flux,
        grouped(static_cast<std::uint64_t>(verification.places)),
        grouped(static_cast<std::uint64_t>(verification.rays)));
    text += fmt::format(
        "  asked {:.3g} %, estimated when it was computed {}\n", 100 * provenance.error_asked,
        provenance.error_estimated > 0 ? percent(provenance.error_estimated) : "not");
    for (const ShownError& one : verification.shown) {
        text += fmt::format("  {}, {}\n", one.name, meaning_of(one.name));
        text += text_of("indirect", one.indirect);
        text += text_of("total", one.total);
        const WorstPlace& worst = one.worst;
        text += fmt::format(
            "    worst     {:.3g} lx instead of {:.3g} lx ({:+.0f} %), at {} on '{}', lamp at {}\n",
            worst.shown, worst.judged, per_cent(worst), text_of(worst.point.position),
            worst.point.quad >= 0 ? outcome.transport.scene.material_of(worst.point.quad).name : "",
            text_of(worst.lamp));
    }
    return text;
}

}  // namespace lightwell
