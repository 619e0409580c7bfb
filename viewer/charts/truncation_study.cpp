#include "viewer/charts/truncation_study.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/operator/light_projection.h"
#include "solver/reference/random_lights.h"
#include "solver/series/neumann_series.h"

namespace lightwell {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Root mean squares over lamps of the direct light's coefficients, each lamp scaled so that its
/// indirect light has norm one.
Eigen::ArrayXd expected_light(const GlobalTransport& transport, const ChartedScene& scene,
                              const std::vector<Vec3>& positions) {
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(transport.space.functions());
    for (const Vec3& position : positions) {
        PointLight lamp;
        lamp.position = position;
        lamp.intensity = Rgb::Ones();
        const RadianceField direct =
            projected_lights(transport.space, {lamp}, scene.quads, scene.occluders);
        const double size = (global_light(transport, direct) - direct).matrix().norm();
        if (size > 0) squares += (direct.col(1) / size).square() / positions.size();
    }
    return squares.sqrt();
}

/// T of each distinct channel.
std::vector<Sparse> bounces_of(const GlobalTransport& transport) {
    const RadianceField reflectance = reflectance_of(transport.scene, transport.space);
    std::vector<Sparse> bounces;
    for (int distinct = 0; distinct < static_cast<int>(transport.indirect.size()); ++distinct) {
        const auto colour =
            std::find(transport.channel.begin(), transport.channel.end(), distinct) -
            transport.channel.begin();
        bounces.push_back(to_matrix(transport.bounce, reflectance.col(colour)));
    }
    return bounces;
}

double nonzeros(const std::vector<Sparse>& matrices) {
    double count = 0;
    for (const Sparse& one : matrices)
        count += static_cast<double>(one.nonZeros());
    return count;
}

class Study {
  public:
    Study(const GlobalTransport& transport, const ChartedScene& scene, const JudgedScene& judge,
          const Progress& progress)
        : transport_(transport),
          judge_(judge),
          progress_(progress),
          bounces_(bounces_of(transport)) {
        constexpr int lamps = 256;  // as precompute expects
        rule_.weight = expected_light(
            transport, scene, positions_in_rooms(scene.scene, scene.visibility, lamps, 1975));
        rule_.is_mean.assign(transport.space.functions(), false);
        for (std::size_t e = 0; e < transport.space.elements().size(); ++e)
            rule_.is_mean[transport.space.element(e).first] = true;
        std::vector<Vec3> judged;
        for (const JudgedLight& one : judge.lights())
            judged.push_back(one.light.position);
        best_rule_.weight = expected_light(transport, scene, judged);
        best_rule_.is_mean.assign(transport.space.functions(), false);
    }

    Series powers(double threshold) {
        constexpr int most_bounces = 10;
        rule_.threshold = threshold;
        Series series{fmt::format("threshold {:g}", threshold), {}};
        std::vector<Sparse> power;
        for (const Sparse& one : bounces_)
            power.push_back(truncated(one, rule_));
        const std::vector<Sparse> first = power;
        for (int bounce = 1; bounce <= most_bounces && nonzeros(power) > 0; ++bounce) {
            series.points.emplace_back(bounce, nonzeros(power));
            for (std::size_t c = 0; c < power.size(); ++c)
                power[c] = truncated_product(first[c], power[c], rule_, progress_);
        }
        return series;
    }

    std::vector<Sparse> summed(double threshold) {
        rule_.threshold = threshold;
        std::vector<Sparse> sums;
        for (const Sparse& one : bounces_)
            sums.push_back(neumann_series(one, rule_, progress_).sum);
        return sums;
    }

    /// Adds what an operator of these coefficients shows.
    void judge(const std::vector<Sparse>& global, double across, Propagation propagation,
               std::vector<Series*> series_by_threshold, Series& by_size) const {
        GlobalTransport changed = transport_;
        for (std::size_t c = 0; c < global.size(); ++c)
            changed.indirect[c] = to_operator(global[c]);
        const Interval error = judge_.error_of(changed, propagation);
        if (!(error.value > 0)) return;
        for (Series* one : series_by_threshold)
            one->points.emplace_back(across, 100 * error.value);
        by_size.points.emplace_back(nonzeros(global), 100 * error.value);
    }

    std::vector<Sparse> best(const std::vector<Sparse>& whole, double threshold) {
        best_rule_.threshold = threshold;
        std::vector<Sparse> kept;
        for (const Sparse& one : whole)
            kept.push_back(truncated(one, best_rule_));
        return kept;
    }

  private:
    const GlobalTransport& transport_;
    const JudgedScene& judge_;
    const Progress& progress_;
    std::vector<Sparse> bounces_;
    TruncationRule rule_, best_rule_;
};

}  // namespace

TruncationStudy study_of_truncation(const GlobalTransport& transport, const ChartedScene& scene,
                                    const JudgedScene& judge, const std::vector<double>& thresholds,
                                    const Progress& progress) {
    Study study(transport, scene, judge, progress);
    TruncationStudy result;
    result.error_of_global.name = result.global_by_size.name = "GTO";
    result.error_of_gathered.name = result.gathered_by_size.name = "gathered GTO";
    result.best_by_size.name = "best N coefficients";
    result.best_by_size.is_limit = true;
    for (const double threshold : thresholds) {
        result.coefficients_of_powers.push_back(study.powers(threshold));
        const std::vector<Sparse> global = study.summed(threshold);
        study.judge(global, threshold, Propagation::stored, {&result.error_of_global},
                    result.global_by_size);
        study.judge(global, threshold, Propagation::gathered, {&result.error_of_gathered},
                    result.gathered_by_size);
    }
    // Of as much as can be had.
    std::vector<double> finer = thresholds;
    finer.push_back(thresholds.back() / 3);
    const std::vector<Sparse> whole = study.summed(finer.back());
    for (const double threshold : finer)
        study.judge(study.best(whole, threshold), threshold, Propagation::stored, {},
                    result.best_by_size);
    return result;
}

}  // namespace lightwell
