#include "radiance4d/operator/reflection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

Reflection::Reflection(const Scene& scene, const RadianceSpace& space, const SceneLobes& lobes)
    : functions_(space.functions()) {
    const SceneLobes levels = lobes.empty() ? lobes_of(scene.materials) : lobes;
    const std::vector<Rgb> means = mean_albedos(scene.materials);
    std::map<std::pair<std::size_t, int>, int> known;  // material and level -> lobe
    for (const Element& element : space.elements()) {
        const std::size_t material = scene.material_number(element.quad);
        OfElement made;
        made.first = element.first;
        made.cells = element.space.tree().functions();
        made.angles = element.angle.functions();
        if (made.angles == 1) {
            made.diffuse = means[material];
        } else {
            const Material& what = scene.materials[material];
            const int level = element.angle.levels();
            const auto [entry, is_new] =
                known.try_emplace({material, level}, static_cast<int>(lobes_.size()));
            if (is_new) {
                lobes_.push_back(AngularReflection::at_level(levels[material], level));
                responses_.emplace_back(lobes_.back().matrix().transpose().cast<float>());
            }
            made.diffuse = what.reflectance;
            made.specular = lobe_reflectance(what.lobe);
            made.lobe = entry->second;
        }
        of_element_.push_back(made);
    }
}

RadianceField Reflection::outgoing(const RadianceField& incident) const {
    LIGHTWELL_CHECK_OP(incident.rows(), ==, static_cast<Eigen::Index>(functions_));
    RadianceField result(incident.rows(), 3);
    for (const OfElement& element : of_element_) {
        const Eigen::Index count = element.cells * element.angles;
        if (element.lobe < 0) {
            result.middleRows(element.first, count) =
                incident.middleRows(element.first, count).rowwise() * element.diffuse.transpose();
            continue;
        }
        // Most functions of fine directions hold no light: going through the others one by one
        // takes half the time of a product of matrices.
        const RowMatrix& lobe = lobes_[static_cast<std::size_t>(element.lobe)].matrix();
        RowMatrix out(3, element.angles);
        for (Eigen::Index k = 0; k < element.cells; ++k) {
            const Eigen::Index first = element.first + k * element.angles;
            out.setZero();
            for (Eigen::Index b = 0; b < element.angles; ++b)
                for (int c = 0; c < 3; ++c)
                    if (const double in = incident(first + b, c); in != 0)
                        out.row(c) += in * lobe.row(b);
            for (int c = 0; c < 3; ++c) {
                result.col(c).segment(first, element.angles) =
                    element.specular[c] * out.row(c).transpose().array();
                result(first, c) += element.diffuse[c] * incident(first, c);
            }
        }
    }
    return result;
}

Reflection::BetweenAngles Reflection::between_angles(const OfElement& element,
                                                     const Rgb& shares) const {
    return {(shares * element.diffuse).sum(), (shares * element.specular).sum(),
            element.lobe < 0 ? nullptr : &lobes_[static_cast<std::size_t>(element.lobe)].matrix()};
}

void Reflection::reflect(const Rgb& shares, const Functions& from, const Fields& incident,
                         const Functions& to, Fields& outgoing) const {
    LIGHTWELL_CHECK_OP(incident.rows(), ==, static_cast<Eigen::Index>(from.size()));
    outgoing.resize(static_cast<Eigen::Index>(to.size()), Fields::ColsAtCompileTime);
    const auto in_row = [&](std::size_t k) { return incident.row(static_cast<Eigen::Index>(k)); };
    std::size_t in = 0, out = 0;  // the next of `from` and `to`
    std::vector<std::uint32_t> angles;
    for (const OfElement& element : of_element_) {
        const auto diffuse = static_cast<float>((shares * element.diffuse).sum());
        const auto specular = static_cast<float>((shares * element.specular).sum());
        const auto directions = static_cast<std::uint32_t>(element.angles);
        const auto end = static_cast<std::uint32_t>(element.first + element.cells * element.angles);
        // Light stays in its spatial function: the functions of which, one for each of the
        // directions, follow each other.
        while (out < to.size() && to[out] < end) {
            const std::uint32_t first =
                to[out] - (to[out] - static_cast<std::uint32_t>(element.first)) % directions;
            while (in < from.size() && from[in] < first)
                ++in;
            const std::size_t first_in = in;
            angles.clear();
            for (; in < from.size() && from[in] < first + directions; ++in)
                angles.push_back(from[in] - first);
            const bool has_mean = !angles.empty() && angles.front() == 0;
            for (; out < to.size() && to[out] < first + directions; ++out) {
                const std::uint32_t leaving = to[out] - first;
                Eigen::Array<float, 1, Fields::ColsAtCompileTime> sum;
                sum.setZero();
                if (element.lobe >= 0) {
                    const float* response = responses_[static_cast<std::size_t>(element.lobe)]
                                                .row(static_cast<Eigen::Index>(leaving))
                                                .data();
                    for (std::size_t k = 0; k < angles.size(); ++k)
                        sum += response[angles[k]] * in_row(first_in + k);
                    sum *= specular;
                }
                if (leaving == 0 && has_mean) sum += diffuse * in_row(first_in);
                outgoing.row(static_cast<Eigen::Index>(out)) = sum;
            }
        }
    }
}

