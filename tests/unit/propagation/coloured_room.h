#pragma once

#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/occluder_tree.h"
#include "runtime/propagation/packed_field.h"

namespace lightwell::testing {

/// A closed room of 3 x 4 x 2.5 m with coloured walls and a block on its floor, precomputed once
/// per process.
struct ColouredRoom {
    GlobalTransport transport;
    std::vector<Quad> quads;
    OccluderTree occluders;

    /// E of a lamp of 100 cd, by the exact projector.
    PackedField lamp_at(const Vec3& position) const;
};

const ColouredRoom& coloured_room();

/// Places of a lamp, frame by frame.
using LightPath = std::vector<Vec3>;

/// Three paths through the coloured room, as a hand drags a lamp, about 1 cm a frame: a drift, a
/// turn round the block, and to and fro with stops.
std::vector<LightPath> light_paths(int frames);

inline LightPath light_path(std::size_t number, int frames) {
    return light_paths(frames)[number];
}

}  // namespace lightwell::testing
