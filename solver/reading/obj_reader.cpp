#include "solver/reading/obj_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/text_scanner.h"

namespace lightwell {

namespace {

constexpr std::int64_t largest_obj = std::int64_t(1) << 30;

/// Statements that say nothing about where light goes.
constexpr std::array<std::string_view, 14> passed_over = {
    "vt", "vn", "vp", "vw", "g", "o", "s", "mg", "l", "p", "lod", "bevel", "c_interp", "d_interp"};

/// An index that named no vertex yet when it was read.
struct ForwardIndex {
    std::int64_t vertex;  ///< from 0
    Token token;
};

class ObjReader {
  public:
    ObjReader(std::string_view text, const std::string& path) : scanner_(text, path) {
        soup_.file = path;
    }

    PolygonSoup read() {
        while (scanner_.next_line())
            if (const auto keyword = scanner_.next()) statement(*keyword);
        check_forward_indices();
        unknown_.report(soup_.file, "statement " + in_quotes(first_unknown_) + " is passed over",
                        soup_.warnings);
        if (soup_.polygons.empty())
            throw InputError(Place{soup_.file}, "no polygons in the file (f statements)");
        return std::move(soup_);
    }

  private:
    void statement(const Token& keyword) {
        if (keyword.text == "v") {
            vertex();
        } else if (keyword.text == "f" || keyword.text == "fo") {
            face(keyword);
        } else if (keyword.text == "usemtl") {
            material_ = scanner_.rest();
        } else if (keyword.text == "mtllib") {
            const Token name = scanner_.rest();
            soup_.material_libraries.push_back({std::string(name.text), scanner_.place(name)});
        } else if (std::find(passed_over.begin(), passed_over.end(), keyword.text) ==
                   passed_over.end()) {
            if (unknown_.count() == 0) first_unknown_ = keyword.text;
            unknown_.add(keyword.line, keyword.column);
        }
    }

    void vertex() {
        Vec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            const Token token = scanner_.expect("a coordinate of the vertex");
            position[axis] = scanner_.number(token);
            if (std::abs(position[axis]) > largest_coordinate)
                throw InputError(
                    scanner_.place(token),
                    fmt::format("coordinate {} is beyond {:g}", token.text, largest_coordinate));
        }
        soup_.vertices.push_back(position);
    }

    void face(const Token& keyword) {
        Polygon polygon;
        polygon.first = static_cast<int>(soup_.corners.size());
        polygon.line = keyword.line;
        polygon.material = current_material();
        while (const auto token = scanner_.next())
            soup_.corners.push_back(corner(*token));
        polygon.count = static_cast<int>(soup_.corners.size()) - polygon.first;
        soup_.polygons.push_back(polygon);
    }

    /// The vertex that "7", "7/1", "7//3" or "7/1/3" names, from 0.
    int corner(const Token& token) {
        const std::size_t slash = token.text.find('/');
        const std::string_view digits = token.text.substr(0, slash);
        if (slash != std::string_view::npos) check_attributes(token, slash);
        const std::int64_t index = scanner_.whole_number({digits, token.line, token.column});
        const auto read_so_far = static_cast<std::int64_t>(soup_.vertices.size());
        if (index == 0)
            throw InputError(scanner_.place(token), "vertex index 0: indices count from 1");
        if (index < -read_so_far || index > std::int64_t(1) << 30)
            throw InputError(scanner_.place(token), out_of_range(token));
        const std::int64_t vertex = index > 0 ? index - 1 : read_so_far + index;
        if (vertex >= read_so_far) forward_.push_back({vertex, token});
        return static_cast<int>(vertex);
    }

    /// Texture and normal indices are not used, but must look like indices, so that damage shows.
    void check_attributes(const Token& token, std::size_t slash) const {
        const std::string_view rest = token.text.substr(slash);
        const bool clean = rest.find_first_not_of("/+-0123456789") == std::string_view::npos;
        if (!clean || std::count(rest.begin(), rest.end(), '/') > 2)
            throw InputError(scanner_.place(token), in_quotes(std::string(token.text)) +
                                                        " is not a corner: v, v/vt, v//vn or "
                                                        "v/vt/vn is expected");
    }

    std::string out_of_range(const Token& token) const {
        return fmt::format("vertex index {} is out of range: the file has {} vertices{}",
                           in_quotes(std::string(token.text)), soup_.vertices.size(),
                           token.text[0] == '-' ? " up to here" : "");
    }

    void check_forward_indices() const {
        for (const ForwardIndex& forward : forward_)
            if (forward.vertex >= static_cast<std::int64_t>(soup_.vertices.size()))
                throw InputError(scanner_.place(forward.token), out_of_range(forward.token));
    }

    /// The material's number; one that no polygon uses gets none.
    int current_material() {
        if (material_.text.empty()) return -1;
        const std::string name(material_.text);
        const auto [entry, is_new] =
            material_index_.try_emplace(name, static_cast<int>(soup_.materials.size()));
        if (is_new) soup_.materials.push_back({name, scanner_.place(material_)});
        return entry->second;
    }

    TextScanner scanner_;
    PolygonSoup soup_;
    Token material_;  ///< its text is empty: none
    std::map<std::string, int> material_index_;
    std::vector<ForwardIndex> forward_;
    Occurrences unknown_;
    std::string first_unknown_;
};

}  // namespace

PolygonSoup read_obj(const std::string& path) {
    const std::string text = read_text(path, largest_obj);
    return ObjReader(text, path).read();
}

}  // namespace lightwell
