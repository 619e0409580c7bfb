#include <CLI/CLI.hpp>

#include "viewer/commands/arguments.h"
#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_precompute(CLI::App& app, PrecomputeRequest& request, std::optional<int>& threads) {
    CLI::App* command =
        app.add_subcommand("precompute", "compute once how light travels in a scene");
    CLI::Option* scene = command
                             ->add_option("SCENE", request.scene,
                                          "scene.toml, .obj, .ply, or a folder with a scene.toml")
                             ->type_name("");
    CLI::Option* resumed =
        command
            ->add_option("--resume", request.resumed,
                         "a file to go on from, instead of a scene: to its error, or a smaller one")
            ->type_name("FILE.gto")
            ->excludes(scene);
    CLI::Option* output = command
                              ->add_option("-o,--output", request.output,
                                           "the file to write; with --resume, that file by default")
                              ->type_name("FILE.gto");
    add_geometry(*command, request.bare, resumed);
    // CLI11 has no "one of these", and its own words would name neither.
    command->final_callback([scene, resumed, output] {
        if (scene->empty() && resumed->empty()) throw CLI::RequiredError("SCENE or --resume");
        if (output->empty() && resumed->empty()) throw CLI::RequiredError("--output");
    });
    PrecomputeOptions& options = request.options;
    add_value(*command, "--error", "E",
              "relative error of the indirect light, over lamps anywhere; 0.05 by default",
              [&request](const std::string& text) {
                  request.options.error = error_argument("--error", text);
                  request.is_error_given = true;
              });
    add_value(
        *command, "--oracle", "NAME",
        "how links are refined: geometric (default), or variation, the baseline of the paper",
        [&options](const std::string& text) { options.oracle = oracle_argument("--oracle", text); })
        ->excludes(resumed);
    add_threads(*command, threads);
    add_value(*command, "--max-memory", "SIZE", "memory that may be taken; 8G by default",
              [&options](const std::string& text) {
                  options.max_memory = memory_argument("--max-memory", text);
              });
    command->add_flag_callback(
        "--scale-albedo", [&request] { request.above_one = AlbedoAboveOne::scale; },
        "scale down materials that reflect more light than they receive, instead of refusing them");
    command->add_flag("--json", request.json, "print the report as one JSON object");
    command->add_flag("-q,--quiet", request.quiet, "print nothing but errors, and --json");
    command->add_flag_callback(
        "--no-progress", [&request] { request.progress = false; }, "show no progress");
    command->add_flag_callback(
        "--diffuse", [&options] { options.diffuse = true; },
        "compute glossy materials as diffuse ones of equal albedo");
    const std::string by_hand = "Set by hand (they follow from --error otherwise)";
    add_value(*command, "--attempts", "N",
              "operators that may be built to reach the error; 0 builds one and does not judge it",
              [&options](const std::string& text) {
                  options.most_attempts = whole_argument("--attempts", text, 0, 100);
              })
        ->group(by_hand);
    add_value(*command, "--cell-size", "METRES", "largest side of a finest cell",
              [&options](const std::string& text) {
                  options.cell_size = positive_argument("--cell-size", text);
              })
        ->group(by_hand);
    add_value(*command, "--oracle-tolerance", "T", "tolerance of the oracle",
              [&options](const std::string& text) {
                  options.oracle_tolerance = non_negative_argument("--oracle-tolerance", text);
              })
        ->group(by_hand);
    add_value(*command, "--truncation", "E",
              "relative error from coefficients left out; 0 keeps all",
              [&options](const std::string& text) {
                  options.truncation = non_negative_argument("--truncation", text);
              })
        ->group(by_hand);
    return command;
}

}  // namespace lightwell
