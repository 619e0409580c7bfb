// How accurate is an operator, judged by a path tracer that shares nothing with it but the scene?
//
//     accuracy SCENE [--error E] [--oracle geometric|variation] [--lights N] ... (see --help)
//
// prints one line per light and a summary: the relative rms error of indirect illuminance over
// all surfaces, as the basis shows it smoothed (picture), as the stored operator alone gives it
// (stored), solved on the stored bounce (solved), and as `lightwell measure` gathers it (gather).
// With --cache the judge's answers are kept for other settings.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "radiance4d/operator/operator_file.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/deviation.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/random_lights.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/shown_ways.h"

namespace lightwell {
namespace {

struct Request {
    std::string scene;
    PrecomputeOptions precompute;
    int lights = 10;
    EstimateOptions judge;
    LightPlacement placement;
    std::string cache;  ///< folder; empty: none
};

/// A file of judged lights; what is not there, or of another length, is judged again.
class JudgeCache {
  public:
    JudgeCache(const Request& request, const std::string& scene_name) {
        if (!request.cache.empty())
            path_ = fmt::format("{}/{}-{}-{}-{}-{}.judged", request.cache, scene_name,
                                request.judge.seed, request.lights, request.judge.points,
                                request.judge.noise);
    }

    std::vector<JudgedLight> read() const {
        std::ifstream file(path_, std::ios::binary);
        std::vector<JudgedLight> judged;
        std::uint64_t points = 0;
        while (take(file, &points, 1)) {
            JudgedLight one;
            one.points.resize(points);
            one.truth.resize(points);
            one.weight.resize(points);
            if (!take(file, &one.light.position, 1) || !take(file, one.points.data(), points) ||
                !take(file, one.weight.data(), points) || !take(file, one.truth.data(), points))
                return {};
            one.light.intensity = Rgb::Ones();
            judged.push_back(std::move(one));
        }
        return judged;
    }

    void write(const std::vector<JudgedLight>& judged) const {
        if (path_.empty()) return;
        std::ofstream file(path_, std::ios::binary);
        for (const JudgedLight& one : judged) {
            const std::uint64_t points = one.points.size();
            put(file, &points, 1);
            put(file, &one.light.position, 1);
            put(file, one.points.data(), points);
            put(file, one.weight.data(), points);
            put(file, one.truth.data(), points);
        }
        if (!file.flush()) throw SystemError(path_ + ": cannot be written");
    }

  private:
    template <typename Thing>
    static bool take(std::ifstream& file, Thing* things, std::size_t count) {
        const auto bytes = static_cast<std::streamsize>(count * sizeof(Thing));
        return static_cast<bool>(file.read(reinterpret_cast<char*>(things), bytes));
    }
    template <typename Thing>
    static void put(std::ofstream& file, const Thing* things, std::size_t count) {
        file.write(reinterpret_cast<const char*>(things),
                   static_cast<std::streamsize>(count * sizeof(Thing)));
    }

