#pragma once

#include <functional>
#include <optional>
#include <string>

#include "viewer/commands/chart_command.h"
#include "viewer/commands/info_command.h"
#include "viewer/commands/measure_command.h"
#include "viewer/commands/precompute_command.h"
#include "viewer/commands/render_command.h"
#include "viewer/commands/verify_command.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lightwell {

// The commands of the program and the options of each, told to a request while the arguments are
// parsed; what is wrong with a value is an InputError. Options are taken as text and read by
// functions of ours: CLI11's own conversion depends on the locale, reads 010 as eight and accepts
// nan. What is referred to must outlive the parsing.

CLI::App* add_precompute(CLI::App& app, PrecomputeRequest& request, std::optional<int>& threads);
CLI::App* add_info(CLI::App& app, InfoRequest& request);
CLI::App* add_measure(CLI::App& app, MeasureRequest& request, std::optional<int>& threads);
CLI::App* add_render(CLI::App& app, RenderRequest& request, std::optional<int>& threads);
/// @param stability  set if the program is to be verified rather than a file
CLI::App* add_verify(CLI::App& app, VerifyRequest& request, bool& stability,
                     std::optional<int>& threads);
CLI::App* add_chart(CLI::App& app, ChartRequest& request, std::optional<int>& threads);

/// An option with one value, told to `take`.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& value_name,
                       const std::string& meaning, std::function<void(const std::string&)> take);
/// --threads
void add_threads(CLI::App& app, std::optional<int>& threads);
/// --unit and --up, which make no sense together with `excluded`
void add_geometry(CLI::App& app, BareGeometry& bare, CLI::Option* excluded = nullptr);
/// --lights
void add_lights(CLI::App& app, std::optional<std::string>& lights);

}  // namespace lightwell
