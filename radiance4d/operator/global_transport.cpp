#include "radiance4d/operator/global_transport.h"

#include <cmath>

#include "radiance4d/scene/brdf.h"

namespace lightwell {

namespace {

/// H E per channel.
RadianceField indirect_light(const GlobalTransport& transport, const RadianceField& direct) {
    RadianceField result = RadianceField::Zero(direct.rows(), 3);
    for (int c = 0; c < 3; ++c)
        transport.indirect[static_cast<std::size_t>(transport.channel[static_cast<std::size_t>(c)])]
            .apply(direct.col(c), result.col(c));
    return result;
}

}  // namespace

RadianceField reflectance_of(const Scene& scene, const RadianceSpace& space) {
    const std::vector<Rgb> means = mean_albedos(scene.materials);
    RadianceField rho(space.functions(), 3);
    for (const Element& element : space.elements())
        rho.middleRows(element.first, element.functions()).rowwise() =
            means[scene.material_number(element.quad)].transpose();
    return rho;
}

RadianceField emission_of(const Scene& scene, const RadianceSpace& space) {
    // Emission is constant on a side, so only the scaling function of the whole element carries it.
    RadianceField emission = RadianceField::Zero(space.functions(), 3);
    for (const Element& element : space.elements()) {
        const Material& material = scene.material_of(element.quad);
        if (element.front || material.emitting == Sides::both)
            emission.row(element.first) = std::sqrt(element.area()) * material.emission.transpose();
    }
    return emission;
}

RadianceField reflected(const GlobalTransport& transport, const RadianceField& x) {
    return has_angles(transport.space)
               ? transport.reflection.outgoing(x)
               : RadianceField(reflectance_of(transport.scene, transport.space) * x);
}

RadianceField propagated(const SymmetricOperator& bounce, const RadianceField& x) {
    RadianceField y = RadianceField::Zero(x.rows(), 3);
    for (int c = 0; c < 3; ++c)
        bounce.apply(x.col(c), y.col(c));
    return y;
}

RadianceField global_light(const GlobalTransport& transport, const RadianceField& direct) {
    return direct + indirect_light(transport, direct);
}

RadianceField gathered_light(const GlobalTransport& transport, const RadianceField& direct) {
    return propagated(transport.bounce, reflected(transport, global_light(transport, direct)));
}

RadianceField solved_light(const GlobalTransport& transport, const RadianceField& direct,
                           double tolerance) {
    const RadianceField rho = reflectance_of(transport.scene, transport.space);
    const bool directed = has_angles(transport.space);
    RadianceField x = global_light(transport, direct);
    // The correction contracts by the relative error of H, a few per cent; plain iteration, which a
    // damaged H falls back to, by the albedo.
    constexpr int most_steps = 2000;
    double previous = 0;
    bool corrects = true;
    for (int step = 0;; ++step) {
        const RadianceField bounced = propagated(
            transport.bounce, directed ? transport.reflection.outgoing(x) : RadianceField(rho * x));
        const RadianceField residual = direct + bounced - x;
        const double size = residual.matrix().norm();
        if (step == most_steps || size <= tolerance * x.matrix().norm()) return bounced;
        if (step > 0 && size > 0.9 * previous) corrects = false;
        previous = size;
        x += corrects ? global_light(transport, residual) : residual;
    }
}

}  // namespace lightwell
