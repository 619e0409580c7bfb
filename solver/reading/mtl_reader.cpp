#include "solver/reading/mtl_reader.h"

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/text_scanner.h"

namespace lightwell {

namespace {

constexpr std::int64_t largest_mtl = std::int64_t(64) << 20;

/// One number (grey) or three.
Rgb colour(TextScanner& scanner, const Token& keyword) {
    Rgb value = Rgb::Zero();
    int given = 0;
    while (const auto token = scanner.next()) {
        if (given == 3)
            throw InputError(scanner.place(*token),
                             fmt::format("{} has more than three numbers", keyword.text));
        value[given++] = scanner.number(*token);
    }
    if (given == 1) return Rgb::Constant(value[0]);
    if (given != 3)
        throw InputError(
            scanner.place(keyword),
            fmt::format("{} has {} numbers; one or three are needed", keyword.text, given));
    return value;
}

/// Whether any number on the rest of the line differs from `neutral`; never an error, because the
/// statement is not used.
bool says_something(TextScanner& scanner, double neutral) {
    bool differs = false;
    while (const auto token = scanner.next()) {
        try {
            differs = differs || scanner.number(*token) != neutral;
        } catch (const InputError&) {
            differs = true;
        }
    }
    return differs;
}

class MtlReader {
  public:
    MtlReader(std::string_view text, const std::string& path, std::vector<Warning>& warnings)
        : scanner_(text, path), warnings_(warnings) {}

    std::vector<MaterialDescription> read() {
        while (scanner_.next_line())
            if (const auto keyword = scanner_.next()) statement(*keyword);
        finish_current();
        const std::string& file = scanner_.file();
        textured_.report(file, "the texture (map_Kd) is not read: Kd alone counts", warnings_);
        transparent_.report(file, "transparency (d) is not read: the surface is taken as opaque",
                            warnings_);
        return std::move(materials_);
    }

  private:
    void statement(const Token& keyword) {
        if (keyword.text == "newmtl") {
            const Token name = scanner_.rest();
            if (name.text.empty())
                throw InputError(scanner_.place(keyword), "newmtl without a name");
            finish_current();
            materials_.emplace_back();
            materials_.back().name = std::string(name.text);
            materials_.back().place = scanner_.place(name);
        } else if (keyword.text == "Kd") {
            current(keyword).reflectance = checked_reflectance(keyword);
        } else if (keyword.text == "Ks") {
            current(keyword).specular = checked_reflectance(keyword);
        } else if (keyword.text == "Ns") {
            current(keyword).exponent = checked_exponent(keyword);
        } else if (keyword.text == "illum") {
            const std::string_view model = scanner_.rest().text;
            has_highlight_ = model != "0" && model != "1";
        } else if (keyword.text == "Ke") {
            current(keyword).emission = checked_emission(keyword);
        } else if (keyword.text == "d") {
            if (says_something(scanner_, 1)) transparent_.add(keyword.line, keyword.column);
        } else if (keyword.text == "map_Kd") {
            textured_.add(keyword.line, keyword.column);
        }
    }

    MaterialDescription& current(const Token& keyword) {
        if (materials_.empty())
            throw InputError(scanner_.place(keyword),
                             fmt::format("{} before the first newmtl", keyword.text));
        return materials_.back();
    }

    void finish_current() {
        if (!has_highlight_ && !materials_.empty()) materials_.back().specular.reset();
        has_highlight_ = true;
    }

    Rgb checked_reflectance(const Token& keyword) {
        const Rgb value = colour(scanner_, keyword);
        if ((value < 0).any() || (value > 1).any())
            throw InputError(scanner_.place(keyword),
                             fmt::format("reflectance {} {} {} {} is not within 0 and 1",
                                         keyword.text, value[0], value[1], value[2]));
        return value;
    }

    double checked_exponent(const Token& keyword) {
        const double value = scanner_.number(scanner_.expect("the exponent"));
        if (!(value >= 0 && value <= largest_exponent))
            throw InputError(
                scanner_.place(keyword),
                fmt::format("exponent Ns {} is not within 0 and {}", value, largest_exponent));
        return value;
    }

    Rgb checked_emission(const Token& keyword) {
        const Rgb value = colour(scanner_, keyword);
        if ((value < 0).any() || (value > brightest).any())
            throw InputError(scanner_.place(keyword),
                             fmt::format("emitted luminance Ke {} {} {} is negative or too large",
                                         value[0], value[1], value[2]));
        return value;
    }

    TextScanner scanner_;
    std::vector<Warning>& warnings_;
    std::vector<MaterialDescription> materials_;
    bool has_highlight_ = true;  ///< of the current material
    Occurrences textured_, transparent_;
};

}  // namespace

std::vector<MaterialDescription> read_mtl(const std::string& path, std::vector<Warning>& warnings) {
    const std::string text = read_text(path, largest_mtl);
    return MtlReader(text, path, warnings).read();
}

}  // namespace lightwell
