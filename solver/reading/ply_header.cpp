#include "solver/reading/ply_header.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/text_scanner.h"

namespace lightwell {

namespace {

constexpr std::size_t most_elements = 256;
constexpr std::size_t most_properties = 1024;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> type_names = {{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

constexpr std::array<std::pair<std::string_view, PlyFormat>, 3> format_names = {{
    {"ascii", PlyFormat::ascii},
    {"binary_little_endian", PlyFormat::binary_little_endian},
    {"binary_big_endian", PlyFormat::binary_big_endian},
}};

/// The entry of a table of names. @throws InputError naming the token as no such `what`
template <typename Value, std::size_t n>
Value named(const std::array<std::pair<std::string_view, Value>, n>& table,
            const TextScanner& scanner, const Token& token, const char* what) {
    for (const auto& [name, value] : table)
        if (name == token.text) return value;
    throw InputError(scanner.place(token),
                     fmt::format("{} is no {}", in_quotes(std::string(token.text)), what));
}

class HeaderReader {
  public:
    HeaderReader(std::string_view bytes, const std::string& file)
        : bytes_(bytes), scanner_(bytes, file) {}

    PlyHeader read() {
        if (!scanner_.next_line() || scanner_.rest().text != "ply")
            throw InputError(Place{scanner_.file(), 1, 1},
                             "not a PLY file: it must start with ply");
        bool has_format = false;
        while (scanner_.next_line()) {
            const auto keyword = scanner_.next();
            if (!keyword) continue;
            if (keyword->text == "comment" || keyword->text == "obj_info") continue;
            if (keyword->text == "end_header") return finished(*keyword, has_format);
            if (keyword->text == "format") {
                read_format();
                has_format = true;
            } else if (keyword->text == "element") {
                read_element(*keyword);
            } else if (keyword->text == "property") {
                read_property(*keyword);
            } else {
                throw InputError(scanner_.place(*keyword), in_quotes(std::string(keyword->text)) +
                                                               " is no statement of a PLY header");
            }
        }
        throw InputError(scanner_.here(), "the PLY header does not end (end_header is missing)");
    }

  private:
    void read_format() {
        header_.format = named(format_names, scanner_, scanner_.expect("the format"),
                               "PLY format (ascii, binary_little_endian, binary_big_endian)");
        const Token version = scanner_.expect("the version, 1.0,");
        if (version.text != "1.0")
            throw InputError(scanner_.place(version), "PLY version must be 1.0, not " +
                                                          in_quotes(std::string(version.text)));
    }

    void read_element(const Token& keyword) {
        PlyElement element;
        element.place = scanner_.place(keyword);
        element.name = std::string(scanner_.expect("the element's name").text);
        const Token count = scanner_.expect("the number of rows");
        element.count = scanner_.whole_number(count);
        if (element.count < 0)
            throw InputError(scanner_.place(count),
                             fmt::format("{} rows of {}", element.count, element.name));
        const bool twice =
            std::any_of(header_.elements.begin(), header_.elements.end(),
                        [&](const PlyElement& other) { return other.name == element.name; });
        if (twice || header_.elements.size() == most_elements)
            throw InputError(element.place, twice ? "a second element " + in_quotes(element.name)
                                                  : std::string("too many elements"));
        header_.elements.push_back(std::move(element));
    }

    void read_property(const Token& keyword) {
        if (header_.elements.empty())
            throw InputError(scanner_.place(keyword), "property before the first element");
        auto& properties = header_.elements.back().properties;
        if (properties.size() == most_properties)
            throw InputError(scanner_.place(keyword), "too many properties");
        PlyProperty property;
        Token type = scanner_.expect("the property's type");
        if (type.text == "list") {
            property.is_list = true;
            const Token length_type = scanner_.expect("the type of the list's length");
            property.length_type = named(type_names, scanner_, length_type, "PLY type");
            if (!is_whole(property.length_type))
                throw InputError(scanner_.place(length_type),
                                 "the length of a list must be a whole number");
            type = scanner_.expect("the type of the list's entries");
        }
        property.type = named(type_names, scanner_, type, "PLY type");
        property.name = std::string(scanner_.expect("the property's name").text);
        properties.push_back(std::move(property));
    }

    PlyHeader finished(const Token& keyword, bool has_format) {
        if (!has_format)
            throw InputError(scanner_.place(keyword), "the PLY header has no format statement");
        // Binary numbers start right after the line's end, and the first one may itself begin with
        // the byte of a line feed: CR LF is one line's end unless the first line ends in CR alone.
        const auto end =
            static_cast<std::size_t>(keyword.text.data() - bytes_.data()) + keyword.text.size();
        const std::size_t line_end = bytes_.find_first_of("\r\n", end);
        const std::size_t first_end = bytes_.find_first_of("\r\n");
        const bool lone_cr = bytes_[first_end] == '\r' && bytes_.substr(first_end, 2) != "\r\n";
        const bool two =
            line_end != std::string_view::npos && bytes_.substr(line_end, 2) == "\r\n" && !lone_cr;
        header_.body = line_end == std::string_view::npos
                           ? bytes_.size()
                           : std::min(bytes_.size(), line_end + (two ? 2 : 1));
        header_.body_line = keyword.line + 1;
        check_sizes();
        return std::move(header_);
    }

    void check_sizes() const {
        std::size_t left = bytes_.size() - header_.body;
        // The last number of a text needs no blank after it.
        if (header_.format == PlyFormat::ascii) ++left;
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0) continue;
            if (element.properties.empty())
                throw InputError(element.place, "element " + in_quotes(element.name) +
                                                    " has rows but no properties");
            const std::size_t row = smallest_row(element);
            if (static_cast<std::size_t>(element.count) > left / row)
                throw InputError(
                    element.place,
                    fmt::format("{} rows of {} cannot be in a file of {} bytes", element.count,
                                in_quotes(element.name), bytes_.size()));
            left -= static_cast<std::size_t>(element.count) * row;
        }
    }

    /// Fewest bytes a row can have: empty lists, and in a text one digit and a blank a number.
    std::size_t smallest_row(const PlyElement& element) const {
        std::size_t row = 0;
        for (const PlyProperty& property : element.properties)
            row += header_.format == PlyFormat::ascii
                       ? 2
                       : size_of(property.is_list ? property.length_type : property.type);
        return row;
    }

    std::string_view bytes_;
    TextScanner scanner_;
    PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::float64:
            return 8;
        default:
            return 4;
    }
}

bool is_whole(PlyType type) {
    return type != PlyType::float32 && type != PlyType::float64;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& file) {
    return HeaderReader(bytes, file).read();
}

}  // namespace lightwell
