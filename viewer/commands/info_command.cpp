#include "viewer/commands/info_command.h"

#include <array>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "radiance4d/operator/operator_file.h"
#include "solver/reading/diagnosis.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/output.h"
#include "viewer/commands/scene_argument.h"

namespace lightwell {

namespace {

using Json = nlohmann::ordered_json;

/// Whether a file's name, or its first bytes, say that it holds an operator.
bool is_operator_file(const std::string& path) {
    const std::string ending = ".gto";
    if (path.size() >= ending.size() &&
        path.compare(path.size() - ending.size(), ending.size(), ending) == 0)
        return true;
    std::array<char, 4> start{};
    std::ifstream file(path, std::ios::binary);
    file.read(start.data(), start.size());
    return file && std::string(start.data(), start.size()) == "\x89GTO";
}

Json strings(const std::vector<std::string>& names) {
    Json list = Json::array();
    for (const std::string& name : names)
        list.push_back(name);
    return list;
}

std::vector<std::string> light_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const Light& light : scene.lights)
        names.push_back(name_of(light));
    return names;
}

std::vector<std::string> material_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const Material& material : scene.materials)
        names.push_back(material.name);
    return names;
}

std::vector<std::string> grid_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const SensorGrid& grid : scene.sensor_grids)
        names.push_back(grid.name);
    return names;
}

/// "3 (lamp, desk, spot)"
std::string counted_names(const std::vector<std::string>& names) {
    return fmt::format("{}{}", names.size(),
                       names.empty() ? "" : fmt::format(" ({})", fmt::join(names, ", ")));
}

Json scene_json(const Scene& scene) {
    Json json;
    json["name"] = scene.name;
    json["geometry"] = scene.geometry_file;
    json["quads"] = scene.quads.size();
    json["materials"] = strings(material_names(scene));
    json["lights"] = strings(light_names(scene));
    json["sensor_grids"] = strings(grid_names(scene));
    json["camera"] = scene.camera.has_value();
    return json;
}

std::string scene_text(const Scene& scene) {
    std::string text = fmt::format("scene '{}' ({})\n", scene.name, scene.geometry_file);
    text += fmt::format("  quads         {}\n", grouped(scene.quads.size()));
    text += fmt::format("  materials     {}\n", counted_names(material_names(scene)));
    text += fmt::format("  lights        {}\n", counted_names(light_names(scene)));
    text += fmt::format("  sensor grids  {}\n", counted_names(grid_names(scene)));
    text += fmt::format("  camera        {}\n", scene.camera ? "yes" : "no");
    return text;
}

std::array<std::uint64_t, 3> gto_coefficients(const OperatorFileInfo& info) {
    std::array<std::uint64_t, 3> count{};
    for (std::size_t c = 0; c < 3; ++c)
        count[c] = info.gto_coefficients[static_cast<std::size_t>(info.channel[c])];
    return count;
}

Json operator_json(const OperatorFileInfo& info) {
    const Provenance& provenance = info.provenance;
    Json json;
    json["kind"] = "operator";
    json["version"] = info.version;
    json["bytes"] = info.bytes;
    json["scene_hash"] = fmt::format("{:016x}", info.scene_hash);
    json["scene"] = scene_json(info.scene);
    json["quads"] = info.scene.quads.size();
    json["elements"] = info.elements;
    json["cells"] = info.functions;
    json["dto_coefficients"] = info.dto_coefficients;
    json["gto_coefficients"] = gto_coefficients(info);
    json["program"] = provenance.program;
    json["options"] = Json::parse(info.options_json);
    json["oracle"] = provenance.oracle;
    json["error_asked"] = provenance.error_asked;
    json["error_estimated"] = provenance.error_estimated;
    json["error_bound"] = provenance.error_bound;
    json["error_basis"] = provenance.error_basis;
    json["cell_size"] = provenance.cell_size;
    json["oracle_tolerance"] = provenance.oracle_tolerance;
    json["truncation"] = provenance.truncation;
    json["rays"] = provenance.rays;
    json["links"] = provenance.links;
    json["bounces"] = provenance.bounces;
    json["energy_dropped"] = provenance.energy_dropped;
    Json chunks = Json::array();
    for (const ChunkSummary& chunk : info.chunks)
        chunks.push_back(
            Json{{"tag", chunk.tag}, {"stored", chunk.stored}, {"content", chunk.content}});
    json["chunks"] = chunks;
    return json;
}

