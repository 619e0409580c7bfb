#include "viewer/commands/command_options.h"

#include <utility>

#include <CLI/CLI.hpp>

#include "viewer/commands/arguments.h"

namespace lightwell {

namespace {

constexpr int most_threads = 1024;

}  // namespace

CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& value_name,
                       const std::string& meaning, std::function<void(const std::string&)> take) {
    return app.add_option_function<std::string>(name, std::move(take), meaning)
        ->type_name(value_name);
}

void add_threads(CLI::App& app, std::optional<int>& threads) {
    add_value(app, "--threads", "N", "threads to use; as many as the machine has by default",
              [&threads](const std::string& text) {
                  threads = whole_argument("--threads", text, 1, most_threads);
              });
}

void add_geometry(CLI::App& app, BareGeometry& bare, CLI::Option* excluded) {
    CLI::Option* unit = add_value(
        app, "--unit", "UNIT",
        "of bare geometry (.obj, .ply): m (default), cm, mm, in, ft, or its length in metres",
        [&bare](const std::string& text) { bare.metres_per_unit = unit_argument("--unit", text); });
    CLI::Option* up = add_value(
        app, "--up", "AXIS",
        "which axis of bare geometry points up: x, y or z (default); coordinates stay as they are",
        [&bare](const std::string& text) { bare.up = axis_argument("--up", text); });
    if (excluded == nullptr) return;
    unit->excludes(excluded);
    up->excludes(excluded);
}

void add_lights(CLI::App& app, std::optional<std::string>& lights) {
    add_value(app, "--lights", "L.toml", "file with [[light]] tables; the scene's own by default",
              [&lights](const std::string& text) { lights = text; });
}

}  // namespace lightwell
