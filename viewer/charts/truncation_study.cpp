#include "viewer/charts/truncation_study.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/operator/light_projection.h"
#include "solver/reference/random_lights.h"
#include "solver/series/neumann_series.h"

namespace lightwell {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

RadianceField light_of(const PointLight& lamp, const GlobalTransport& transport,
                       const ChartedScene& scene) {
    return projected_lights(transport.space, {lamp}, scene.quads, scene.occluders);
}

RadianceField all_bounces(const GlobalTransport& transport, const RadianceField& direct) {
    constexpr double negligible = 1e-4;
    return solved_light(transport, direct, negligible);
}

/// Root mean squares over lamps of the direct light's coefficients, each lamp scaled so that its
/// indirect light has norm one.
Eigen::ArrayXd expected_light(const GlobalTransport& transport, const ChartedScene& scene,
                              const std::vector<Vec3>& positions) {
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(transport.space.functions());
    for (const Vec3& position : positions) {
        PointLight lamp;
        lamp.position = position;
        lamp.intensity = Rgb::Ones();
        const RadianceField direct = light_of(lamp, transport, scene);
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

/// All of H = (I - T)^-1 - I of each distinct channel, in single precision.
std::vector<Eigen::MatrixXf> whole_series(const std::vector<Sparse>& bounces) {
    std::vector<Eigen::MatrixXf> whole(bounces.size());
    tbb::parallel_for(std::size_t{0}, bounces.size(), [&](std::size_t c) {
        const Eigen::Index n = bounces[c].rows();
        const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
        const Eigen::MatrixXd inverse =
            Eigen::PartialPivLU<Eigen::MatrixXd>(identity - bounces[c].toDense()).inverse();
        whole[c] = (inverse - identity).cast<float>();
    });
    return whole;
}

/// The coefficients of a matrix whose weighted size is at least a threshold.
TransportOperator largest_of(const Eigen::MatrixXf& matrix, const Eigen::ArrayXd& weight,
                             double threshold) {
    TransportOperator kept;
    kept.size = static_cast<std::uint32_t>(matrix.rows());
    kept.column_start.push_back(0);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
        for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
            if (std::abs(matrix(i, j)) * weight[j] < threshold) continue;
            kept.row.push_back(static_cast<std::uint32_t>(i));
            kept.value.push_back(matrix(i, j));
        }
        kept.column_start.push_back(kept.value.size());
    }
    return kept;
}

double coefficients_of(const std::vector<TransportOperator>& operators) {
    double count = 0;
    for (const TransportOperator& one : operators)
        count += static_cast<double>(one.coefficients());
    return count;
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
        : changed_(transport), judge_(judge), progress_(progress), bounces_(bounces_of(transport)) {
        constexpr int lamps = 256;  // as precompute expects
        rule_.weight = expected_light(
            transport, scene, positions_in_rooms(scene.scene, scene.visibility, lamps, 1975));
        rule_.is_mean.assign(transport.space.functions(), false);
        std::vector<Vec3> judged;
        for (const JudgedLight& one : judge.lights()) {
            judged.push_back(one.light.position);
            direct_.push_back(light_of(one.light, transport, scene));
            solved_.push_back(all_bounces(transport, direct_.back()));
        }
        judged_weight_ = expected_light(transport, scene, judged);
        whole_error_ = judge.error_of(transport, Propagation::solved).rms;
    }

    /// Of the whole operator, as judged.
    const Interval& whole_error() const { return whole_error_; }

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

    /// The truncated series becomes the operator that is judged from here on.
    void sum(double threshold) {
        rule_.threshold = threshold;
        for (std::size_t c = 0; c < bounces_.size(); ++c)
            changed_.indirect[c] = to_operator(neumann_series(bounces_[c], rule_, progress_).sum);
    }

    double coefficients() const { return coefficients_of(changed_.indirect); }

    /// Adds the judged error of the operator to series.
    void judge(Propagation propagation, const std::vector<std::pair<Series*, double>>& at) const {
        const Interval error = judge_.error_of(changed_, propagation).rms;
        if (!(error.value > 0)) return;
        for (const auto& [series, across] : at) {
            if (!(across > 0)) continue;
            series->points.emplace_back(across, 100 * error.value);
            series->spans.emplace_back(100 * error.low, 100 * error.high);
        }
    }

    /// Error [%] against what the whole operator makes, over the lamps that judge.
    double own_error(const std::function<RadianceField(const GlobalTransport&,
                                                       const RadianceField&)>& light) const {
        double sum = 0;
        for (std::size_t k = 0; k < direct_.size(); ++k) {
            const double norm = solved_[k].matrix().norm();
            if (norm > 0)
                sum +=
                    std::pow((light(changed_, direct_[k]) - solved_[k]).matrix().norm() / norm, 2);
        }
        return 100 * std::sqrt(sum / static_cast<double>(direct_.size()));
    }

    /// The best by weight, for more and more coefficients until more would change nothing.
    Series best() {
        constexpr double fewest = 250, step = 1.6, as_good = 1.01;
        const std::vector<Eigen::MatrixXf> whole = whole_series(bounces_);
        std::vector<float> sizes;
        for (const Eigen::MatrixXf& one : whole)
            for (Eigen::Index j = 0; j < one.cols(); ++j)
                for (Eigen::Index i = 0; i < one.rows(); ++i)
                    sizes.push_back(static_cast<float>(std::abs(one(i, j)) * judged_weight_[j]));
        std::sort(sizes.begin(), sizes.end(), std::greater<>());
        Series series{"best N coefficients of G by weight", {}};
        series.is_limit = true;
        for (double count = fewest; count < static_cast<double>(sizes.size()); count *= step) {
            progress_.check();
            const double threshold = sizes[static_cast<std::size_t>(count)];
            if (!(threshold > 0)) break;
            for (std::size_t c = 0; c < whole.size(); ++c)
                changed_.indirect[c] = largest_of(whole[c], judged_weight_, threshold);
            judge(Propagation::stored, {{&series, coefficients()}});
            if (!series.points.empty() &&
                series.points.back().second < as_good * 100 * whole_error_.value)
                break;
        }
        series.spans.clear();
        return series;
    }

  private:
    GlobalTransport changed_;
    const JudgedScene& judge_;
    const Progress& progress_;
    std::vector<Sparse> bounces_;
    TruncationRule rule_;
    Eigen::ArrayXd judged_weight_;
    std::vector<RadianceField> direct_, solved_;  ///< by lamp that judges
    Interval whole_error_;
};

}  // namespace

