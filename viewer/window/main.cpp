#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/exit_status.h"
#include "viewer/commands/output.h"
#include "viewer/commands/stop_signal.h"
#include "viewer/window/window_loop.h"

namespace lightwell {

namespace {

std::optional<ValueFormat> rows_argument(const std::string& option, const std::string& text) {
    if (text == "fitting") return std::nullopt;
    if (text == "single") return ValueFormat::single;
    if (text == "half") return ValueFormat::half;
    if (text == "byte") return ValueFormat::byte;
    throw InputError(Place{option}, in_quotes(text) + " is not fitting, single, half or byte");
}

/// Has large buffers return to the system when they are freed: glibc would rather keep them after
/// a while, in pieces, and a window in which scenes are opened again and again would grow.
void give_memory_back() {
#ifdef __GLIBC__
    constexpr int large = 1 << 18;  // [bytes]
    mallopt(M_MMAP_THRESHOLD, large);
#endif
}

void view(int argc, char** argv) {
    constexpr int most_threads = 1024;
    CLI::App app{"Walk through a scene in a window and move its lamps.", "lightwell view"};
    ViewRequest request;
    std::optional<int> threads;
    const auto add = [&app](const std::string& name, const std::string& value_name,
                            const std::string& meaning,
                            std::function<void(const std::string&)> take) {
        app.add_option_function<std::string>(name, std::move(take), meaning)->type_name(value_name);
    };
    app.add_option("FILE", request.subject,
                   "a .gto file, or a scene as for precompute, which is computed while you look")
        ->type_name("")
        ->required();
    add("--lights", "L.toml", "file with [[light]] tables, and perhaps a [camera]; the scene's own",
        [&](const std::string& text) { request.lights = text; });
    add("--camera", "C.toml", "file with a [camera]; the scene's own by default",
        [&](const std::string& text) { request.camera = text; });
    add("--size", "WxH", "pixels of the window; 1280x800 by default",
        [&](const std::string& text) { request.size = size_argument("--size", text); });
    add("--error", "E", "relative error that a scene is computed to; 0.05 by default",
        [&](const std::string& text) {
            request.computation.error = error_argument("--error", text);
        });
    add("--unit", "UNIT",
        "of bare geometry (.obj, .ply): m (default), cm, mm, in, ft, or its length in metres",
        [&](const std::string& text) {
            request.computation.bare.metres_per_unit = unit_argument("--unit", text);
        });
    add("--up", "AXIS", "which axis of bare geometry points up: x, y or z (default)",
        [&](const std::string& text) {
            request.computation.bare.up = axis_argument("--up", text);
        });
    add("--max-memory", "SIZE", "memory that computing a scene may take; 8G by default",
        [&](const std::string& text) {
            request.computation.max_memory = memory_argument("--max-memory", text);
        });
    app.add_flag_callback(
        "--scale-albedo", [&] { request.computation.above_one = AlbedoAboveOne::scale; },
        "scale down materials that reflect more light than they receive, instead of refusing the "
        "scene");
    add("--projection", "WAY",
        "of lamps: rays, queries (occlusion queries), or fastest (default), measured at the start",
        [&](const std::string& text) {
            request.projection = projection_argument("--projection", text);
        });
    add("--rows", "FORMAT",
        "how the operator's rows are held: single, half or byte, which take less memory, or "
        "fitting "
        "(default): the smallest that the operator's error allows, where it is not small anyway",
        [&](const std::string& text) { request.rows = rows_argument("--rows", text); });
    add("--threads", "N", "threads to use; as many as the machine has by default",
        [&](const std::string& text) {
            threads = whole_argument("--threads", text, 1, most_threads);
        });
    add("--record", "FILE", "write all input there, for --replay",
        [&](const std::string& text) { request.record = text; });
    add("--replay", "FILE",
        "play recorded input, then print what the visit has come to as JSON, and end",
        [&](const std::string& text) { request.replay = text; });
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        print_result(app.help());
        return;
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{}; see lightwell view --help", error.what()));
    }
    std::optional<tbb::global_control> limit;
    if (threads)
        limit.emplace(tbb::global_control::max_allowed_parallelism,
                      static_cast<std::size_t>(*threads));
    WindowLoop loop(request);
    loop.run();
    if (stop_requested()) throw Interrupted("stopped on request");
    if (request.replay) print_result(loop.summary());
}

}  // namespace

}  // namespace lightwell

int main(int argc, char** argv) {
    lightwell::give_memory_back();
    lightwell::heed_stop_signals();
    return lightwell::exit_status_of([&] { lightwell::view(argc, argv); });
}
