#include "solver/reference/verification.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "radiance4d/failure.h"
#include "radiance4d/scene/direct_light.h"
#include "solver/reference/chosen_points.h"
#include "solver/reference/deviation.h"
#include "solver/reference/error_estimate.h"
#include "solver/reference/lamp_draw.h"
#include "solver/reference/random_stream.h"

namespace lightwell {

namespace {

enum Stream : std::uint64_t { lamp_stream = 1, judge_stream, worst_stream };

std::vector<Rgb> with(std::vector<Rgb> values, const std::vector<Rgb>& more) {
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] += more[k];
    return values;
}

std::vector<LightEstimate> with(std::vector<LightEstimate> estimates,
                                const std::vector<Rgb>& more) {
    for (std::size_t k = 0; k < estimates.size(); ++k)
        estimates[k].mean += more[k];
    return estimates;
}

/// The place of largest error so far.
struct WorstSoFar {
    /// For a lamp of 1 cd, less the judge's noise [lx].
    double error = -std::numeric_limits<double>::infinity();
    SurfacePoint point;
    PointLight lamp;
};

/// What is kept of one way to show light.
struct WayErrors {
    ErrorCollection indirect, total;
    WorstSoFar worst;

    void look_for_worst(const JudgedLight& judged, const std::vector<double>& visible,
                        const std::vector<Rgb>& shown) {
        constexpr double seen_well = 0.5;  // a place that hardly anybody sees is not the worst
        for (std::size_t k = 0; k < shown.size(); ++k) {
            if (visible[k] < seen_well) continue;
            const LightEstimate& truth = judged.truth[k];
            const double error =
                std::abs(luminance(Rgb(shown[k] - truth.mean))) - luminance(truth.standard_error);
            if (error > worst.error) worst = {error, judged.points[k], judged.light};
        }
    }
};

/// Verifies lamp by lamp.
class Verifier {
  public:
    Verifier(const Scene& scene, const RadianceSpace& space, const Visibility& visibility,
             const OccluderTree& occluders, const std::vector<ShownLight>& ways,
             const VerifyOptions& options)
        : scene_(without_emission(scene)),
          space_(space),
          visibility_(visibility),
          direct_(scene_, visibility, occluders),
          ways_(ways),
          options_(options),
          errors_(ways.size()) {}

    Verification run(const Progress& progress) {
        const std::vector<QuadSide> sides = seeing_sides(scene_, visibility_);
        if (sides.empty())
            throw InputError(scene_.name +
                             ": no surface reflects light and sees another, so there is nothing to "
                             "verify");
        const std::vector<DrawnLamp> drawn = lamps(sides, progress);
        if (drawn.empty())
            throw InputError(scene_.name +
                             ": no place for a lamp among surfaces that reflect light, so there is "
                             "nothing to verify");
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            progress.check();
            progress.say("verify", static_cast<double>(k) / static_cast<double>(drawn.size()));
            RandomStream random(seed_of(judge_stream), k);
            std::vector<SurfacePoint> points =
                sample_surface(scene_, sides, options_.candidates, random.bits());
            std::vector<double> visible = visible_shares(space_, visibility_, points);
            judge(drawn[k],
                  candidates_for(lamp_at(drawn[k].position), std::move(points), std::move(visible)),
                  random);
        }
        if (result_.lights < 2) throw InputError(scene_.name + ": nothing in it reflects light");
        conclude();
        return result_;
    }

  private:
    std::uint64_t seed_of(Stream stream) const {
        return RandomStream(options_.seed, stream).bits();
    }

    static PointLight lamp_at(const Vec3& position) {
        PointLight lamp;
        lamp.position = position;
        lamp.intensity = Rgb::Ones();
        return lamp;
    }

    CandidatePoints candidates_for(const PointLight& lamp, std::vector<SurfacePoint> points,
                                   std::vector<double> visible) const {
        std::vector<Rgb> first = ways_.front().at(lamp, points),
                         last = ways_.back().at(lamp, points);
        return {std::move(points), {std::move(first), std::move(visible)}, std::move(last)};
    }

    std::vector<DrawnLamp> lamps(const std::vector<QuadSide>& sides,
                                 const Progress& progress) const {
        constexpr int glances = 500;
        const std::uint64_t seed = seed_of(lamp_stream);
        const std::vector<SurfacePoint> points = sample_surface(scene_, sides, glances, seed);
        const std::vector<double> visible = visible_shares(space_, visibility_, points);
        const auto stakes = [&](const std::vector<Vec3>& places) {
            std::vector<double> differences;
            for (const Vec3& place : places) {
                progress.check();
                differences.push_back(
                    relative_difference(candidates_for(lamp_at(place), points, visible)));
            }
            return differences;
        };
        return LampDraw(scene_, visibility_, seed).more(options_.lights, stakes, progress);
    }

