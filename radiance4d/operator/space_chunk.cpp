#include "radiance4d/operator/space_chunk.h"

#include <utility>

#include "radiance4d/operator/file_flaws.h"

namespace lightwell {

namespace {

constexpr std::size_t least_element_bytes = 4 + 4;

void write(ByteWriter& writer, const std::vector<Split>& splits) {
    for (const Split split : splits)
        writer.number(static_cast<std::uint8_t>(split));
}

std::vector<Split> read_splits(ByteReader& reader, int levels) {
    std::vector<Split> splits;
    for (int level = 0; level < levels; ++level)
        splits.push_back(static_cast<Split>(reader.choice(3)));
    return splits;
}

void write(ByteWriter& writer, const std::vector<OpenMask>& open) {
    writer.number(static_cast<std::uint8_t>(!open.empty()));
    for (const OpenMask mask : open)
        writer.number(mask);
}

std::vector<OpenMask> read_open(ByteReader& reader, std::uint64_t cells) {
    if (reader.choice(2) == 0) return {};
    if (cells > reader.left() / sizeof(OpenMask)) reader.fail("masks of cells are missing");
    std::vector<OpenMask> open(cells);
    for (OpenMask& mask : open)
        mask = reader.number<OpenMask>();
    return open;
}

}  // namespace

std::uint64_t functions_of(const std::vector<Split>& splits) {
    std::uint64_t functions = 1;
    for (const Split split : splits)
        if (functions < (std::uint64_t{1} << 30)) functions *= split == Split::both ? 4 : 2;
    return functions;
}

std::vector<ElementShape> shapes_of(const RadianceSpace& space) {
    std::vector<ElementShape> shapes;
    for (const Element& element : space.elements())
        shapes.push_back({element.quad, element.front, element.space.tree().splits(),
                          element.angle.splits(), element.open});
    return shapes;
}

std::string space_bytes(const std::vector<ElementShape>& shapes) {
    ByteWriter writer;
    writer.count(shapes.size());
    for (const ElementShape& shape : shapes) {
        writer.count(static_cast<std::size_t>(shape.quad));
        writer.number(static_cast<std::uint8_t>(shape.front ? 0 : 1));
        writer.number(static_cast<std::uint8_t>(shape.space.size()));
        writer.number(static_cast<std::uint8_t>(shape.angle.size()));
        write(writer, shape.space);
        write(writer, shape.angle);
        write(writer, shape.open);
    }
    return writer.bytes();
}

std::vector<ElementShape> read_space(ByteReader& reader, const Scene& scene) {
    std::vector<ElementShape> shapes(reader.count(least_element_bytes));
    for (ElementShape& shape : shapes) {
        shape.quad = reader.index();
        shape.front = reader.choice(2) == 0;
        const int space_levels = reader.choice(most_levels + 1);
        const int angle_levels = reader.choice(most_levels + 1);
        shape.space = read_splits(reader, space_levels);
        shape.angle = read_splits(reader, angle_levels);
        shape.open = read_open(reader, functions_of(shape.space));
    }
    reader.finish();
    reader.require_no(flaw_of_space(shapes, scene));
    return shapes;
}

std::uint64_t functions_of(const std::vector<ElementShape>& shapes) {
    // No overflow: less than 2^32 elements of the scene at 2^28 functions each.
    std::uint64_t functions = 0;
    for (const ElementShape& shape : shapes)
        functions += functions_of(shape.space) * functions_of(shape.angle);
    return functions;
}

Quad geometry_of(const ElementShape& shape, const Scene& scene) {
    const Quad& quad = scene.quads[static_cast<std::size_t>(shape.quad)].quad;
    return shape.front ? quad : quad.reversed();
}

RadianceSpace space_from(const std::vector<ElementShape>& shapes, const Scene& scene) {
    std::vector<Element> elements;
    elements.reserve(shapes.size());
    for (const ElementShape& shape : shapes) {
        Element element;
        element.quad = shape.quad;
        element.front = shape.front;
        element.geometry = geometry_of(shape, scene);
        element.set_space(CellTree(shape.space), shape.open);
        element.angle = CellTree(shape.angle);
        elements.push_back(std::move(element));
    }
    return RadianceSpace(std::move(elements));
}

}  // namespace lightwell
