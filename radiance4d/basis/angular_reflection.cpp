#include "radiance4d/basis/angular_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tbb/collaborative_call_once.h>
#include <tbb/parallel_for.h>

#include "radiance4d/basis/direction_map.h"
#include "radiance4d/failure.h"
#include "radiance4d/gauss_rule.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// Of the angular square: 4^5 cells.
constexpr int finest_level = 5;
/// Levels below the finest cells to which the integration goes at most.
constexpr int levels_below = 2;
/// Pairs of cells are cut in any case down to this level: no lobe of interest slips through.
constexpr int least_level = 3;
/// Pairs of cells of this level are integrated at once.
constexpr int shared_level = 2;
/// The kernel, which is rho for a diffuse surface, may vary by this over a pair of cells ...
constexpr double allowed_variation = 0.1;
/// ... or by this share of its mean there.
constexpr double allowed_share = 0.6;

CellTree square_tree(int levels) {
    return CellTree(std::vector<Split>(static_cast<std::size_t>(levels), Split::both));
}

/// Directions at the centres of all cells of each level.
std::vector<std::vector<Vec3>> centres(const CellTree& tree) {
    std::vector<std::vector<Vec3>> result;
    for (int level = 0; level <= tree.levels(); ++level) {
        result.emplace_back();
        for (std::uint32_t m = 0; m < tree.cells(level); ++m) {
            const ParameterRect r = tree.rect({level, m});
            result.back().push_back(
                direction_from_square({0.5 * (r.u0 + r.u1), 0.5 * (r.v0 + r.v1)}));
        }
    }
    return result;
}

/// Integrates the kernel pi f over pairs of cells.
class KernelIntegral {
  public:
    KernelIntegral(const Lobe& lobe, int levels)
        : lobe_(lobe),
          levels_(levels),
          centre_(centres(square_tree(levels + levels_below + 1))),
          mean_(RowMatrix::Zero(Eigen::Index{1} << (2 * levels), Eigen::Index{1} << (2 * levels))) {
        // Each pair of cells of one level writes a part of its own, incident ones of a quarter
        // only: nothing changes where both directions are mirrored at an axis of the square, which
        // flips that axis's bit of a cell's number at every level.
        const int level = std::min(shared_level, levels);
        const std::uint32_t cells = std::uint32_t{1} << (2 * level);
        const std::uint32_t first_quarter = level > 0 ? cells / 4 : cells;
        tbb::parallel_for(std::uint32_t{0}, first_quarter * cells,
                          [&](std::uint32_t pair) { visit(level, pair / cells, pair % cells); });
        const Eigen::Index quarter = mean_.rows() / 4;
        const Eigen::Index one_axis = (mean_.rows() - 1) / 3;
        for (Eigen::Index part = 1; part <= 3 && level > 0; ++part)
            for (Eigen::Index a = 0; a < quarter; ++a)
                for (Eigen::Index b = 0; b < mean_.cols(); ++b)
                    mean_(a ^ (part * one_axis), b ^ (part * one_axis)) = mean_(a, b);
    }

    /// Means over the pairs of finest cells, reciprocal to the last digit.
    RowMatrix mean() const { return 0.5 * (mean_ + mean_.transpose()); }

