// One row of the table of costs (after WRT table 1), from a fresh computation:
//
//     table1 SCENE [--error E] [--name NAME]
//
// prints one JSON object. `./dev table1` runs it for all rows, each in a process of its own, so
// that the memory of one does not count for the next.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

#include "radiance4d/operator/light_projection.h"
#include "radiance4d/scene/brdf.h"
#include "runtime/frame.h"
#include "runtime/projection/shadow_projection.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/random_lights.h"
#include "solver/series/directed_series.h"
#include "solver/series/neumann_series.h"
#include "solver/series/trial_lights.h"
#include "solver/series/truncation.h"
#include "viewer/commands/opened_operator.h"

namespace lightwell {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// A lamp of unit intensity.
PointLight lamp_at(const Vec3& position) {
    PointLight lamp;
    lamp.position = position;
    lamp.intensity = Rgb::Ones();
    return lamp;
}

/// I + H of a channel.
Sparse all_bounces(const TransportOperator& indirect) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::uint32_t column = 0; column < indirect.size; ++column) {
        entries.emplace_back(column, column, 1.0);
        for (std::uint64_t k = indirect.column_start[column]; k < indirect.column_start[column + 1];
             ++k)
            entries.emplace_back(indirect.row[k], column, indirect.value[k]);
    }
    Sparse result(indirect.size, indirect.size);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// The gathered GTO, T_fine (I + H), truncated again after the product (WRT section
/// 4.4): how many coefficients it has when leaving out the rest costs as much as it may in H.
class GatheredOperator {
  public:
    explicit GatheredOperator(const OpenedOperator& opened) : transport_(opened.transport) {
        constexpr int lamps = 24, tried = 8;
        std::vector<Eigen::ArrayXd> fields;
        const auto positions =
            positions_in_rooms(transport_.scene, opened.visibility, lamps + tried, 2006);
        for (const Vec3& position : positions)
            fields.push_back(projected_lights(transport_.space, {lamp_at(position)}, opened.quads,
                                              opened.occluders)
                                 .col(1));
        direct_ = fields;
        const auto functions = static_cast<Eigen::Index>(transport_.space.functions());
        rule_.weight = Eigen::ArrayXd::Zero(functions);
        rule_.is_mean.assign(transport_.space.functions(), false);
        for (const Element& element : transport_.space.elements())
            rule_.is_mean[element.first] = true;
    }

    std::uint64_t coefficients() {
        if (direct_.empty()) return 0;
        std::uint64_t count = 0;
        for (std::size_t c = 0; c < transport_.indirect.size(); ++c) {
            const auto colour = std::find(transport_.channel.begin(), transport_.channel.end(),
                                          static_cast<int>(c)) -
                                transport_.channel.begin();
            count += of_channel(c, static_cast<int>(colour));
        }
        return count;
    }

  private:
    std::uint64_t of_channel(std::size_t c, int colour) {
        constexpr double share_of_error = 0.3, small = 0.2;
        const Sparse global = all_bounces(transport_.indirect[c]);
        const Sparse bounce = one_bounce(colour);
        std::vector<Eigen::ArrayXd> gathered;
        rule_.weight.setZero();
        for (const Eigen::ArrayXd& light : direct_) {
            gathered.emplace_back((bounce * (global * light.matrix()).eval()).array());
            const double norm = gathered.back().matrix().norm();
            if (norm > 0) rule_.weight += (light / norm).square() / direct_.size();
        }
        rule_.weight = rule_.weight.sqrt();
        const double mean = std::sqrt(rule_.weight.square().mean());
        rule_.weight = rule_.weight.max(0.1 * mean);

        const double target = transport_.provenance.truncation;
        std::vector<double> magnitudes;
        for (Eigen::Index j = 0; j < bounce.outerSize(); ++j)
            for (Sparse::InnerIterator it(bounce, j); it; ++it)
                magnitudes.push_back(weighted(rule_, it.row(), j, it.value()));
        const double guess = threshold_for_budget(magnitudes, share_of_error * target);
        rule_.threshold = small * guess;
        const Sparse product = truncated_product(bounce, global, rule_);
        const TrialLights lights = trial_lights(direct_), wanted = trial_lights(gathered);
        rule_.threshold = calibrated_threshold(guess, target, [&](double at) {
            TruncationRule higher = rule_;
            higher.threshold = at;
            return relative_change(truncated_indirect(product, higher, lights), wanted);
        });
        return static_cast<std::uint64_t>(truncated(product, rule_).nonZeros());
    }

