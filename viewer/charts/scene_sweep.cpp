#include "viewer/charts/scene_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "viewer/charts/operator_sweep.h"
#include "viewer/charts/sweep_plan.h"

namespace lightwell {

namespace {

enum Colour { default_colour, paper_colour, compressed_colour, varied_colour, traced_colour };

/// Threshold of the paper's oracle over the error that it is to reach: what its samples of a link
/// may differ by, of the link's largest value.
constexpr double paper_tolerance = 0.3;

/// One setting changed by hand: what the default sets, times this.
struct Variation {
    const char* name;
    double cell_size, oracle_tolerance, truncation;  ///< 1: left to the default
};

std::optional<double> by_hand(double of_default, double times) {
    if (times == 1) return std::nullopt;
    return times * of_default;
}

/// Cells by a whole level, the others by what changes the cost noticeably.
constexpr std::array<Variation, 6> variations{{{"cells x 0.5", 0.5, 1, 1},
                                               {"cells x 2", 2, 1, 1},
                                               {"oracle x 0.3", 1, 0.3, 1},
                                               {"oracle x 3", 1, 3, 1},
                                               {"truncation x 0.6", 1, 1, 0.6},
                                               {"truncation x 1.7", 1, 1, 1.7}}};

std::string asked_text(double error) {
    return fmt::format("asked {:g} %", 100 * error);
}

/// Does one part of the sweep after the other.
class Sweep {
  public:
    Sweep(const Scene& of, bool quick, const Progress& progress)
        : scene_(of),
          is_glossy_(has_gloss(scene_.scene)),
          plan_(sweep_plan(scene_.scene.quads.size(), is_glossy_, quick)),
          progress_(progress),
          parts_(plan_.errors.size() + plan_.judged_errors.size() + variations.size() + 1) {
        if (!is_glossy_) parts_ += plan_.errors.size() + plan_.compressions.size() + 1;
    }

    SceneSweep run() {
        defaults();
        judged();
        varied();
        if (!is_glossy_) {
            paper();
            compressed();
            studied();
        } else {
            remark(
                "The paper's oracle, computing everything at the finest level, and what truncation "
                "does to an operator are left out: they are for scenes without gloss.");
        }
        traced();
        return std::move(sweep_);
    }

  private:
    void next_part() {
        progress_.check();
        progress_.say("chart", static_cast<double>(done_++) / static_cast<double>(parts_));
    }

    void remark(const std::string& text) { sweep_.remarks.push_back(text); }

    std::vector<MeasuredSetting> add(const Method& method, const std::string& setting,
                                     const BuiltOperator& one) {
        const std::vector<MeasuredSetting> more = measured(method, setting, one, scene_, *judge_);
        sweep_.settings.insert(sweep_.settings.end(), more.begin(), more.end());
        return more;
    }

    void defaults() {
        for (const double error : plan_.errors) {
            next_part();
            PrecomputeOptions asked;
            asked.error = error;
            const BuiltOperator one = built_once(scene_, asked, progress_);
            if (!judge_)
                judge_.emplace(scene_, one.transport, plan_.lamps, plan_.points, progress_);
            const MeasuredSetting gathered =
                add({"default", default_colour, Ways::all}, asked_text(error), one).front();
            gathered_.push_back(gathered);
            provenance_.push_back(one.transport.provenance);
            if (error == plan_.varied_error) {
                sweep_.unvaried = gathered;
                unvaried_ = one.transport.provenance;
            }
        }
        remark(fmt::format(
            "Errors are judged by path tracing: {} lamps that no operator was made for, {} places "
            "of the surface each, the same for all settings, with emitting quads off; bars are 95 "
            "% confidence over lamps anywhere. Rings go by the errors found: where bars overlap, "
            "other lamps may ring others.",
            plan_.lamps, plan_.points));
    }

    /// What the command takes that is asked for an error: with its judge, and as many operators as
    /// it builds.
    void judged() {
        for (const double error : plan_.judged_errors) {
            next_part();
            PrecomputeOptions asked;
            asked.error = error;
            const BuiltOperator one = built(scene_, asked, progress_);
            MeasuredSetting all;
            all.method = "default, with its judging";
            all.setting = asked_text(error);
            const JudgedError found = judge_->error_of(one.transport, Propagation::gathered);
            all.error = found.rms;
            all.worst_lamp = found.worst_lamp;
            all.cells = one.cells;
            all.precompute_seconds = one.seconds;
            all.rays = one.transport.provenance.rays + one.judge_rays;
            all.look = {default_colour, 3};
            sweep_.settings.push_back(all);
        }
    }

