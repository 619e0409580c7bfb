#include "viewer/commands/command_line.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"
#include "viewer/commands/command_options.h"
#include "viewer/commands/exit_status.h"
#include "viewer/commands/output.h"
#include "viewer/commands/stability_command.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/commands/view_command.h"

namespace lightwell {

namespace {

/// Everything that can be asked for.
struct Requests {
    PrecomputeRequest precompute;
    InfoRequest info;
    MeasureRequest measure;
    RenderRequest render;
    VerifyRequest verify;
    bool stability = false;  ///< verify the program rather than a file
    ChartRequest chart;
    std::optional<int> threads;
};

void run_verification(const Requests& requests) {
    if (requests.stability) return run_stability(requests.verify.json);
    if (requests.verify.operator_file.empty())
        throw InputError("verify: FILE is required, or --stability; see lightwell verify --help");
    run_verify(requests.verify);
}

/// The window's program reads what follows, --help included.
CLI::App* add_view(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("view", "walk through a scene in a window and move its lamps");
    command->set_help_flag();
    command->prefix_command();
    return command;
}

/// Refuses a first word that is no command, with a better message than CLI11 has.
void require_known_command(int argc, const char* const* argv, const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    const std::string known = fmt::format("the commands are {}", fmt::join(names, ", "));
    if (argc < 2) throw InputError("no command given; " + known + "; see lightwell --help");
    const std::string word = argv[1];
    if (word.rfind('-', 0) == 0 || std::find(names.begin(), names.end(), word) != names.end())
        return;
    const std::string nearest = nearest_word(word, names);
    throw InputError(fmt::format(
        "no command {}{}; {}", in_quotes(word),
        nearest.empty() ? "" : fmt::format(" (did you mean {}?)", in_quotes(nearest)), known));
}

void run(int argc, const char* const* argv) {
    CLI::App app{"Global illumination for lamps that move: computed once, asked at once.",
                 "lightwell"};
    app.set_version_flag("--version", "lightwell " LIGHTWELL_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit status: 0 success, 1 a mistake in a file or an argument, 2 a failure of the system, "
        "3 "
        "interrupted.\n"
        "lightwell COMMAND --help says more about each.");
    Requests requests;
    const std::pair<CLI::App*, std::function<void()>> commands[] = {
        {add_precompute(app, requests.precompute, requests.threads),
         [&requests] { run_precompute(requests.precompute); }},
        {add_info(app, requests.info), [&requests] { run_info(requests.info); }},
        {add_measure(app, requests.measure, requests.threads),
         [&requests] { run_measure(requests.measure); }},
        {add_render(app, requests.render, requests.threads),
         [&requests] { run_render(requests.render); }},
        {add_verify(app, requests.verify, requests.stability, requests.threads),
         [&requests] { run_verification(requests); }},
        {add_chart(app, requests.chart, requests.threads),
         [&requests] { run_chart(requests.chart); }}};
    const CLI::App* view = add_view(app);
    require_known_command(argc, argv, app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        print_result(app.help());
        return;
    } catch (const CLI::CallForVersion& version) {
        print_result(std::string(version.what()) + "\n");
        return;
    } catch (const CLI::ParseError& error) {
        throw InputError(
            fmt::format("{}; see lightwell {} --help", error.what(), std::string(argv[1])));
    }

    if (view->parsed()) run_view(view->remaining());
    std::optional<tbb::global_control> limit;
    if (requests.threads)
        limit.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(*requests.threads));
    for (const auto& [command, work] : commands)
        if (command->parsed()) work();
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
    heed_stop_signals();
    return exit_status_of([&] { run(argc, argv); });
}

}  // namespace lightwell
