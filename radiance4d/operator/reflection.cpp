#include "radiance4d/operator/reflection.h"

#include <map>
#include <utility>

#include "radiance4d/failure.h"
#include "radiance4d/scene/brdf.h"

namespace lightwell {

Reflection::Reflection(const Scene& scene, const RadianceSpace& space) : space_(space) {
    const std::vector<Rgb> means = mean_albedos(scene.materials);
    std::map<std::pair<std::size_t, int>, int> known;  // material and level -> lobe
    for (const Element& element : space.elements()) {
        const std::size_t material = scene.material_number(element.quad);
        OfElement made;
        if (element.angle.functions() == 1) {
            made.diffuse = means[material];
        } else {
            const Material& what = scene.materials[material];
            const int level = element.angle.levels();
            const auto [entry, is_new] =
                known.try_emplace({material, level}, static_cast<int>(lobes_.size()));
            if (is_new) lobes_.push_back(AngularReflection::at_level(what.lobe, level));
            made = {what.reflectance, lobe_reflectance(what.lobe), entry->second};
        }
        of_element_.push_back(made);
    }
}

RadianceField Reflection::outgoing(const RadianceField& incident) const {
    LIGHTWELL_CHECK_OP(incident.rows(), ==, static_cast<Eigen::Index>(space_.functions()));
    RadianceField result(incident.rows(), 3);
    for (std::size_t e = 0; e < of_element_.size(); ++e) {
        const Element& element = space_.element(e);
        const OfElement& what = of_element_[e];
        const auto first = static_cast<Eigen::Index>(element.first);
        const auto count = static_cast<Eigen::Index>(element.functions());
        if (what.lobe < 0) {
            result.middleRows(first, count) =
                incident.middleRows(first, count).rowwise() * what.diffuse.transpose();
            continue;
        }
        const RowMatrix& lobe = lobes_[static_cast<std::size_t>(what.lobe)].matrix();
        const auto angles = static_cast<Eigen::Index>(element.angle.functions());
        for (int c = 0; c < 3; ++c) {
            // One row per spatial function, one column per angular one.
            const Eigen::Map<const RowMatrix> in(incident.col(c).data() + first, count / angles,
                                                 angles);
            Eigen::Map<RowMatrix> out(result.col(c).data() + first, count / angles, angles);
            out.noalias() = what.specular[c] * (in * lobe);
            out.col(0) += what.diffuse[c] * in.col(0);
        }
    }
    return result;
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
