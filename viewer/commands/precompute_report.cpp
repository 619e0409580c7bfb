#include "viewer/commands/precompute_report.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "viewer/commands/output.h"

namespace lightwell {

namespace {

std::array<std::uint64_t, 3> coefficients_per_channel(const GlobalTransport& transport) {
    std::array<std::uint64_t, 3> count{};
    for (std::size_t c = 0; c < 3; ++c)
        count[c] =
            transport.indirect[static_cast<std::size_t>(transport.channel[c])].coefficients();
    return count;
}

/// Coefficients of H between diffuse and glossy sides, all channels together: by sender, receiver.
nlohmann::ordered_json coefficients_by_transfer(const GlobalTransport& transport) {
    std::vector<bool> glossy(transport.space.functions(), false);
    for (const Element& element : transport.space.elements())
        if (element.angle.levels() > 0)
            std::fill_n(glossy.begin() + element.first, element.functions(), true);
    std::array<std::uint64_t, 4> count{};
    for (const TransportOperator& channel : transport.indirect)
        for (std::uint32_t column = 0; column < channel.size; ++column)
            for (std::uint64_t k = channel.column_start[column];
                 k < channel.column_start[column + 1]; ++k)
                ++count[(glossy[column] ? 2U : 0U) + (glossy[channel.row[k]] ? 1U : 0U)];
    nlohmann::ordered_json json;
    const std::array<const char*, 4> kinds = {"diffuse_to_diffuse", "diffuse_to_glossy",
                                              "glossy_to_diffuse", "glossy_to_glossy"};
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        json[kinds[kind]]["coefficients"] = count[kind];
        // A float and a row number.
        json[kinds[kind]]["bytes"] = 8 * count[kind];
    }
    return json;
}

std::string counts_of_channels(const std::array<std::uint64_t, 3>& count) {
    if (count[0] == count[1] && count[1] == count[2]) return grouped(count[0]);
    return grouped(count[0]) + " / " + grouped(count[1]) + " / " + grouped(count[2]);
}

}  // namespace

std::string json_report(const PrecomputeOutcome& outcome) {
    const Provenance& provenance = outcome.transport.provenance;
    nlohmann::ordered_json json;
    json["quads"] = outcome.transport.scene.quads.size();
    json["elements"] = outcome.report.elements;
    json["sides_dropped"] = outcome.report.blind_sides + outcome.report.inside_of_solids;
    json["cells"] = outcome.report.cells;
    json["cell_size"] = provenance.cell_size;
    json["rays"] = provenance.rays;
    json["links"] = provenance.links;
    json["attempts"] = outcome.report.attempts;
    json["estimate_rays"] = outcome.report.estimate_rays;
    json["links_judged"] = outcome.report.links_judged;
    json["dto_coefficients"] = outcome.transport.bounce.coefficients();
    json["gto_coefficients"] = coefficients_per_channel(outcome.transport);
    if (has_angles(outcome.transport.space))
        json["gto_by_transfer"] = coefficients_by_transfer(outcome.transport);
    json["bytes"] = outcome.bytes;
    json["bounces"] = provenance.bounces;
    json["energy_dropped"] = provenance.energy_dropped;
    json["error_asked"] = provenance.error_asked;
    json["error_estimated"] = provenance.error_estimated;
    json["error_bound"] = provenance.error_bound;
    json["seconds"] = outcome.report.seconds;
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string readable_report(const PrecomputeOutcome& outcome) {
    const GlobalTransport& transport = outcome.transport;
    const Provenance& provenance = transport.provenance;
    const auto line = [](const std::string& name, const std::string& value,
                         const std::string& meaning) {
        return fmt::format("  {:<13} {:>12}  {}\n", name, value, meaning);
    };
    std::string text = fmt::format("{}: how light travels in '{}', for any lamp\n", outcome.file,
                                   transport.scene.name);
    text +=
        line("quads", grouped(transport.scene.quads.size()),
             fmt::format("surfaces of the scene; {} of their sides take part, {} see nothing "
                         "and were dropped",
                         grouped(outcome.report.elements),
                         grouped(outcome.report.blind_sides + outcome.report.inside_of_solids)));
    text += line("cells", grouped(outcome.report.cells),
                 fmt::format("parts of these sides, at most {:.3g} m wide", provenance.cell_size));
    text += line("rays", grouped(provenance.rays), "traced to learn who sees whom");
    text += line("links", grouped(provenance.links), "pairs of cells that exchange light");
    text += line("one bounce", grouped(transport.bounce.coefficients()),
                 "coefficients of the direct transport operator");
    text += line("all bounces", counts_of_channels(coefficients_per_channel(transport)),
                 "coefficients of the global transport operator, for red, green and blue");
    text += line("bounces", std::to_string(provenance.bounces),
                 "followed, until what was left no longer mattered");
    text += line("energy lost", fmt::format("{:.3f} %", 100 * provenance.energy_dropped),
                 "of the indirect light, by leaving out small coefficients");
    text += line("error asked", fmt::format("{:.3g} %", 100 * provenance.error_asked),
                 "of the indirect light, over lamps anywhere in the scene");
    text += line("estimated",
                 provenance.error_estimated > 0 ? percent(provenance.error_estimated) : "-",
                 provenance.error_estimated > 0
                     ? fmt::format("error that was reached, at most {} with 95 % confidence",
                                   percent(provenance.error_bound))
                     : "not measured");
    text += line("file", readable_bytes(outcome.bytes), "with geometry and materials");
    std::string stages;
    for (const auto& [stage, seconds] : outcome.report.seconds)
        if (stage != "total")
            stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", stage, seconds);
    text += line("seconds", fmt::format("{:.2f}", outcome.report.seconds.at("total")), stages);
    return text;
}

}  // namespace lightwell