/// "4.6 %, at most 5.5 % (by path tracing ...)"
std::string reached_text(const Provenance& provenance) {
    if (!(provenance.error_estimated > 0))
        return "not measured; lightwell verify does, where there is room for lamps";
    std::string text = percent(provenance.error_estimated);
    if (provenance.error_bound > 0) text += ", at most " + percent(provenance.error_bound);
    return provenance.error_basis.empty() ? text : text + " (" + provenance.error_basis + ")";
}

std::string operator_text(const std::string& path, const OperatorFileInfo& info) {
    const Provenance& provenance = info.provenance;
    const auto gto = gto_coefficients(info);
    std::string text = fmt::format("{}: light transport, {}, format {}, scene hash {:016x}\n", path,
                                   readable_bytes(info.bytes), info.version, info.scene_hash);
    text += scene_text(info.scene);
    text +=
        fmt::format("  sides         {} of the quads take part, in {} cells of at most {:.3g} m\n",
                    grouped(info.elements), grouped(info.functions), provenance.cell_size);
    text += fmt::format("  one bounce    {} coefficients\n", grouped(info.dto_coefficients));
    text +=
        fmt::format("  all bounces   {} / {} / {} coefficients (red, green, blue), {} bounces\n",
                    grouped(gto[0]), grouped(gto[1]), grouped(gto[2]), provenance.bounces);
    text += fmt::format("  error asked   {:.3g} % of the indirect light, as a picture shows it\n",
                        100 * provenance.error_asked);
    text += "  error reached " + reached_text(provenance) + "\n";
    text += fmt::format("  computed by   {}, {} oracle, {} rays, {} links\n", provenance.program,
                        provenance.oracle, grouped(provenance.rays), grouped(provenance.links));
    return text;
}

/// The key of a defect: its name with underscores, "open_edges".
std::string key_of(Defect defect) {
    std::string key = name_of(defect);
    for (char& c : key) {
        if (c == ' ' || c == '-') c = '_';
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return key;
}

Json diagnosis_json(const Diagnosis& diagnosis) {
    Json json;
    for (const Finding& finding : diagnosis.findings)
        json[key_of(finding.defect)] = Json{{"count", finding.count},
                                            {"left_out", finding.left_out},
                                            {"matters", finding.matters},
                                            {"meaning", finding.meaning},
                                            {"quads", finding.examples}};
    json["surfaces"] = diagnosis.surfaces;
    json["closed_surfaces"] = diagnosis.closed_surfaces;
    json["complete"] = diagnosis.complete;
    return json;
}

Diagnosis diagnosis_of(const ReadScene& read) {
    return with_left_out(diagnose(read.scene), read.report.counts);
}

Json reading_json(const ReadScene& read) {
    const PolygonCounts& counts = read.report.counts;
    Json json;
    json["kind"] = "scene";
    json["scene"] = scene_json(read.scene);
    json["quads"] = read.scene.quads.size();
    json["faces"] = counts.faces;
    json["kept_quads"] = counts.quads;
    json["triangles"] = counts.triangles;
    json["larger"] = counts.larger;
    json["concave"] = counts.concave;
    json["bent"] = counts.bent;
    json["flattened"] = counts.flattened;
    json["degenerate"] = counts.degenerate;
    json["crossing"] = counts.crossing;
    json["pairs"] = counts.pairs;
    json["cut"] = counts.cut;
    json["cut_along_walls"] = counts.along_walls;
    json["pieces"] = counts.pieces;
    json["copies"] = counts.copies;
    Json warnings = Json::array();
    for (const Warning& warning : read.report.warnings)
        warnings.push_back(warning.to_string());
    json["warnings"] = warnings;
    json["diagnosis"] = diagnosis_json(diagnosis_of(read));
    return json;
}

std::string reading_text(const ReadScene& read) {
    std::string text = scene_text(read.scene) + to_string(read.report.counts) + "\n";
    for (const Warning& warning : read.report.warnings)
        text += "warning: " + warning.to_string() + "\n";
    return text + to_string(diagnosis_of(read), read.scene);
}

std::string printed(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void run_info(const InfoRequest& request) {
    if (is_operator_file(request.subject)) {
        if (request.bare.says_anything())
            throw InputError(Place{request.subject}, "is an operator, and knows its unit");
        const OperatorFileInfo info = inspect_operator_file(request.subject);
        print_result(request.json ? printed(operator_json(info))
                                  : operator_text(request.subject, info));
    } else {
        const ReadScene read =
            read_scene_argument(request.subject, AlbedoAboveOne::scale, request.bare);
        const std::string assumption = assumption_text(request.subject, request.bare);
        if (!assumption.empty()) print_message(assumption);
        print_result(request.json ? printed(reading_json(read)) : reading_text(read));
    }
}

}  // namespace lightwell
