#include <CLI/CLI.hpp>

#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_info(CLI::App& app, InfoRequest& request) {
    CLI::App* command = app.add_subcommand(
        "info", "say what a .gto file or a scene holds, and what is wrong with it");
    command->add_option("FILE", request.subject, "a .gto file, or a scene as for precompute")
        ->type_name("")
        ->required();
    add_geometry(*command, request.bare);
    command->add_flag("--json", request.json, "print one JSON object");
    return command;
}

}  // namespace lightwell
