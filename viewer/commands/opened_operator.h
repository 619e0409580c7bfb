#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/visibility.h"

namespace lightwell {

/// What a .gto file holds, and the search structures over its quads.
struct OpenedOperator {
    GlobalTransport transport;
    std::vector<DimmedLight> lights;  ///< of its scene, before they are dimmed
    std::vector<Quad> quads;
    Visibility visibility;
    OccluderTree occluders;
};

/// Builds the search structures.
/// @param lights  of the transport's scene, before they are dimmed
OpenedOperator opened(GlobalTransport transport, std::vector<DimmedLight> lights);
/// The same, where no light is dimmed or off.
OpenedOperator opened(GlobalTransport transport);

/// @throws as read_operator_file
OpenedOperator open_operator(const std::string& path);

/// The lights of a lights file, or the scene's own where no file is given.
/// @throws as read_lights
std::vector<Light> chosen_lights(const std::optional<std::string>& path, const Scene& scene);

}  // namespace lightwell
