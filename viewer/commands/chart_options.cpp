#include <CLI/CLI.hpp>

#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_chart(CLI::App& app, ChartRequest& request, std::optional<int>& threads) {
    CLI::App* command =
        app.add_subcommand("chart", "measure and draw accuracy against cost in a scene");
    command->add_option("SCENE", request.scene, "as for precompute")->type_name("")->required();
    command->add_option("-o,--output", request.output, "folder for charts, tables and a page")
        ->type_name("DIR")
        ->required();
    add_geometry(*command, request.bare);
    command->add_flag("--quick", request.quick, "fewer settings and lamps: a minute or two");
    command->add_flag_callback(
        "--no-progress", [&request] { request.progress = false; }, "show no progress");
    add_threads(*command, threads);
    return command;
}

}  // namespace lightwell