TruncationStudy study_of_truncation(const GlobalTransport& transport, const ChartedScene& scene,
                                    const JudgedScene& judge, const std::vector<double>& thresholds,
                                    const Progress& progress) {
    Study study(transport, scene, judge, progress);
    TruncationStudy result;
    result.cells = transport.space.functions();
    result.judged_global.name = result.global_by_size.name = "GTO";
    result.judged_gathered.name = result.gathered_by_size.name = "gathered GTO";
    result.own_global.name = "GTO: own error";
    result.own_gathered.name = "gathered GTO: own error";
    result.judged_whole.name = "whole operator";
    result.judged_whole.is_limit = true;
    for (const double threshold : thresholds) {
        result.coefficients_of_powers.push_back(study.powers(threshold));
        study.sum(threshold);
        const double size = study.coefficients();
        study.judge(Propagation::stored,
                    {{&result.judged_global, threshold}, {&result.global_by_size, size}});
        study.judge(Propagation::gathered,
                    {{&result.judged_gathered, threshold}, {&result.gathered_by_size, size}});
        result.own_global.points.emplace_back(
            threshold, study.own_error([](const GlobalTransport& t, const RadianceField& direct) {
                return RadianceField(global_light(t, direct) - direct);
            }));
        result.own_gathered.points.emplace_back(threshold, study.own_error(gathered_light));
        if (study.whole_error().value > 0)
            result.judged_whole.points.emplace_back(threshold, 100 * study.whole_error().value);
    }
    result.best_by_size = study.best();
    return result;
}

}  // namespace lightwell
