#include "viewer/commands/command_line.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/chart_command.h"
#include "viewer/commands/exit_status.h"
#include "viewer/commands/info_command.h"
#include "viewer/commands/measure_command.h"
#include "viewer/commands/output.h"
#include "viewer/commands/precompute_command.h"
#include "viewer/commands/render_command.h"
#include "viewer/commands/stability_command.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/commands/verify_command.h"
#include "viewer/commands/view_command.h"

namespace lightwell {

namespace {

constexpr int most_threads = 1024;

/// Everything that can be asked for. Options are taken as text and read by functions of ours:
/// CLI11's own conversion depends on the locale, reads 010 as eight and accepts nan.
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

/// An option with one value, told to `take`.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& value_name,
                       const std::string& meaning, std::function<void(const std::string&)> take) {
    return app.add_option_function<std::string>(name, std::move(take), meaning)
        ->type_name(value_name);
}

void add_threads(CLI::App& app, Requests& requests) {
    add_value(app, "--threads", "N", "threads to use; as many as the machine has by default",
              [&requests](const std::string& text) {
                  requests.threads = whole_argument("--threads", text, 1, most_threads);
              });
}

void add_geometry(CLI::App& app, BareGeometry& bare, CLI::Option* excluded = nullptr) {
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

CLI::App* add_precompute(CLI::App& app, Requests& requests) {
    PrecomputeRequest& request = requests.precompute;
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
    add_value(*command, "--oracle", "NAME",
              "how links are refined: geometric (default), or variation, the baseline of the paper",
              [&options](const std::string& text) {
                  options.oracle = oracle_argument("--oracle", text);
              });
    add_threads(*command, requests);
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

CLI::App* add_info(CLI::App& app, Requests& requests) {
    CLI::App* command = app.add_subcommand(
        "info", "say what a .gto file or a scene holds, and what is wrong with it");
    command->add_option("FILE", requests.info.subject, "a .gto file, or a scene as for precompute")
        ->type_name("")
        ->required();
    add_geometry(*command, requests.info.bare);
    command->add_flag("--json", requests.info.json, "print one JSON object");
    return command;
}

CLI::App* add_measure(CLI::App& app, Requests& requests) {
    MeasureRequest& request = requests.measure;
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
    add_threads(*command, requests);
    return command;
}

CLI::App* add_render(CLI::App& app, Requests& requests) {
    RenderRequest& request = requests.render;
    CLI::App* command = app.add_subcommand("render", "draw a picture, without a display");
    command->add_option("FILE", request.operator_file, "the .gto file")->type_name("")->required();
    command->add_option("-o,--output", request.output, "picture to write")
        ->type_name("P.png|P.exr")
        ->required();
    add_lights(*command, request.lights);
    add_value(*command, "--camera", "C.toml", "file with a [camera]; the scene's own by default",
              [&request](const std::string& text) { request.camera = text; });
    add_value(
        *command, "--size", "WxH", "pixels; 960x720 by default",
        [&request](const std::string& text) { request.size = size_argument("--size", text); });
    add_value(*command, "--exposure", "EV",
              "stops brighter (or darker, if negative) than the automatic exposure of a PNG",
              [&request](const std::string& text) {
                  request.exposure = number_argument("--exposure", text);
              });
    add_value(
        *command, "--view", "VIEW",
        "total (default), direct, indirect, lux (false colour), level (the wavelet mesh), "
        "coefficients (of the operator, by quad)",
        [&request](const std::string& text) { request.view = view_argument("--view", text); });
    CLI::Option* no_gather = command->add_flag_callback(
        "--no-gather", [&request] { request.indirect = IndirectLight::smooth; },
        "show indirect light as the basis holds it, without gathering it once more at every cell: "
        "faster, less even");
    command
        ->add_flag_callback(
            "--textures", [&request] { request.indirect = IndirectLight::textures; },
            "show indirect light as a moving lamp does, from one texture per quad: fastest, with "
            "the whole error of the stored operator")
        ->excludes(no_gather);
    command->add_flag("--live", request.live,
                      "draw as a window does, in tenths of a second: what --textures "
                      "shows, with shadows smoothed over a pixel");
    add_value(*command, "--path", "PATH.toml",
              "[[camera]] and [[light]] keyframes: draws numbered pictures along them, as --live",
              [&request](const std::string& text) { request.path = text; });
    add_value(*command, "--opengl", "NAME",
              "what draws: osmesa (default), the processor, or egl, graphics hardware if there is",
              [&request](const std::string& text) {
                  request.opengl = opengl_argument("--opengl", text);
              });
    add_value(*command, "--projection", "WAY",
              "of lamps, in live pictures: rays (default), queries (occlusion queries), or fastest "
              "of the two here",
              [&request](const std::string& text) {
                  request.projection = projection_argument("--projection", text);
              });
    command->add_flag("--contours", request.contours, "contour lines in --view lux");
    add_value(*command, "--samples", "N", "samples a side in every pixel; 2 by default",
              [&request](const std::string& text) {
                  request.samples = whole_argument("--samples", text, 1, 16);
              });
    add_threads(*command, requests);
    return command;
}

CLI::App* add_verify(CLI::App& app, Requests& requests) {
    VerifyRequest& request = requests.verify;
    CLI::App* command = app.add_subcommand(
        "verify", "measure the error of a .gto file afresh, with path tracing as the judge");
    command->add_option("FILE", request.operator_file, "the .gto file")->type_name("");
    command->add_flag("--stability", requests.stability,
                      "instead of a file: how Lightwell does where methods like it fail; minutes");
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
    add_threads(*command, requests);
    return command;
}

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

CLI::App* add_chart(CLI::App& app, Requests& requests) {
    ChartRequest& request = requests.chart;
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
    add_threads(*command, requests);
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
        {add_precompute(app, requests), [&requests] { run_precompute(requests.precompute); }},
        {add_info(app, requests), [&requests] { run_info(requests.info); }},
        {add_measure(app, requests), [&requests] { run_measure(requests.measure); }},
        {add_render(app, requests), [&requests] { run_render(requests.render); }},
        {add_verify(app, requests), [&requests] { run_verification(requests); }},
        {add_chart(app, requests), [&requests] { run_chart(requests.chart); }}};
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
