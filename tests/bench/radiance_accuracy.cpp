// How far is the indirect radiance that one sees off, in pictures?
//
//     radiance_accuracy FILE.gto [--eye X,Y,Z,TX,TY,TZ]... [--width N] [--height N] [--samples N]
//     [--lights FILE] [--pictures P]
//
// prints one CSV row per eye point: relative L2 error of indirect radiance over the pixels, colours
// together, against the path tracer; gathered as `measure --probes` does it, read from the basis,
// and so with lamps' light spread as the paper does. The tracer's own noise is not in it: squares
// are products of the differences from two independent halves of the paths, whose mean has no bias.
// Then the tracer's noise in the same measure, and the test by pixel: the share of pixels whose
// gathered radiance lies outside the tracer's 99 % interval (in any colour, 1 % by chance for each)
// by more than the error that was asked for, of the picture's root mean square. Without --eye it is
// the scene's camera; --lights stands for the scene's lamps. With --pictures the pictures
// themselves go to P-eye-gathered.png, P-eye-basis.png and P-eye-traced.png.
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/operator/smooth_irradiance.h"
#include "runtime/drawing/camera_rays.h"
#include "solver/reference/radiance_tracer.h"
#include "viewer/commands/lit_scene.h"
#include "viewer/commands/measure_command.h"
#include "viewer/images/image_file.h"
#include "viewer/images/tone.h"

namespace lightwell {
namespace {

constexpr double channels = 3;

struct Asked {
    int width = 32, height = 24;
    int samples = 512;
    std::string lights;
    std::string pictures;
};

std::vector<Camera> eyes_of(const Scene& scene, const std::vector<std::vector<double>>& given) {
    std::vector<Camera> eyes;
    Camera own = scene.camera.value_or(Camera{});
    if (!scene.camera) own.up = scene.up;
    for (const std::vector<double>& e : given) {
        Camera eye = own;
        eye.position = Vec3(e.at(0), e.at(1), e.at(2));
        eye.target = Vec3(e.at(3), e.at(4), e.at(5));
        eyes.push_back(eye);
    }
    if (eyes.empty()) eyes.push_back(own);
    return eyes;
}

/// What the path tracer makes of a picture, twice.
struct Traced {
    LightSurvey half, other;

