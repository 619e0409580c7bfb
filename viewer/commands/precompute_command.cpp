#include "viewer/commands/precompute_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "radiance4d/scene/brdf.h"
#include "solver/radiance_bounce.h"
#include "solver/reading/input_file.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/output.h"
#include "viewer/commands/precompute_report.h"
#include "viewer/commands/progress_line.h"
#include "viewer/commands/resumed_precompute.h"
#include "viewer/commands/scene_argument.h"

namespace lightwell {

namespace {

/// Runs some work and adds its time to a stage and to the total.
template <typename Work>
auto timed(std::map<std::string, double>& seconds, const std::string& stage, const Work& work) {
    struct Lap {
        std::map<std::string, double>& seconds;
        const std::string& stage;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Lap() {
            const double passed =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            seconds[stage] += passed;
            seconds["total"] += passed;
        }
    };
    const Lap lap{seconds, stage};
    return work();
}

/// Says which lobes are narrower than their representation can follow at the error asked for.
void warn_of_gloss(const Scene& scene, const PrecomputeOptions& options) {
    if (options.diffuse) return;
    for (const AngularNeed& need : angular_needs(scene, options.lobes, options.error))
        if (!need.follows)
            print_message(fmt::format(
                "warning: {}: its reflections are too sharp for --error {:.3g}: with the finest "
                "directions there are, light that it reflects is off by {:.0f} %, mostly within "
                "its "
                "highlights. What an eye sees in it directly is sharper.",
                in_quotes(need.material), options.error, 100 * need.finest_error));
}

/// Says what bright materials do to what is stored.
void warn_of_brightness(const Scene& scene) {
    constexpr double bright = 0.95;
    std::string names;
    for (const Material& material : scene.materials)
        if (mean_albedo(material).maxCoeff() > bright)
            names += (names.empty() ? "" : ", ") + in_quotes(material.name);
    if (!names.empty())
        print_message(fmt::format(
            "warning: {}: more than {:.0f} % of light is reflected; where all is that bright, a "
            "moving lamp's light may be off by a per cent as a whole. measure and render gather "
            "it anew and keep the balance",
            names, 100 * bright));
}

GlobalTransport compute(const Scene& scene, const PrecomputeRequest& request,
                        PrecomputeReport& report) {
    std::optional<ProgressLine> line;
    const Progress progress =
        progress_on(line, request.progress && !request.quiet, share_of_precomputation);
    PrecomputeOptions options = request.options;
    options.preview = true;
    GlobalTransport transport = precompute(scene, options, progress, report);
    transport.provenance.program = "lightwell " LIGHTWELL_VERSION;
    return transport;
}

/// The scene, and what is to be said about it.
ReadScene read_scene_of(PrecomputeRequest& request) {
    if (!request.resumed.empty()) return take_up(request);
    ReadScene read = read_scene_argument(request.scene, request.above_one, request.bare);
    if (request.quiet) return read;
    const std::string assumption = assumption_text(request.scene, request.bare);
    if (!assumption.empty()) print_message(assumption);
    for (const Warning& warning : read.report.warnings)
        print_message(Warning{warning.place, "warning: " + warning.message}.to_string());
    return read;
}

bool is_reached(const Provenance& provenance, double error) {
    return provenance.error_estimated > 0 &&
           std::max(provenance.error_estimated, provenance.error_bound) <= error;
}

std::string error_text(const Provenance& provenance) {
    return provenance.error_estimated > 0 ? percent(provenance.error_estimated) + " estimated"
                                          : std::string("not judged yet");
}

/// Whether the output is the file to go on from.
bool is_in_place(const PrecomputeRequest& request) {
    std::error_code error;
    return std::filesystem::equivalent(request.output, request.resumed, error);
}

/// Whether an unfinished operator should take the output's name: where it takes nothing away, and
/// is better than what it went on from.
bool is_worth_keeping(const PrecomputeRequest& request, const Provenance& unfinished) {
    const auto& earlier = request.options.earlier;
    const bool is_better =
        !earlier ||
        (unfinished.error_estimated > 0 &&
         (earlier->error_estimated == 0 || unfinished.error_estimated < earlier->error_estimated));
    return is_better && (!std::filesystem::exists(request.output) || is_in_place(request));
}

/// Writes what there was when it was interrupted, and says so.
[[noreturn]] void end_unfinished(const PrecomputeRequest& request, const GlobalTransport& transport,
                                 const std::vector<DimmedLight>& lights) {
    if (!is_worth_keeping(request, transport.provenance))
        throw Interrupted(fmt::format("stopped on request; {} is as it was",
                                      request.resumed.empty() ? request.output : request.resumed));
    write_operator_file(request.output, transport, options_json(request.options), lights);
    throw Interrupted(fmt::format(
        "stopped on request; {} holds what there was: {:.3g} % asked, {}. precompute --resume {} "
        "goes on",
        request.output, 100 * request.options.error, error_text(transport.provenance),
        request.output));
}

void print_report(const PrecomputeRequest& request, const GlobalTransport& transport,
                  const PrecomputeReport& report) {
    const PrecomputeOutcome outcome{transport, report, request.output,
                                    std::filesystem::file_size(request.output)};
    if (request.json)
        print_result(json_report(outcome));
    else if (!request.quiet)
        print_result(readable_report(outcome));
}

/// Ends with the file to go on from where that has the error already.
void take_over(const PrecomputeRequest& request, const std::vector<DimmedLight>& lights,
               PrecomputeReport& report) {
    const GlobalTransport transport =
        timed(report.seconds, "reading", [&] { return read_operator_file(request.resumed); });
    report.elements = transport.space.elements().size();
    for (const Element& element : transport.space.elements())
        report.cells += element.space.tree().functions();
    if (!is_in_place(request))
        timed(report.seconds, "writing", [&] {
            write_operator_file(request.output, transport, options_json(request.options), lights);
        });
    if (!request.quiet)
        print_message(fmt::format("{}: {:.3g} % asked, {}: nothing to do", request.resumed,
                                  100 * request.options.error,
                                  error_text(*request.options.earlier)));
    if (request.json) print_report(request, transport, report);
}

/// Says how the error that was asked for stands to the one that was found. Said even where only the
/// object is wanted: a number that was asked for and not reached is not for small print.
void warn_of_error(const PrecomputeRequest& request, const Provenance& provenance) {
    if (!(provenance.error_estimated > 0)) {
        if (request.options.most_attempts > 0 && !request.quiet)
            print_message(
                "warning: the error is not known: the scene has no place for a lamp, or none that "
                "lights anything, to judge it with");
    } else if (provenance.error_estimated > provenance.error_asked) {
        print_message(fmt::format(
            "warning: the error asked for was not reached: {:.3g} % asked, {} estimated. "
            "The final gather of measure and render does better.",
            100 * provenance.error_asked, percent(provenance.error_estimated)));
    } else if (provenance.error_bound > provenance.error_asked) {
        print_message(fmt::format(
            "warning: the error asked for is likely, but not certain: {:.3g} % asked, {} "
            "estimated, at most {}. verify --lights 100 tells more.",
            100 * provenance.error_asked, percent(provenance.error_estimated),
            percent(provenance.error_bound)));
    }
}

}  // namespace

void run_precompute(PrecomputeRequest request) {
    PrecomputeReport report;
    if (request.resumed.empty()) require_writable(request.output);
    const ReadScene read = timed(report.seconds, "reading", [&] { return read_scene_of(request); });
    require_not_read(request.output, read.report.files);
    const Scene& scene = read.scene;
    if (request.options.earlier && is_reached(*request.options.earlier, request.options.error)) {
        take_over(request, read.lights, report);
        return;
    }
    if (!request.resumed.empty()) require_writable(request.output);
    request.options.lobes = lobes_of(scene.materials);
    warn_of_gloss(scene, request.options);
    if (!request.quiet) warn_of_brightness(scene);
    if (!request.quiet && request.options.truncation == 0.0)
        print_message(
            "warning: --truncation 0 keeps every coefficient of every bounce: memory and file grow "
            "with the square of the cells, time with their cube");

    const GlobalTransport transport = compute(scene, request, report);
    if (report.interrupted) end_unfinished(request, transport, read.lights);
    timed(report.seconds, "writing", [&] {
        write_operator_file(request.output, transport, options_json(request.options), read.lights);
    });

    warn_of_error(request, transport.provenance);
    print_report(request, transport, report);
}

}  // namespace lightwell
