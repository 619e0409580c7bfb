#include "solver/reading/ply_reader.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/ply_body.h"

namespace lightwell {

namespace {

constexpr std::int64_t largest_ply = std::int64_t(1) << 30;

/// Column of a property, or -1.
int find(const PlyElement& element, std::string_view name) {
    for (std::size_t i = 0; i < element.properties.size(); ++i)
        if (element.properties[i].name == name) return static_cast<int>(i);
    return -1;
}

class PlyReader {
  public:
    PlyReader(std::string_view bytes, const std::string& path)
        : header_(read_ply_header(bytes, path)), body_(ply_body(bytes, header_, path)) {
        soup_.file = path;
    }

    PolygonSoup read() {
        for (const PlyElement& element : header_.elements)
            if (element.name == "vertex") vertex_count_ = element.count;
        for (const PlyElement& element : header_.elements)
            read_element(element);
        if (soup_.polygons.empty())
            throw InputError(Place{soup_.file}, "no polygons in the file (element face)");
        if (!body_->at_end())
            soup_.warnings.push_back(
                {Place{soup_.file}, "what follows the last row is passed over"});
        return std::move(soup_);
    }

  private:
    void read_element(const PlyElement& element) {
        if (element.count == 0) return;
        if (element.name == "vertex") return read_vertices(element);
        if (element.name == "face") return read_faces(element);
        for (std::int64_t row = 0; row < element.count; ++row) {
            body_->begin_row(element, row);
            for (const PlyProperty& property : element.properties)
                skip(property);
            body_->end_row();
        }
    }

    void skip(const PlyProperty& property) {
        body_->skip(property.type, property.is_list ? body_->list_length(property) : 1);
    }

    void read_vertices(const PlyElement& element) {
        const std::array<int, 3> column = {find(element, "x"), find(element, "y"),
                                           find(element, "z")};
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (column[axis] < 0 ||
                element.properties[static_cast<std::size_t>(column[axis])].is_list)
                throw InputError(element.place,
                                 fmt::format("vertices have no property {}", "xyz"[axis]));
        soup_.vertices.reserve(static_cast<std::size_t>(element.count));
        for (std::int64_t row = 0; row < element.count; ++row) {
            body_->begin_row(element, row);
            Vec3 position = Vec3::Zero();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const auto axis = std::find(column.begin(), column.end(), static_cast<int>(i));
                if (axis == column.end())
                    skip(element.properties[i]);
                else
                    position[axis - column.begin()] = coordinate(element.properties[i].type);
            }
            body_->end_row();
            soup_.vertices.push_back(position);
        }
    }

    double coordinate(PlyType type) {
        const double value = body_->number(type);
        if (!std::isfinite(value)) body_->fail(fmt::format("coordinate {}", value));
        if (std::abs(value) > largest_coordinate)
            body_->fail(fmt::format("coordinate {} is beyond {:g}", value, largest_coordinate));
        return value;
    }

    void read_faces(const PlyElement& element) {
        const int column = std::max(find(element, "vertex_indices"), find(element, "vertex_index"));
        if (column < 0) throw InputError(element.place, "faces have no property vertex_indices");
        const PlyProperty& indices = element.properties[static_cast<std::size_t>(column)];
        if (!indices.is_list || !is_whole(indices.type))
            throw InputError(element.place, "vertex_indices must be a list of whole numbers");
        for (std::int64_t row = 0; row < element.count; ++row) {
            body_->begin_row(element, row);
            for (const PlyProperty& property : element.properties) {
                if (&property == &indices)
                    read_face(indices);
                else
                    skip(property);
            }
            body_->end_row();
        }
    }

    void read_face(const PlyProperty& indices) {
        Polygon polygon;
        polygon.first = static_cast<int>(soup_.corners.size());
        polygon.line = body_->line();
        const std::int64_t length = body_->list_length(indices);
        // Corners are read one by one, so a length that the file does not hold takes no memory.
        for (std::int64_t i = 0; i < length; ++i) {
            const std::int64_t index = body_->whole_number(indices.type);
            if (index < 0 || index >= vertex_count_)
                body_->fail(fmt::format("vertex index {} is out of range: the file has {} vertices",
                                        index, vertex_count_));
            soup_.corners.push_back(static_cast<int>(index));
        }
        polygon.count = static_cast<int>(length);
        soup_.polygons.push_back(polygon);
    }

    PlyHeader header_;
    std::unique_ptr<PlyBody> body_;
    PolygonSoup soup_;
    std::int64_t vertex_count_ = 0;
};

}  // namespace

PolygonSoup read_ply(const std::string& path) {
    const std::string bytes = read_bytes(path, largest_ply);
    return PlyReader(bytes, path).read();
}

}  // namespace lightwell
