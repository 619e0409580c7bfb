#include "solver/reading/sensor_reader.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/number_text.h"
#include "solver/reading/polygon_soup.h"

namespace lightwell {

namespace {

constexpr std::int64_t largest_csv = std::int64_t(256) << 20;

/// What a file's rows hold.
struct RowKind {
    std::array<std::string_view, 6> names;
    std::string_view columns;    ///< the names in a row
    std::string_view direction;  ///< what the last three are
    std::string_view plural;     ///< what a file has
};
constexpr RowKind sensor_rows = {
    {"x", "y", "z", "nx", "ny", "nz"}, "x,y,z,nx,ny,nz", "normal", "sensors"};
constexpr RowKind probe_rows = {
    {"x", "y", "z", "dx", "dy", "dz"}, "x,y,z,dx,dy,dz", "direction", "probes"};

/// A field of a row without the blanks around it.
struct Field {
    std::string_view text;
    int column = 0;  ///< from 1
};

bool is_blank(char letter) {
    return letter == ' ' || letter == '\t';
}

std::vector<Field> fields_of(std::string_view line) {
    std::vector<Field> fields;
    for (std::size_t start = 0; start <= line.size();) {
        const std::size_t end = std::min(line.find(',', start), line.size());
        std::size_t first = start, last = end;
        while (first < last && is_blank(line[first]))
            ++first;
        while (last > first && is_blank(line[last - 1]))
            --last;
        fields.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
        start = end + 1;
    }
    return fields;
}

bool is_header(const std::vector<Field>& fields, const RowKind& kind) {
    if (fields.size() != kind.names.size()) return false;
    for (std::size_t i = 0; i < kind.names.size(); ++i)
        if (fields[i].text != kind.names[i]) return false;
    return true;
}

Sensor sensor_from(const std::vector<Field>& fields, const RowKind& kind, const std::string& file,
                   int line) {
    const auto& names = kind.names;
    std::array<double, 6> value{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Place place{file, line, i < fields.size() ? fields[i].column : 0};
        if (i >= fields.size() || fields[i].text.empty())
            throw InputError(place,
                             fmt::format("{} is missing; a row is {}", names[i], kind.columns));
        value[i] = number_from(fields[i].text, place);
        if (i < 3 && std::abs(value[i]) > largest_coordinate)
            throw InputError(place,
                             fmt::format("{} is beyond {:g} metres", names[i], largest_coordinate));
    }
    if (fields.size() > names.size())
        throw InputError(
            Place{file, line, fields[names.size()].column},
            fmt::format("{} numbers in the row; a row is {}", fields.size(), kind.columns));
    Sensor sensor;
    sensor.position = Vec3(value[0], value[1], value[2]);
    const Vec3 normal(value[3], value[4], value[5]);
    // Scaled by the largest component first: the square of a tiny or huge one is 0 or infinite.
    const double largest = normal.cwiseAbs().maxCoeff();
    if (!(largest > 0))
        throw InputError(Place{file, line, fields[3].column},
                         fmt::format("the {} has no length", kind.direction));
    sensor.normal = (normal / largest).normalized();
    return sensor;
}

std::vector<Sensor> rows_of(const std::string& path, const RowKind& kind) {
    const std::string text = read_text(path, largest_csv);
    std::vector<Sensor> sensors;
    bool first_row = true;
    int line = 0;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
        const std::string_view row = std::string_view(text).substr(start, end - start);
        start = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
        ++line;
        const std::vector<Field> fields = fields_of(row);
        const bool empty = fields.size() == 1 && fields[0].text.empty();
        if (empty || (!fields[0].text.empty() && fields[0].text[0] == '#')) continue;
        if (!(first_row && is_header(fields, kind)))
            sensors.push_back(sensor_from(fields, kind, path, line));
        first_row = false;
    }
    if (sensors.empty())
        throw InputError(Place{path}, fmt::format("no {} in the file", kind.plural));
    return sensors;
}

}  // namespace

std::vector<Sensor> read_sensors_csv(const std::string& path) {
    return rows_of(path, sensor_rows);
}

std::vector<LookingPoint> read_probes_csv(const std::string& path) {
    std::vector<LookingPoint> probes;
    for (const Sensor& row : rows_of(path, probe_rows))
        probes.push_back({row.position, row.normal});
    return probes;
}

}  // namespace lightwell