    /// T of a channel: M diag(rho) or P R.
    Sparse one_bounce(int colour) const {
        if (!has_angles(transport_.space))
            return to_matrix(transport_.bounce,
                             reflectance_of(transport_.scene, transport_.space).col(colour));
        Rgb shares = Rgb::Zero();
        shares[colour] = 1;
        TruncationRule rounding = rule_;
        rounding.weight = Eigen::ArrayXd::Ones(transport_.space.functions());
        rounding.threshold = 4e-8;  // the square of the least that is kept of R
        const Sparse propagation =
            to_matrix(transport_.bounce, Eigen::ArrayXd::Ones(transport_.space.functions()));
        return truncated_product(
            propagation, reflection_into(propagation, transport_.reflection, shares), rounding);
    }

    const GlobalTransport& transport_;
    std::vector<Eigen::ArrayXd> direct_;
    TruncationRule rule_;
};

/// Median seconds to light the scene anew for a lamp that stands elsewhere in each frame:
/// projection, propagation and synthesis of textures.
double frame_seconds(const OpenedOperator& opened) {
    constexpr int frames = 41;
    const auto positions =
        positions_in_rooms(opened.transport.scene, opened.visibility, frames, 1992);
    if (positions.empty()) return 0;
    Frame frame(opened.transport, std::make_unique<ShadowProjection>(
                                      opened.transport.space, opened.quads, opened.occluders));
    std::vector<double> seconds;
    frame.light({lamp_at(positions.front())});  // gets memory
    for (const Vec3& position : positions) {
        const FrameReport& report = frame.light({lamp_at(position)});
        seconds.push_back(report.projection_seconds + report.propagation_seconds +
                          report.synthesis_seconds);
    }
    std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
    return seconds[seconds.size() / 2];
}

double peak_mebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

nlohmann::ordered_json row(const std::string& file, const std::string& name, double error) {
    PrecomputeOptions options;
    options.error = error;
    options.most_attempts = 1;
    PrecomputeReport report;
    const Scene scene = read_scene(file).scene;
    const OpenedOperator operators = opened(precompute(scene, options, {}, report));
    const double peak = peak_mebibytes();
    const GlobalTransport& transport = operators.transport;
    std::uint64_t global = 0;
    for (const TransportOperator& one : transport.indirect)
        global += one.coefficients();
    nlohmann::ordered_json json;
    json["name"] = name.empty() ? scene.name : name;
    json["error"] = error;
    json["estimated"] = transport.provenance.error_estimated;
    json["series_seconds"] = report.seconds["series"];
    json["estimate_seconds"] = report.seconds["estimate"];
    json["transport_seconds"] =
        report.seconds["total"] - report.seconds["series"] - report.seconds["estimate"];
    json["links"] = transport.provenance.links;
    json["dto"] = transport.bounce.coefficients();
    json["gto"] = global;
    json["gathered"] = GatheredOperator(operators).coefficients();
    json["frame_seconds"] = frame_seconds(operators);
    json["operator_mebibytes"] =
        static_cast<double>(8 * (transport.bounce.coefficients() + global)) / 1048576;
    json["peak_mebibytes"] = peak;
    return json;
}

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    CLI::App app{"One row of the table of costs."};
    std::string scene, name;
    double error = 0.05;
    app.add_option("SCENE", scene)->required();
    app.add_option("--error", error);
    app.add_option("--name", name);
    CLI11_PARSE(app, argc, argv);
    try {
        std::cout << lightwell::row(scene, name, error).dump() << std::endl;
        return 0;
    } catch (const std::exception& failure) {
        std::cerr << "table1: " << failure.what() << '\n';
        return 1;
    }
}