  private:
    void visit(int level, std::uint32_t a, std::uint32_t b) {
        const auto& points = centre_[static_cast<std::size_t>(level) + 1];
        std::array<double, 16> value{};
        double sum = 0, lowest = INFINITY, highest = 0;
        for (std::uint32_t i = 0; i < 4; ++i) {
            for (std::uint32_t j = 0; j < 4; ++j) {
                const double k = M_PI * lobe_value(lobe_, points[4 * a + i], points[4 * b + j]);
                value[4 * i + j] = k;
                sum += k;
                lowest = std::min(lowest, k);
                highest = std::max(highest, k);
            }
        }
        const double mean = sum / 16;
        const bool even = level >= least_level &&
                          highest - lowest <= std::max(allowed_variation, allowed_share * mean);
        if (level < levels_ + levels_below && !even) {
            for (std::uint32_t i = 0; i < 4; ++i)
                for (std::uint32_t j = 0; j < 4; ++j)
                    visit(level + 1, 4 * a + i, 4 * b + j);
            return;
        }
        if (level >= levels_) {
            const int below = 2 * (level - levels_);
            mean_(a >> below, b >> below) += mean * std::pow(0.0625, level - levels_);
            return;
        }
        const Eigen::Index side = Eigen::Index{1} << (2 * (levels_ - level - 1));
        for (std::uint32_t i = 0; i < 4; ++i)
            for (std::uint32_t j = 0; j < 4; ++j)
                mean_.block((4 * a + i) * side, (4 * b + j) * side, side, side)
                    .setConstant(value[4 * i + j]);
    }

    const Lobe& lobe_;
    int levels_;
    std::vector<std::vector<Vec3>> centre_;
    RowMatrix mean_;
};

/// The lobe's albedo over the cosine as a table, dense at grazing angles, where it may be steep.
class AlbedoTable {
  public:
    explicit AlbedoTable(const Lobe& lobe) {
        for (int k = 0; k <= entries; ++k)
            albedo_.push_back(lobe_albedo(lobe, std::pow(k / double{entries}, 2)));
    }
    double at(double cosine) const {
        const double place = std::sqrt(cosine) * entries;
        const auto cell =
            std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(entries - 1));
        const double rest = place - static_cast<double>(cell);
        return (1 - rest) * albedo_[cell] + rest * albedo_[cell + 1];
    }

  private:
    static constexpr int entries = 96;
    std::vector<double> albedo_;
};

/// Mean albedo of the lobe over every cell of a level.
Eigen::ArrayXd albedo_of_cells(const AlbedoTable& albedo, int level) {
    const int points = 1024 >> level;  // the same grid at every level, fine at the square's edge
    const CellTree tree = square_tree(level);
    Eigen::ArrayXd result(static_cast<Eigen::Index>(tree.functions()));
    for (std::uint32_t m = 0; m < tree.functions(); ++m) {
        const ParameterRect r = tree.rect({level, m});
        double sum = 0;
        for (int i = 0; i < points; ++i)
            for (int j = 0; j < points; ++j)
                sum += albedo.at(
                    direction_from_square({r.u0 + (i + 0.5) / points * (r.u1 - r.u0),
                                           r.v0 + (j + 0.5) / points * (r.v1 - r.v0)})[2]);
        result[m] = sum / (points * points);
    }
    return result;
}

/// Scales a symmetric matrix of means over pairs of cells so that uniform light is reflected by the
/// given albedo of each cell: D K D with D diagonal (Sinkhorn 1967). The quadrature is a little off
/// where the kernel is sharp, and what it lacks every bounce would lack.
void reflect_in_all(const Eigen::ArrayXd& albedo_of_cell, RowMatrix& mean) {
    constexpr int sweeps = 12;
    Eigen::ArrayXd scale = Eigen::ArrayXd::Ones(albedo_of_cell.size());
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        const Eigen::ArrayXd reflected =
            scale * (mean * scale.matrix()).array() / static_cast<double>(albedo_of_cell.size());
        scale *= (reflected > 0).select((albedo_of_cell / reflected).sqrt(), 1.0);
    }
    mean = (scale.matrix().asDiagonal() * mean * scale.matrix().asDiagonal()).eval();
}

/// Wavelets on both sides of a symmetric matrix over the finest cells.
RowMatrix transformed(const RowMatrix& by_cell, int levels) {
    const HaarBasis basis = angular_basis(levels);
    RowMatrix result = by_cell;
    basis.analyse(result, levels);
    RowMatrix other = result.transpose();
    basis.analyse(other, levels);
    return other;
}

