#pragma once

#include <string>

#include "radiance4d/operator/byte_stream.h"
#include "radiance4d/scene/dimmed_light.h"
#include "radiance4d/scene/scene.h"

namespace lightwell {

/// Content of chunk SCEN: materials and quads. Canonical: equal scenes give equal bytes.
std::string surfaces_bytes(const Scene& scene);
/// Content of chunk LOBE: what is glossy about the materials; empty where nothing is.
std::string lobes_bytes(const Scene& scene);
/// Content of chunk LITE: names, lights, camera and sensor grids.
std::string surroundings_bytes(const Scene& scene);
/// Content of chunk dimm: how the lights of the scene are dimmed; empty where none is dimmed or
/// off.
std::string dimmers_bytes(const std::vector<DimmedLight>& lights);

/// Fills in what the chunk holds and checks it. @throws InputError
void read_surfaces(ByteReader& reader, Scene& scene);
/// Reads chunk LOBE after read_surfaces.
void read_lobes(ByteReader& reader, Scene& scene);
void read_surroundings(ByteReader& reader, Scene& scene);
/// The lights of a scene, after read_surroundings, before they are dimmed.
std::vector<DimmedLight> read_dimmers(ByteReader& reader, const Scene& scene);

}  // namespace lightwell
