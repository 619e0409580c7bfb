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
constexpr std::array<std::string_view, 6> names = {"x", "y", "z", "nx", "ny", "nz"};

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

bool is_header(const std::vector<Field>& fields) {
    if (fields.size() != names.size()) return false;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (fields[i].text != names[i]) return false;
    return true;
}

Sensor sensor_from(const std::vector<Field>& fields, const std::string& file, int line) {
    std::array<double, 6> value{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Place place{file, line, i < fields.size() ? fields[i].column : 0};
        if (i >= fields.size() || fields[i].text.empty())
            throw InputError(place,
                             fmt::format("{} is missing; a row is x,y,z,nx,ny,nz", names[i]));
        value[i] = number_from(fields[i].text, place);
        if (i < 3 && std::abs(value[i]) > largest_coordinate)
            throw InputError(place,
                             fmt::format("{} is beyond {:g} metres", names[i], largest_coordinate));
    }
    if (fields.size() > names.size())
        throw InputError(
            Place{file, line, fields[names.size()].column},
            fmt::format("{} numbers in the row; a row is x,y,z,nx,ny,nz", fields.size()));
    Sensor sensor;
    sensor.position = Vec3(value[0], value[1], value[2]);
    const Vec3 normal(value[3], value[4], value[5]);
    // Scaled by the largest component first: the square of a tiny or huge one is 0 or infinite.
    const double largest = normal.cwiseAbs().maxCoeff();
    if (!(largest > 0))
        throw InputError(Place{file, line, fields[3].column}, "the normal has no length");
    sensor.normal = (normal / largest).normalized();
    return sensor;
}

}  // namespace

std::vector<Sensor> read_sensors_csv(const std::string& path) {
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
        if (!(first_row && is_header(fields))) sensors.push_back(sensor_from(fields, path, line));
        first_row = false;
    }
    if (sensors.empty()) throw InputError(Place{path}, "no sensors in the file");
    return sensors;
}

}  // namespace lightwell
