#include "radiance4d/operator/reflection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

Reflection::Reflection(const Scene& scene, const RadianceSpace& space)
    : functions_(space.functions()) {
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
                lobes_.push_back(AngularReflection::at_level(what.lobe, level));
                entries_.push_back(entries_of(lobes_.back().matrix()));
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
        const RowMatrix& lobe = lobes_[static_cast<std::size_t>(element.lobe)].matrix();
        for (int c = 0; c < 3; ++c) {
            // One row per spatial function, one column per angular one.
            const Eigen::Map<const RowMatrix> in(incident.col(c).data() + element.first,
                                                 element.cells, element.angles);
            Eigen::Map<RowMatrix> out(result.col(c).data() + element.first, element.cells,
                                      element.angles);
            out.noalias() = element.specular[c] * (in * lobe);
            out.col(0) += element.diffuse[c] * in.col(0);
        }
    }
    return result;
}

Reflection::Entries Reflection::entries_of(const RowMatrix& lobe) {
    constexpr double left_out = 1e-5;
    std::vector<double> squares(lobe.data(), lobe.data() + lobe.size());
    for (double& one : squares)
        one *= one;
    std::sort(squares.begin(), squares.end());
    double budget = left_out * left_out * lobe.squaredNorm(), least = 0;
    for (const double square : squares) {
        budget -= square;
        if (budget < 0) break;
        least = square;
    }
    Entries entries(static_cast<std::size_t>(lobe.cols()));
    for (Eigen::Index from = 0; from < lobe.cols(); ++from)
        for (Eigen::Index to = 0; to < lobe.rows(); ++to)
            if (lobe(from, to) * lobe(from, to) > least)
                entries[static_cast<std::size_t>(from)].push_back({to, lobe(from, to)});
    return entries;
}

RowMatrix Reflection::between_angles(const OfElement& element, const Rgb& shares) const {
    RowMatrix result = RowMatrix::Zero(element.angles, element.angles);
    if (element.lobe < 0)
        result.diagonal().setConstant((shares * element.diffuse).sum());
    else
        result = (shares * element.specular).sum() *
                 lobes_[static_cast<std::size_t>(element.lobe)].matrix();
    if (element.lobe >= 0) result(0, 0) += (shares * element.diffuse).sum();
    return result;
}

void Reflection::reflect(const Rgb& shares, Eigen::Ref<const Fields> incident,
                         Eigen::Ref<Fields> outgoing) const {
    LIGHTWELL_CHECK_OP(incident.rows(), ==, static_cast<Eigen::Index>(functions_));
    const Eigen::Index lanes = incident.cols();
    for (const OfElement& element : of_element_) {
        const Eigen::Index count = element.cells * element.angles;
        if (element.lobe < 0) {
            outgoing.middleRows(element.first, count) =
                (shares * element.diffuse).sum() * incident.middleRows(element.first, count);
            continue;
        }
        const Entries& entries = entries_[static_cast<std::size_t>(element.lobe)];
        const double specular = (shares * element.specular).sum();
        outgoing.middleRows(element.first, count).setZero();
        for (Eigen::Index j = 0; j < count; ++j) {
            // Most functions of fine directions hold no light.
            const double* in = incident.row(element.first + j).data();
            if (std::all_of(in, in + lanes, [](double one) { return one == 0; })) continue;
            const Eigen::Index first = element.first + j - j % element.angles;
            for (const Entry& entry : entries[static_cast<std::size_t>(j % element.angles)]) {
                double* out = outgoing.row(first + entry.to).data();
                for (Eigen::Index lane = 0; lane < lanes; ++lane)
                    out[lane] += specular * entry.value * in[lane];
            }
        }
        for (Eigen::Index j = element.first; j < element.first + count; j += element.angles)
            outgoing.row(j) += (shares * element.diffuse).sum() * incident.row(j);
    }
}

Eigen::SparseMatrix<double> Reflection::matrix(const Rgb& shares, double smallest) const {
    const auto n = static_cast<Eigen::Index>(functions_);
    Eigen::SparseMatrix<double> result(n, n);
    Eigen::Index entries = 0;
    for (const OfElement& element : of_element_)
        entries +=
            element.cells * (between_angles(element, shares).array().abs() > smallest).count();
    result.reserve(entries);
    // Elements, their cells and the functions of these follow each other, and so do the columns.
    for (const OfElement& element : of_element_) {
        const RowMatrix angles = between_angles(element, shares);
        for (Eigen::Index j = 0; j < element.cells * element.angles; ++j) {
            const Eigen::Index b = j % element.angles, column = element.first + j;
            result.startVec(column);
            for (Eigen::Index a = 0; a < element.angles; ++a)
                if (std::abs(angles(a, b)) > smallest)
                    result.insertBack(column - b + a, column) = angles(a, b);
        }
    }
    result.finalize();
    return result;
}

Eigen::ArrayXd Reflection::visibility(const Rgb& shares) const {
    Eigen::ArrayXd result = Eigen::ArrayXd::Ones(static_cast<Eigen::Index>(functions_));
    for (const OfElement& element : of_element_) {
        if (element.lobe < 0) continue;
        const Eigen::ArrayXd norm =
            between_angles(element, shares).colwise().norm().transpose().array();
        if (!(norm[0] > 0)) continue;
        for (Eigen::Index k = 0; k < element.cells; ++k)
            result.segment(element.first + k * element.angles, element.angles) =
                (norm / norm[0]).min(1.0);
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