    std::vector<Rgb> direct_at(const PointLight& lamp,
                               const std::vector<SurfacePoint>& points) const {
        std::vector<Rgb> values;
        values.reserve(points.size());
        for (const SurfacePoint& p : points)
            values.push_back(direct_.from_light(p.position, p.normal, p.quad, lamp));
        return values;
    }

    void judge(const DrawnLamp& lamp, const CandidatePoints& candidates, RandomStream& random) {
        ChosenPoints chosen = chosen_points(candidates, options_.points, random.uniform());
        NoiseTarget target;
        target.relative = options_.noise;
        target.floor = 0.5;  // bright places are chosen oftener than dark ones
        const JudgedLight judged =
            judged_light(scene_, visibility_, lamp_at(lamp.position), std::move(chosen.points),
                         chosen.shown.weight, target, random.bits());
        result_.rays += judged.rays;
        compare(judged, lamp.weight, chosen.visible, std::move(chosen.shown), candidates);
    }

    void compare(const JudgedLight& judged, double lamp_weight, const std::vector<double>& visible,
                 ShownPoints shown, const CandidatePoints& candidates) {
        const PointLight& lamp = judged.light;
        const LightMeasure indirect = measure_of(judged.truth, shown, candidates.shown);
        if (!(indirect.square > 0 && indirect.mean > 0)) return;
        const std::vector<Rgb> direct = direct_at(lamp, judged.points);
        const std::vector<LightEstimate> truth =
            with(judged.truth, PathTracer(scene_, visibility_, {lamp})
                                   .straight_from_lamps(judged.points, result_.rays));
        const LightMeasure total =
            measure_of(truth, {with(shown.value, direct), shown.weight},
                       {with(candidates.shown.value, direct_at(lamp, candidates.points)),
                        candidates.shown.weight});
        noise_ += std::pow(deviation_from(judged.truth, shown.value, shown.weight).noise, 2);
        for (std::size_t w = 0; w < ways_.size(); ++w) {
            if (w > 0) shown.value = ways_[w].at(lamp, judged.points);
            errors_[w].indirect.add(judged.truth, shown, indirect, lamp_weight);
            errors_[w].total.add(truth, {with(shown.value, direct), shown.weight}, total,
                                 lamp_weight);
            errors_[w].look_for_worst(judged, visible, shown.value);
        }
        result_.places += static_cast<int>(judged.points.size());
        ++result_.lights;
    }

    void conclude() {
        result_.noise = std::sqrt(noise_ / result_.lights);
        for (std::size_t w = 0; w < ways_.size(); ++w) {
            ShownError& one = result_.shown.emplace_back();
            one.name = ways_[w].name;
            one.indirect = errors_[w].indirect.size();
            one.total = errors_[w].total.size();
            one.squares = errors_[w].indirect.squares();
            if (std::isfinite(errors_[w].worst.error))
                one.worst = judged_again(ways_[w], errors_[w].worst);
        }
    }

    WorstPlace judged_again(const ShownLight& way, const WorstSoFar& found) {
        NoiseTarget target;
        target.floor = 0;
        target.most_samples = 1 << 16;
        PathTracing tracing;
        tracing.seed = seed_of(worst_stream);
        const std::vector<SurfacePoint> place{found.point};
        const LightSurvey fresh =
            traced_indirect(scene_, visibility_, found.lamp, place, target, tracing);
        result_.rays += fresh.rays;
        WorstPlace worst;
        worst.point = found.point;
        worst.lamp = found.lamp.position;
        worst.shown = lux_of_unit_lamp * luminance(way.at(found.lamp, place).front());
        worst.judged = lux_of_unit_lamp * luminance(fresh.at.front().mean);
        worst.noise = lux_of_unit_lamp * luminance(fresh.at.front().standard_error);
        return worst;
    }

    const Scene scene_;
    const RadianceSpace& space_;
    const Visibility& visibility_;
    const DirectLight direct_;
    const std::vector<ShownLight>& ways_;
    const VerifyOptions& options_;
    std::vector<WayErrors> errors_;  // by way
    double noise_ = 0;               // squares, summed over lamps
    Verification result_;
};

}  // namespace

Verification verify(const Scene& scene, const RadianceSpace& space, const Visibility& visibility,
                    const OccluderTree& occluders, const std::vector<ShownLight>& ways,
                    const VerifyOptions& options, const Progress& progress) {
    LIGHTWELL_CHECK(!ways.empty());
    return Verifier(scene, space, visibility, occluders, ways, options).run(progress);
}

}  // namespace lightwell
