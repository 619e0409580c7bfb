// How accurate is an operator, judged by a path tracer that shares nothing with it but the scene?
//
//     accuracy SCENE [--error E] [--cell C] [--tolerance T] [--truncation R] [--oracle
//     geometric|variation]
//              [--lights N] [--points M] [--seed S] [--noise R] [--gather K] [--cache DIR]
//
// prints one line per light and a summary: the relative rms error of indirect illuminance over
// points spread evenly by area, as the basis shows it smoothed (picture), as the stored operator
// alone gives it (stored), and gathered at the point (gather). The judge's own variance is
// subtracted. With --cache the judge's answers are kept for other settings.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include <fmt/format.h>

#include "radiance4d/scene/occluder_tree.h"
#include "runtime/outgoing/final_gather.h"
#include "runtime/propagation/lighting.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/path_tracer.h"
#include "solver/reference/random_lights.h"

namespace lightwell {
namespace {

struct Judged {
    Rgb mean;
    Rgb deviation;
};

/// The judge's answer for one light, from the cache if it is there.
std::vector<Judged> judge(const Scene& scene, const Visibility& visibility, const PointLight& light,
                          const std::vector<SurfacePoint>& points, double noise,
                          const std::string& cached) {
    std::vector<Judged> answer(points.size());
    if (std::ifstream file(cached, std::ios::binary); file) {
        file.read(reinterpret_cast<char*>(answer.data()),
                  static_cast<std::streamsize>(answer.size() * sizeof(Judged)));
        if (file) return answer;
    }
    const PathTracer tracer(scene, visibility, {light});
    const IrradianceSurvey survey = tracer.indirect_to({noise}, points);
    for (std::size_t k = 0; k < points.size(); ++k)
        answer[k] = {survey.at[k].mean, survey.at[k].standard_error};
    if (!cached.empty())
        std::ofstream(cached, std::ios::binary)
            .write(reinterpret_cast<const char*>(answer.data()),
                   static_cast<std::streamsize>(answer.size() * sizeof(Judged)));
    return answer;
}

/// Relative rms error with the judge's variance taken off, and the signed relative mean.
struct Error {
    double squares = 0, noise = 0, reference = 0, bias = 0, sum = 0;
    void add(const Rgb& value, const Judged& truth) {
        squares += (value - truth.mean).square().sum();
        noise += truth.deviation.square().sum();
        reference += truth.mean.square().sum();
        bias += (value - truth.mean).sum();
        sum += truth.mean.sum();
    }
    double relative() const { return std::sqrt(std::max(0.0, squares - noise) / reference); }
};

int run(const std::map<std::string, std::string>& given, const std::string& path) {
    const auto number = [&](const std::string& key, double otherwise) {
        const auto it = given.find(key);
        return it == given.end() ? otherwise : std::stod(it->second);
    };
    Scene scene = read_scene(path).scene;
    for (Material& material : scene.materials)
        material.emission = Rgb::Zero();  // lamps alone
    PrecomputeOptions options;
    options.error = number("error", 0.05);
    if (given.count("cell") != 0) options.cell_size = number("cell", 0);
    if (given.count("tolerance") != 0) options.oracle_tolerance = number("tolerance", 0);
    if (given.count("truncation") != 0) options.truncation = number("truncation", 0);
    if (given.count("oracle") != 0 && given.at("oracle") == "variation")
        options.oracle = OracleKind::variation;
    options.most_attempts = static_cast<int>(number("attempts", 4));
    PrecomputeReport report;
    const GlobalTransport transport = precompute(scene, options, {}, report);
    std::string line = fmt::format(
        "elements {} cells {} cell {:.3f} m, rays {} links {} judged {} dto {} of {} gto {}",
        report.elements, report.cells, transport.provenance.cell_size, transport.provenance.rays,
        transport.provenance.links, report.links_judged, transport.bounce.coefficients(),
        report.coefficients_before, transport.indirect[0].coefficients());
    for (const auto& [stage, seconds] : report.seconds)
        line += fmt::format(" {} {:.2f}s", stage, seconds);
    line += fmt::format(" closure {:.2e} -> {:.2e} in {}", report.closure.deficit_before,
                        report.closure.deficit_after, report.closure.sweeps);
    line += fmt::format(" attempts {} estimate {:.4f} energy dropped {:.4f} judge rays {}",
                        report.attempts, transport.provenance.error_estimated,
                        transport.provenance.energy_dropped, report.estimate_rays);
    std::cout << line << std::endl;

    std::vector<Quad> quads;
    for (const SceneQuad& quad : scene.quads)
        quads.push_back(quad.quad);
    const Visibility visibility(quads);
    const OccluderTree occluders(quads);
    const int light_count = static_cast<int>(number("lights", 10));
    const int point_count = static_cast<int>(number("points", 300));
    const auto seed = static_cast<std::uint64_t>(number("seed", 7));
    const double noise = number("noise", 0.01);
    const int strata = static_cast<int>(number("gather", 32));
    LightPlacement placement;
    placement.surrounded = number("surrounded", 0.6);
    const std::vector<PointLight> lights =
        random_lights(scene, visibility, light_count, seed, placement);

    double worst = 0, squares = 0, gather_squares = 0;
    int above = 0;
    for (std::size_t l = 0; l < lights.size(); ++l) {
        const std::vector<SurfacePoint> points =
            sample_surface(scene, seeing_sides(scene, visibility), point_count, seed + 100 + l);
        std::string cached;
        if (given.count("cache") != 0)
            cached = fmt::format("{}/{}-{}-{}-{}-{}.bin", given.at("cache"), scene.name, seed, l,
                                 point_count, noise);
        const std::vector<Judged> truth =
            judge(scene, visibility, lights[l], points, noise, cached);
        const Lighting stored =
            light_scene(transport, {lights[l]}, quads, occluders, Propagation::stored);
        const Lighting solved =
            light_scene(transport, {lights[l]}, quads, occluders, Propagation::solved);
        const Lighting gathered =
            light_scene(transport, {lights[l]}, quads, occluders, Propagation::gathered);
        const auto show = [&](const RadianceField& field) {
            return smooth_irradiance(transport.space, field);
        };
        const auto stored_surface = show(stored.indirect),
                   picture_surface = show(gathered.indirect),
                   solved_surface = show(solved.indirect);
        const FinalGather gather(transport, visibility, show(solved.direct + solved.indirect),
                                 strata);
        Error stored_error, picture_error, gather_error, solved_error;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const SurfacePoint& p = points[k];
            const bool front = p.normal.dot(quads[static_cast<std::size_t>(p.quad)].normal()) > 0;
            const int e = transport.space.element_on(p.quad, front);
            const bool is_open =
                e >= 0 && transport.space.element(static_cast<std::size_t>(e))
                              .is_open(transport.space.element(static_cast<std::size_t>(e))
                                           .geometry.parameters(p.position)[0],
                                       transport.space.element(static_cast<std::size_t>(e))
                                           .geometry.parameters(p.position)[1]);
            if (!is_open) {
                stored_error.add(Rgb::Zero(), truth[k]);
                picture_error.add(Rgb::Zero(), truth[k]);
                solved_error.add(Rgb::Zero(), truth[k]);
            } else {
                const auto element = static_cast<std::size_t>(e);
                const Vec2 uv = transport.space.element(element).geometry.parameters(p.position);
                stored_error.add(stored_surface[element].at(uv[0], uv[1]), truth[k]);
                picture_error.add(picture_surface[element].at(uv[0], uv[1]), truth[k]);
                solved_error.add(solved_surface[element].at(uv[0], uv[1]), truth[k]);
            }
            gather_error.add(gather.irradiance(p.position, p.normal, p.quad), truth[k]);
        }
        std::cout << fmt::format(
                         "light {:2} at ({:6.2f} {:6.2f} {:6.2f}): picture {:.4f} stored {:.4f} "
                         "solved {:.4f} gather {:.4f} (judge {:.4f}) bias {:+.4f} {:+.4f} {:+.4f}",
                         l, lights[l].position[0], lights[l].position[1], lights[l].position[2],
                         picture_error.relative(), stored_error.relative(), solved_error.relative(),
                         gather_error.relative(),
                         std::sqrt(picture_error.noise / picture_error.reference),
                         picture_error.bias / picture_error.sum,
                         solved_error.bias / solved_error.sum, gather_error.bias / gather_error.sum)
                  << std::endl;
        worst = std::max(worst, picture_error.relative());
        squares += picture_error.relative() * picture_error.relative();
        gather_squares += gather_error.relative() * gather_error.relative();
        above += picture_error.relative() > options.error ? 1 : 0;
    }
    const auto n = static_cast<double>(lights.size());
    std::cout << fmt::format(
        "picture rms {:.4f} worst {:.4f}, gather rms {:.4f}; {} of {} above {}\n",
        std::sqrt(squares / n), worst, std::sqrt(gather_squares / n), above, lights.size(),
        options.error);
    return 0;
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    std::map<std::string, std::string> given;
    std::string scene;
    for (int k = 1; k < argc; ++k) {
        const std::string word = argv[k];
        if (word.rfind("--", 0) == 0 && k + 1 < argc)
            given[word.substr(2)] = argv[++k];
        else
            scene = word;
    }
    try {
        return lightwell::run(given, scene);
    } catch (const std::exception& failure) {
        std::cerr << "accuracy: " << failure.what() << '\n';
        return 1;
    }
}