    void varied() {
        for (const Variation& change : variations) {
            next_part();
            PrecomputeOptions asked;
            asked.error = plan_.varied_error;
            asked.cell_size = by_hand(unvaried_.cell_size, change.cell_size);
            asked.oracle_tolerance = by_hand(unvaried_.oracle_tolerance, change.oracle_tolerance);
            asked.truncation = by_hand(unvaried_.truncation, change.truncation);
            const Method method{"default by hand", varied_colour, Ways::gathered, false};
            sweep_.varied.push_back(
                add(method, change.name, built_once(scene_, asked, progress_)).front());
        }
    }

    void paper() {
        for (const double error : plan_.errors) {
            next_part();
            PrecomputeOptions asked;
            asked.error = error;
            asked.oracle = OracleKind::variation;
            asked.oracle_tolerance = paper_tolerance * error;
            const std::string setting = fmt::format("oracle {:g}", paper_tolerance * error);
            try {
                add({"paper's oracle", paper_colour, Ways::gathered_and_stored}, setting,
                    built_once(scene_, asked, progress_));
            } catch (const InputError& failure) {
                remark(fmt::format("The paper's oracle with a threshold of {:g} is left out: {}.",
                                   paper_tolerance * error, failure.what()));
            }
        }
    }

    /// Cells of the default for the smallest error that has at most so many; wider ones, at most as
    /// many, where all have more.
    std::pair<double, double> cells_for(double most) const {
        for (std::size_t k = plan_.errors.size(); k-- > 0;)
            if (static_cast<double>(gathered_[k].cells) <= most)
                return {provenance_[k].cell_size, plan_.errors[k]};
        // Their number follows their area, but only in steps.
        const double wider = std::exp2(
            std::ceil(std::log2(std::sqrt(static_cast<double>(gathered_[0].cells) / most))));
        return {wider * provenance_[0].cell_size, plan_.errors[0]};
    }

    void compressed() {
        const auto [cell_size, error] = cells_for(plan_.most_dense_cells);
        std::uint64_t cells = 0;
        for (const double truncation : plan_.compressions) {
            next_part();
            PrecomputeOptions asked;
            asked.error = error;
            asked.cell_size = cell_size;
            asked.oracle_tolerance = 0;
            asked.truncation = truncation;
            cells = add({"compute and compress", compressed_colour, Ways::gathered_and_stored},
                        fmt::format("truncation {:g}", truncation),
                        built_once(scene_, asked, progress_))
                        .front()
                        .cells;
        }
        remark(fmt::format(
            "Everything is computed between {} cells of at most {:.2g} m and compressed then: its "
            "cost grows with the square of the cells, so that it is only had for few. The default "
            "for {:g} % has {} to {} of them; compare with those that have about as many.",
            cells, cell_size, 100 * plan_.errors.back(), gathered_.front().cells,
            gathered_.back().cells));
    }

    void studied() {
        next_part();
        // T as well as it can be had between these cells.
        PrecomputeOptions fine;
        fine.error = plan_.errors.back();
        fine.cell_size = cells_for(plan_.most_whole_cells).first;
        fine.truncation = 0.02;
        fine.most_attempts = 0;
        PrecomputeReport report;
        Progress silent;
        silent.stop_requested = progress_.stop_requested;
        sweep_.truncation = study_of_truncation(precompute(scene_.scene, fine, silent, report),
                                                scene_, *judge_, plan_.thresholds, progress_);
    }

    void traced() {
        next_part();
        const std::vector<MeasuredSetting> more =
            path_traced(gathered_, traced_colour, scene_, *judge_);
        sweep_.settings.insert(sweep_.settings.end(), more.begin(), more.end());
    }

    const ChartedScene scene_;
    const bool is_glossy_;
    const SweepPlan plan_;
    const Progress& progress_;
    std::size_t parts_, done_ = 0;
    std::optional<JudgedScene> judge_;
    std::vector<MeasuredSetting> gathered_;  ///< by error, of the default
    std::vector<Provenance> provenance_;
    Provenance unvaried_;
    SceneSweep sweep_;
};

}  // namespace

SceneSweep swept(const Scene& scene, bool quick, const Progress& progress) {
    return Sweep(scene, quick, progress).run();
}

}  // namespace lightwell
