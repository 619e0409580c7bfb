#include <limits>

#include <CLI/CLI.hpp>

#include "viewer/commands/arguments.h"
#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_verify(CLI::App& app, VerifyRequest& request, bool& stability,
                     std::optional<int>& threads) {
    CLI::App* command = app.add_subcommand(
        "verify", "measure the error of a .gto file afresh, with path tracing as the judge");
    CLI::Option* file =
        command->add_option("FILE", request.operator_file, "the .gto file")->type_name("");
    command
        ->add_flag("--stability", stability,
                   "instead of a file: how Lightwell does where methods like it fail; minutes")
        ->excludes(file);
    add_value(*command, "--lights", "N", "lamps to judge, anywhere in the rooms; 40 by default",
              [&request](const std::string& text) {
                  request.options.lights = whole_argument("--lights", text, 4, 100'000);
              });
    add_value(*command, "--points", "N", "surface points to judge for each lamp; 64 by default",
              [&request](const std::string& text) {
                  request.options.points = whole_argument("--points", text, 1, 1'000'000);
              });
    add_value(*command, "--seed", "S", "of lamps, points and paths; 1 by default",
              [&request](const std::string& text) {
                  request.options.seed = static_cast<std::uint64_t>(
                      whole_argument("--seed", text, 0, std::numeric_limits<int>::max()));
              });
    command->add_flag("--json", request.json, "print one JSON object");
    command->add_flag_callback(
        "--no-progress", [&request] { request.progress = false; }, "show no progress");
    add_threads(*command, threads);
    return command;
}

}  // namespace lightwell
