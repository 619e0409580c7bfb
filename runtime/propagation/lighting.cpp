#include "runtime/propagation/lighting.h"

#include <utility>

#include "radiance4d/operator/directed_light.h"
#include "radiance4d/operator/light_projection.h"

namespace lightwell {

Lighting light_scene(const GlobalTransport& transport, const std::vector<Light>& lights,
                     const std::vector<Quad>& quads, const OccluderTree& occluders,
                     Propagation propagation, LampDirections lamps) {
    Lighting lighting;
    RadianceField projected = projected_lights(transport.space, lights, quads, occluders);
    if (lamps == LampDirections::forgotten)
        projected = without_directions(transport.space, std::move(projected));
    lighting.direct =
        projected + propagated(transport.bounce, emission_of(transport.scene, transport.space));
    switch (propagation) {
        case Propagation::stored:
            lighting.indirect = global_light(transport, lighting.direct) - lighting.direct;
            break;
        case Propagation::gathered:
            lighting.indirect = gathered_light(transport, lighting.direct);
            break;
        case Propagation::solved:
            lighting.indirect = solved_light(transport, lighting.direct);
            break;
    }
    return lighting;
}

}  // namespace lightwell