    std::string path_;
};

void print_cost(const GlobalTransport& transport, const PrecomputeReport& report) {
    const Provenance& provenance = transport.provenance;
    std::string line = fmt::format(
        "elements {} cells {} cell {:.3f} m, rays {} links {} judged {} dto {} of {} gto {}",
        report.elements, report.cells, provenance.cell_size, provenance.rays, provenance.links,
        report.links_judged, transport.bounce.coefficients(), report.coefficients_before,
        transport.indirect[0].coefficients());
    for (const auto& [stage, seconds] : report.seconds)
        line += fmt::format(" {} {:.2f}s", stage, seconds);
    line += fmt::format(" closure {:.2e} -> {:.2e} in {}", report.closure.deficit_before,
                        report.closure.deficit_after, report.closure.sweeps);
    line += fmt::format(" attempts {} estimate {:.4f} energy dropped {:.4f} judge rays {}",
                        report.attempts, provenance.error_estimated, provenance.energy_dropped,
                        report.estimate_rays);
    std::cout << line << std::endl;
}

/// What the four ways to show one light are off by.
struct LightErrors {
    Deviation picture, stored, solved, gather;
};

LightErrors errors_of(const OpenedOperator& opened, const JudgedLight& judged) {
    const auto deviation = [&](const std::vector<Rgb>& shown) {
        return deviation_from(judged.truth, shown, judged.weight);
    };
    const auto shown_by = [&](Propagation propagation) {
        const Lighting lighting = light_scene(opened.transport, {judged.light}, opened.quads,
                                              opened.occluders, propagation);
        return deviation(shown_at(judged.points, opened.transport.space,
                                  smooth_irradiance(opened.transport.space, lighting.indirect),
                                  opened.quads));
    };
    return {shown_by(Propagation::gathered), shown_by(Propagation::stored),
            shown_by(Propagation::solved),
            deviation(measure_way(opened).at(judged.light, judged.points))};
}

void print_light(std::size_t number, const Vec3& at, const LightErrors& errors) {
    std::cout << fmt::format(
                     "light {:2} at ({:6.2f} {:6.2f} {:6.2f}): picture {:.4f} stored {:.4f} solved "
                     "{:.4f} gather {:.4f} (judge {:.4f}) bias {:+.4f} {:+.4f} {:+.4f}",
                     number, at[0], at[1], at[2], errors.picture.relative_rms,
                     errors.stored.relative_rms, errors.solved.relative_rms,
                     errors.gather.relative_rms, errors.picture.noise, errors.picture.bias,
                     errors.solved.bias, errors.gather.bias)
              << std::endl;
}

/// The operator to be judged, in a scene lit by lamps alone: computed, or read from a .gto file.
OpenedOperator operator_of(const Request& request) {
    if (std::filesystem::path(request.scene).extension() == ".gto") {
        GlobalTransport transport = read_operator_file(request.scene);
        transport.scene = without_emission(std::move(transport.scene));
        return opened(std::move(transport));
    }
    PrecomputeReport report;
    GlobalTransport transport = precompute(without_emission(read_scene(request.scene).scene),
                                           request.precompute, {}, report);
    print_cost(transport, report);
    return opened(std::move(transport));
}

void run(const Request& request) {
    const OpenedOperator opened = operator_of(request);
    const GlobalTransport& transport = opened.transport;
    const JudgeCache cache(request, transport.scene.name);
    std::vector<JudgedLight> judged = cache.read();
    if (judged.empty()) {
        std::vector<Vec3> positions;
        for (const PointLight& light :
             random_lights(transport.scene, opened.visibility, request.lights, request.judge.seed,
                           request.placement))
            positions.push_back(light.position);
        judged = judged_lights(transport, opened.quads, opened.visibility, opened.occluders,
                               positions, request.judge, {});
        cache.write(judged);
    }

    ErrorEstimate picture, gather;
    int above = 0;
    for (std::size_t l = 0; l < judged.size(); ++l) {
        const LightErrors errors = errors_of(opened, judged[l]);
        print_light(l, judged[l].light.position, errors);
        picture.squares.push_back({errors.picture.square / errors.picture.reference_square});
        gather.squares.push_back({errors.gather.square / errors.gather.reference_square});
        above += errors.picture.relative_rms > request.precompute.error ? 1 : 0;
    }
    std::cout << fmt::format(
        "picture rms {:.4f} worst {:.4f}, gather rms {:.4f}; {} of {} above {}\n", picture.rms(),
        std::sqrt(quantile_of(picture.squares, 1)), gather.rms(), above, judged.size(),
        request.precompute.error);
}

/// Reads the command line into the request. @return whether there is something to do.
/// @throws InputError for what makes no sense
bool read_arguments(int argc, char** argv, Request& request) {
    constexpr int most = 1 << 20;
    CLI::App app{"How accurate an operator is, judged by path tracing.", "accuracy"};
    app.add_option("SCENE", request.scene, "scene.toml, .obj, .ply or .gto")->required();
    const auto add = [&app](const std::string& name, const std::string& meaning,
                            std::function<void(const std::string&)> take) {
        app.add_option_function<std::string>(name, std::move(take), meaning);
    };
    PrecomputeOptions& options = request.precompute;
    options.most_attempts = 4;
    request.judge.points = 300;
    request.judge.noise = 0.01;
    request.judge.seed = 7;
    request.placement.surrounded = 0.6;
    add("--error", "relative error asked for; 0.05 by default",
        [&](const std::string& text) { options.error = error_argument("--error", text); });
    add("--oracle", "geometric or variation",
        [&](const std::string& text) { options.oracle = oracle_argument("--oracle", text); });
    add("--cell", "largest side of a finest cell [m]",
        [&](const std::string& text) { options.cell_size = positive_argument("--cell", text); });
    add("--tolerance", "of the oracle", [&](const std::string& text) {
        options.oracle_tolerance = non_negative_argument("--tolerance", text);
    });
    add("--truncation", "relative error from coefficients left out", [&](const std::string& text) {
        options.truncation = non_negative_argument("--truncation", text);
    });
    add("--attempts", "operators that may be built; 4 by default", [&](const std::string& text) {
        options.most_attempts = whole_argument("--attempts", text, 0, 100);
    });
    add("--lights", "unseen lights; 10 by default", [&](const std::string& text) {
        request.lights = whole_argument("--lights", text, 1, most);
    });
    add("--points", "surface points a light; 300 by default", [&](const std::string& text) {
        request.judge.points = whole_argument("--points", text, 1, most);
    });
    add("--seed", "of lights and points; 7 by default", [&](const std::string& text) {
        request.judge.seed = static_cast<std::uint64_t>(whole_argument("--seed", text, 0, most));
    });
    add("--noise", "of the judge; 0.01 by default",
        [&](const std::string& text) { request.judge.noise = positive_argument("--noise", text); });
    add("--surrounded", "share of directions that a light must be enclosed in",
        [&](const std::string& text) {
            request.placement.surrounded = non_negative_argument("--surrounded", text);
        });
    add("--cache", "folder that keeps the judge's answers", [&](const std::string& text) {
        if (!std::filesystem::is_directory(text))
            throw InputError(Place{"--cache"}, text + " is not a folder");
        request.cache = text;
    });
    try {
        app.parse(argc, argv);
        return true;
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return false;
    } catch (const CLI::ParseError& error) {
        throw InputError(error.what());
    }
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    try {
        lightwell::Request request;
        if (lightwell::read_arguments(argc, argv, request)) lightwell::run(request);
        return 0;
    } catch (const std::exception& failure) {
        std::cerr << "accuracy: " << failure.what() << '\n';
        return 1;
    }
}