    Rgb mean(std::size_t k) const { return 0.5 * (half.at[k].mean + other.at[k].mean); }
    Rgb standard_error(std::size_t k) const {
        return 0.5 *
               (half.at[k].standard_error.square() + other.at[k].standard_error.square()).sqrt();
    }
    /// Mean square over the pixels, colours together.
    double square() const {
        double sum = 0;
        for (std::size_t k = 0; k < half.at.size(); ++k)
            sum += (half.at[k].mean * other.at[k].mean).sum();
        return sum / static_cast<double>(half.at.size());
    }
    /// Relative root mean square error of a picture, free of the tracer's noise.
    double error_of(const std::vector<Rgb>& seen) const {
        double sum = 0;
        for (std::size_t k = 0; k < seen.size(); ++k)
            sum += ((seen[k] - half.at[k].mean) * (seen[k] - other.at[k].mean)).sum();
        return std::sqrt(std::max(0.0, sum / static_cast<double>(seen.size())) / square());
    }
    /// The tracer's own, in the same measure.
    double noise() const {
        double sum = 0;
        for (std::size_t k = 0; k < half.at.size(); ++k)
            sum += standard_error(k).square().sum();
        return std::sqrt(sum / static_cast<double>(half.at.size()) / square());
    }
    /// Share of the pixels that are off by more than `allowed` beyond the tracer's 99 % interval.
    double share_off(const std::vector<Rgb>& seen, double allowed) const {
        constexpr double quantile = 2.576;
        std::size_t off = 0;
        for (std::size_t k = 0; k < seen.size(); ++k)
            if (((seen[k] - mean(k)).abs() > quantile * standard_error(k) + allowed).any()) ++off;
        return static_cast<double>(off) / static_cast<double>(seen.size());
    }
};

Traced traced_at(const std::vector<RadianceProbe>& probes, const OpenedOperator& opened,
                 const std::vector<Light>& lights, int samples) {
    const RadianceTracer tracer(opened.transport.scene, opened.visibility, lights);
    PathTracing how;
    how.samples = samples / 2;
    Traced traced;
    traced.half = tracer.indirect(probes, how);
    ++how.seed;
    traced.other = tracer.indirect(probes, how);
    return traced;
}

void write(const std::vector<Rgb>& seen, const Asked& asked, double exposure,
           const std::string& name) {
    Image image(asked.width, asked.height);
    for (std::size_t k = 0; k < seen.size(); ++k)
        image.pixels()[k] = seen[k].cast<float>();
    const WriteReport report =
        write_png(develop(image, {exposure, ToneCurve::filmic}), asked.pictures + name + ".png");
    if (report.non_finite_pixels > 0) std::cerr << name << ": not finite\n";
}

void judge_eye(const OpenedOperator& opened, const Camera& eye, std::size_t number,
               const Asked& asked) {
    const Scene& scene = opened.transport.scene;
    std::optional<std::string> file;
    if (!asked.lights.empty()) file = asked.lights;
    const std::vector<Light> lights = chosen_lights(file, scene);
    const LitScene lit(opened, lights);
    const std::vector<SmoothSurface> surfaces =
        smooth_irradiance(opened.transport.space, lit.lighting().indirect);
    const LitScene spread(opened, lights, LampDirections::forgotten);
    const std::vector<SmoothSurface> spread_surfaces =
        smooth_irradiance(opened.transport.space, spread.lighting().indirect);
    const FinalGather gather = lit.gather(gather_strata(opened.transport.provenance.error_asked));
    const CameraRays rays(eye, asked.width, asked.height);
    std::vector<RadianceProbe> probes;
    for (int y = 0; y < asked.height; ++y)
        for (int x = 0; x < asked.width; ++x)
            probes.push_back({eye.position, rays.direction(x + 0.5, y + 0.5)});
    std::vector<Rgb> gathered(probes.size()), read(probes.size()), papers(probes.size()),
        traced(probes.size());
    tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t k) {
        const auto look = [&](const FinalGather* by) {
            return seen_light(opened, lit, lights, surfaces, by, probes[k].position,
                              probes[k].direction)
                .indirect;
        };
        gathered[k] = look(&gather);
        read[k] = look(nullptr);
        papers[k] = seen_light(opened, spread, lights, spread_surfaces, nullptr, probes[k].position,
                               probes[k].direction)
                        .indirect;
    });
    const Traced judge = traced_at(probes, opened, lights, asked.samples);
    for (std::size_t k = 0; k < probes.size(); ++k)
        traced[k] = judge.mean(k);
    const double allowed =
        opened.transport.provenance.error_asked * std::sqrt(judge.square() / channels);
    fmt::print("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}\n", number, judge.error_of(gathered),
               judge.error_of(read), judge.error_of(papers), judge.noise(),
               judge.share_off(gathered, allowed));
    std::cout.flush();
    if (asked.pictures.empty()) return;
    Image image(asked.width, asked.height);
    for (std::size_t k = 0; k < traced.size(); ++k)
        image.pixels()[k] = traced[k].cast<float>();
    const double exposure = automatic_exposure(image);
    write(gathered, asked, exposure, fmt::format("-{}-gathered", number));
    write(read, asked, exposure, fmt::format("-{}-basis", number));
    write(traced, asked, exposure, fmt::format("-{}-traced", number));
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    using namespace lightwell;
    CLI::App app{"Error of the indirect radiance in pictures"};
    std::string file;
    std::vector<std::string> given;
    Asked asked;
    app.add_option("file", file)->required();
    app.add_option("--eye", given, "X,Y,Z,TX,TY,TZ: where it stands and where it looks");
    app.add_option("--width", asked.width, "pixels");
    app.add_option("--height", asked.height, "pixels");
    app.add_option("--samples", asked.samples, "paths a pixel");
    app.add_option("--lights", asked.lights, "lamps instead of the scene's, as in a scene file");
    app.add_option("--pictures", asked.pictures, "prefix of the pictures to write");
    CLI11_PARSE(app, argc, argv);
    std::vector<std::vector<double>> eyes;
    for (const std::string& text : given) {
        eyes.emplace_back();
        for (const std::string& number : CLI::detail::split(text, ','))
            eyes.back().push_back(std::stod(number));
    }
    const OpenedOperator opened = open_operator(file);
    std::cout << "eye,error_gathered,error_basis,error_spread_lamps,noise,pixels_off\n";
    std::size_t number = 0;
    for (const Camera& eye : eyes_of(opened.transport.scene, eyes))
        judge_eye(opened, eye, number++, asked);
}
