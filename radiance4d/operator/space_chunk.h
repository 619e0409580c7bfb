#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/basis/radiance_space.h"
#include "radiance4d/operator/byte_stream.h"

namespace lightwell {

/// What the file holds of an element; the rest follows from the scene.
struct ElementShape {
    int quad = 0;
    bool front = true;
    std::vector<Split> space;
    std::vector<Split> angle;
    std::vector<OpenMask> open;  ///< as Element::open
};

std::vector<ElementShape> shapes_of(const RadianceSpace& space);

/// Content of chunk SPAC.
std::string space_bytes(const std::vector<ElementShape>& shapes);
/// Reads the chunk and checks it against the scene. @throws InputError
std::vector<ElementShape> read_space(ByteReader& reader, const Scene& scene);

/// Finest cells of a tree, which are its functions; saturates far above what is allowed.
std::uint64_t functions_of(const std::vector<Split>& splits);
/// Basis functions of all elements together.
std::uint64_t functions_of(const std::vector<ElementShape>& shapes);
/// The quad as an element sees it.
Quad geometry_of(const ElementShape& shape, const Scene& scene);
/// Builds the space, bases and all.
RadianceSpace space_from(const std::vector<ElementShape>& shapes, const Scene& scene);

}  // namespace lightwell