Eigen::SparseMatrix<double> Reflection::matrix(const Rgb& shares, double smallest,
                                               const std::vector<bool>& leaving) const {
    using Matrix = Eigen::SparseMatrix<double>;
    LIGHTWELL_CHECK_OP(leaving.size(), ==, std::size_t{functions_});
    // Light stays in its spatial function, so that each of these has columns of its own.
    const auto for_each_coefficient = [&](const auto& act) {
        for (const OfElement& element : of_element_) {
            const BetweenAngles between = between_angles(element, shares);
            tbb::parallel_for(Eigen::Index{0}, element.cells, [&](Eigen::Index k) {
                const Eigen::Index first = element.first + k * element.angles;
                for (Eigen::Index a = 0; a < element.angles; ++a) {
                    if (!leaving[static_cast<std::size_t>(first + a)]) continue;
                    for (Eigen::Index b = 0; b < element.angles; ++b) {
                        const double value = between(a, b);
                        if (std::abs(value) > smallest) act(first + a, first + b, value);
                    }
                }
            });
        }
    };
    const auto n = static_cast<Eigen::Index>(functions_);
    Matrix result(n, n);
    Matrix::StorageIndex* start = result.outerIndexPtr();
    for_each_coefficient([&](Eigen::Index, Eigen::Index column, double) { ++start[column + 1]; });
    std::partial_sum(start, start + n + 1, start);
    result.resizeNonZeros(start[n]);
    std::vector<Matrix::StorageIndex> next(start, start + n);
    for_each_coefficient([&](Eigen::Index row, Eigen::Index column, double value) {
        const Matrix::StorageIndex at = next[static_cast<std::size_t>(column)]++;
        result.innerIndexPtr()[at] = static_cast<Matrix::StorageIndex>(row);
        result.valuePtr()[at] = value;
    });
    return result;
}

Eigen::ArrayXd Reflection::visibility(const Rgb& shares) const {
    Eigen::ArrayXd result = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(functions_));
    for (const OfElement& element : of_element_) {
        if (element.lobe < 0) continue;
        const BetweenAngles between = between_angles(element, shares);
        Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(element.angles);
        for (Eigen::Index a = 0; a < element.angles; ++a)
            for (Eigen::Index b = 0; b < element.angles; ++b)
                squares[b] += std::pow(between(a, b), 2);
        if (!(squares[0] > 0)) continue;
        const Eigen::ArrayXd relative = (squares / squares[0]).sqrt().min(1.0);
        for (Eigen::Index k = 0; k < element.cells; ++k)
            result.segment(element.first + k * element.angles, element.angles) = relative;
    }
    return result;
}

bool Reflection::are_alike(int channel, int other) const {
    return std::all_of(of_element_.begin(), of_element_.end(), [&](const OfElement& element) {
        return element.diffuse[channel] == element.diffuse[other] &&
               element.specular[channel] == element.specular[other];
    });
}

RadianceField bounced_light(const SymmetricOperator& propagation, const Reflection& reflection,
                            const RadianceField& direct, double tolerance) {
    // Plain iteration contracts by the albedo; more steps than this would serve no albedo below 1.
    constexpr int most_steps = 2000;
    RadianceField bounced = RadianceField::Zero(direct.rows(), 3);
    for (int step = 0; step < most_steps; ++step) {
        const RadianceField outgoing = reflection.outgoing(direct + bounced);
        RadianceField next = RadianceField::Zero(direct.rows(), 3);
        for (int c = 0; c < 3; ++c)
            propagation.apply(outgoing.col(c), next.col(c));
        const double change = (next - bounced).matrix().norm();
        bounced = std::move(next);
        if (change <= tolerance * bounced.matrix().norm()) break;
    }
    return bounced;
}

}  // namespace lightwell