/// Int Int kernel^2 over both squares.
double kernel_square(const Lobe& lobe) {
    const GaussRule rule(16);
    double mean = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        mean += rule.weights[k] * 2 * rule.nodes[k] * lobe_square(lobe, rule.nodes[k]);
    return M_PI * mean;
}

}  // namespace

HaarBasis angular_basis(int levels) {
    const Quad square{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}};
    return {square, square_tree(levels)};
}

struct LobeLevels::Level {
    tbb::collaborative_once_flag once;
    RowMatrix matrix;
    double error = 0;
};

struct LobeLevels::Kept {
    explicit Kept(const Lobe& of) : lobe(of) {}

    void represent(int number) {
        Level& level = levels[static_cast<std::size_t>(number)];
        const Eigen::Index functions = Eigen::Index{1} << (2 * number);
        if (std::holds_alternative<NoLobe>(lobe)) {
            level.matrix = RowMatrix::Zero(functions, functions);
            return;
        }
        tbb::collaborative_call_once(tables_once, [this] {
            square = kernel_square(lobe);
            albedo.emplace(lobe);
        });
        RowMatrix mean = KernelIntegral(lobe, number).mean();
        reflect_in_all(albedo_of_cells(*albedo, number), mean);
        level.matrix = transformed(mean / static_cast<double>(functions), number);
        level.error = std::sqrt(std::max(0.0, 1 - level.matrix.squaredNorm() / square));
    }

    const Lobe lobe;
    std::array<Level, finest_level + 1> levels;
    tbb::collaborative_once_flag tables_once;  // of what all levels need
    double square = 0;
    std::optional<AlbedoTable> albedo;
};

LobeLevels::LobeLevels(const Lobe& lobe) : kept_(std::make_shared<Kept>(lobe)) {}

const LobeLevels::Level& LobeLevels::at(int level) const {
    LIGHTWELL_CHECK_OP(level, >=, 0);
    LIGHTWELL_CHECK_OP(level, <=, finest_level);
    Level& result = kept_->levels[static_cast<std::size_t>(level)];
    tbb::collaborative_call_once(result.once, [&] { kept_->represent(level); });
    return result;
}

const Lobe& LobeLevels::lobe() const {
    return kept_->lobe;
}

const RowMatrix& LobeLevels::matrix(int level) const {
    return at(level).matrix;
}

double LobeLevels::error(int level) const {
    return at(level).error;
}

SceneLobes lobes_of(const std::vector<Material>& materials) {
    SceneLobes lobes;
    for (const Material& material : materials)
        lobes.emplace_back(material.lobe);
    return lobes;
}

AngularReflection::AngularReflection(LobeLevels lobe, int first, int last, double tolerance)
    : lobe_(std::move(lobe)), level_(first) {
    if (std::holds_alternative<NoLobe>(lobe_.lobe())) return;
    error_by_level_ = {lobe_.error(level_)};
    while (error_by_level_.back() > tolerance && level_ < last)
        error_by_level_.push_back(lobe_.error(++level_));
    follows_ = error_by_level_.back() <= tolerance;
}

AngularReflection::AngularReflection(const Lobe& lobe, const AngularResolution& resolution)
    : AngularReflection(LobeLevels(lobe), resolution) {}

AngularReflection::AngularReflection(const LobeLevels& lobe, const AngularResolution& resolution)
    : AngularReflection(lobe,
                        std::holds_alternative<NoLobe>(lobe.lobe()) ? 0 : resolution.least_levels,
                        resolution.most_levels, resolution.tolerance) {}

AngularReflection AngularReflection::at_level(const Lobe& lobe, int level) {
    return at_level(LobeLevels(lobe), level);
}

AngularReflection AngularReflection::at_level(const LobeLevels& lobe, int level) {
    return {lobe, level, level, AngularResolution{}.tolerance};
}

}  // namespace lightwell
