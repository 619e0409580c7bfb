#include <CLI/CLI.hpp>

#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_measure(CLI::App& app, MeasureRequest& request, std::optional<int>& threads) {
    CLI::App* command = app.add_subcommand("measure", "print lux at sensors, as CSV");
    command->add_option("FILE", request.operator_file, "the .gto file")->type_name("")->required();
    CLI::Option* sensors =
        add_value(*command, "--sensors", "S.csv", "rows of x,y,z,nx,ny,nz in metres",
                  [&request](const std::string& text) { request.sensors = text; });
    add_value(*command, "--grid", "NAME", "a sensor grid of the scene, instead of a file",
              [&request](const std::string& text) { request.grid = text; })
        ->excludes(sensors);
    CLI::Option* probes =
        add_value(
            *command, "--probes", "P.csv",
            "rows of x,y,z,dx,dy,dz: radiance seen from a point along a direction, instead of lux",
            [&request](const std::string& text) { request.probes = text; })
            ->excludes(sensors);
    add_lights(*command, request.lights);
    command
        ->add_option("-o,--output", request.output, "CSV file to write; standard output by default")
        ->type_name("OUT.csv");
    CLI::Option* no_gather = command->add_flag_callback(
        "--no-gather", [&request] { request.gather = false; },
        "read indirect light from the basis, without the final gather at each sensor");
    command
        ->add_flag_callback(
            "--spread-lamps", [&request] { request.spread_lamps = true; },
            "take lamps' light on glossy surfaces as if it came from everywhere, as the paper "
            "does, "
            "to compare with; for --probes with --no-gather")
        ->needs(probes)
        ->needs(no_gather);
    add_threads(*command, threads);
    return command;
}

}  // namespace lightwell
