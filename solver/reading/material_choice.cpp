#include "solver/reading/material_choice.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "radiance4d/scene/brdf.h"
#include "solver/reading/input_file.h"

namespace lightwell {

namespace {

using Descriptions = std::map<std::string, MaterialDescription>;

/// The names on an mtllib line: parted by blanks, where a backslash makes a blank part of a name.
std::vector<std::string> names_on(const std::string& line) {
    std::vector<std::string> names;
    std::string name;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool escaped = line[i] == '\\' && i + 1 < line.size() && line[i + 1] == ' ';
        if (escaped) {
            name += ' ';
            ++i;
        } else if (line[i] == ' ' || line[i] == '\t') {
            if (!name.empty()) names.push_back(name);
            name.clear();
        } else {
            name += line[i];
        }
    }
    if (!name.empty()) names.push_back(name);
    return names;
}

bool is_there(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

/// The MTL files of one mtllib line that exist. Exporters write names with blanks as they are, so
/// the whole line is tried as one name before it is taken as several.
std::vector<std::filesystem::path> existing_files(const NamedPlace& library,
                                                  std::vector<Warning>& warnings) {
    const std::filesystem::path folder = std::filesystem::path(library.place.file).parent_path();
    if (!library.name.empty() && is_there(folder / library.name)) return {folder / library.name};
    std::vector<std::filesystem::path> found;
    std::string missing;
    for (const std::string& name : names_on(library.name)) {
        if (is_there(folder / name))
            found.push_back(folder / name);
        else
            missing += (missing.empty() ? "" : ", ") + in_quotes(name);
    }
    if (found.empty()) missing = in_quotes(library.name);
    if (!missing.empty())
        warnings.push_back({library.place, "material file " + missing + " is not there"});
    return found;
}

/// @param files  takes the paths of those that were read
Descriptions read_libraries(const PolygonSoup& soup, std::vector<Warning>& warnings,
                            std::vector<std::string>& files) {
    Descriptions found;
    std::set<std::filesystem::path> read;
    for (const NamedPlace& library : soup.material_libraries)
        for (const auto& path : existing_files(library, warnings)) {
            if (!read.insert(path).second) continue;
            files.push_back(path.string());
            for (const MaterialDescription& next : read_mtl(path.string(), warnings))
                if (!found.emplace(next.name, next).second)
                    warnings.push_back({next.place, "material " + in_quotes(next.name) +
                                                        " is described twice: the first counts"});
        }
    return found;
}

/// Lets what `stronger` says replace what `weaker` says.
MaterialDescription merged(const MaterialDescription& stronger, MaterialDescription weaker) {
    weaker.name = stronger.name;
    weaker.place = stronger.place;
    if (stronger.reflectance) weaker.reflectance = stronger.reflectance;
    if (stronger.emission) weaker.emission = stronger.emission;
    if (stronger.specular) weaker.specular = stronger.specular;
    if (stronger.exponent || stronger.roughness) {
        weaker.exponent = stronger.exponent;
        weaker.roughness = stronger.roughness;
    }
    if (stronger.reflecting) weaker.reflecting = stronger.reflecting;
    if (stronger.emitting) weaker.emitting = stronger.emitting;
    return weaker;
}

class MaterialChooser {
  public:
    MaterialChooser(const PolygonSoup& soup, const std::vector<MaterialDescription>& own,
                    const std::string& default_name, AlbedoAboveOne above_one,
                    std::vector<Warning>& warnings)
        : soup_(soup), default_name_(default_name), above_one_(above_one), warnings_(warnings) {
        described_ = read_libraries(soup, warnings, choice_.files);
        for (const MaterialDescription& mine : own) {
            described_[mine.name] = merged(mine, described_[mine.name]);
            const bool used =
                mine.name == default_name ||
                std::any_of(soup.materials.begin(), soup.materials.end(),
                            [&](const NamedPlace& use) { return use.name == mine.name; });
            if (!used)
                warn(mine.place,
                     "material " + in_quotes(mine.name) + " is used by no polygon of " + soup.file);
        }
    }

    MaterialChoice choose() {
        std::vector<std::string> unknown;
        for (const NamedPlace& use : soup_.materials) {
            const bool known = described_.count(use.name) > 0;
            if (!known) unknown.push_back(use.name);
            choice_.of_soup.push_back(known ? index_of(use.name) : fallback());
        }
        warn_of_unknown(unknown);
        const auto bare = static_cast<int>(
            std::count_if(soup_.polygons.begin(), soup_.polygons.end(),
                          [](const Polygon& polygon) { return polygon.material < 0; }));
        if (bare > 0) {
            choice_.of_unnamed = fallback();
            if (default_name_.empty())
                warn(Place{soup_.file}, with_separators(bare) +
                                            (bare == 1 ? " face has" : " faces have") +
                                            " no material: 0.5 grey is taken");
        }
        return std::move(choice_);
    }

  private:
    int index_of(const std::string& name) {
        const auto [entry, is_new] =
            index_.try_emplace(name, static_cast<int>(choice_.materials.size()));
        if (is_new) choice_.materials.push_back(material(described_.at(name)));
        return entry->second;
    }

    Material material(const MaterialDescription& from) {
        Material made;
        made.name = from.name;
        if (from.reflectance)
            made.reflectance = *from.reflectance;
        else
            warn(from.place,
                 "material " + in_quotes(from.name) + " has no reflectance: 0.5 grey is taken");
        if (from.emission) made.emission = *from.emission;
        if (from.reflecting) made.reflecting = *from.reflecting;
        if (from.emitting) made.emitting = *from.emitting;
        made.lobe = lobe(from);
        return within_one(made, from.place);
    }

    Lobe lobe(const MaterialDescription& from) {
        if (!from.specular || !(*from.specular > 0).any()) return NoLobe{};
        if (from.roughness) return GgxLobe{*from.specular, *from.roughness};
        if (from.exponent) return PhongLobe{*from.specular, *from.exponent};
        warn(from.place, "material " + in_quotes(from.name) +
                             " has a specular reflectance, but no exponent and no roughness: it is "
                             "taken as diffuse");
        return NoLobe{};
    }

    /// The material, if it reflects no more than what arrives; see AlbedoAboveOne.
    Material within_one(const Material& material, const Place& place) {
        constexpr double rounding = 1e-6;
        const AlbedoPeak peak = albedo_peak(material);
        if (peak.albedo <= 1 + rounding) return material;
        constexpr std::array<const char*, 3> channels = {"red", "green", "blue"};
        const std::string finding = fmt::format(
            "material {} reflects more light than it receives: {:.4g} of the {} at {:.0f} degrees "
            "from the normal",
            in_quotes(material.name), peak.albedo, channels[static_cast<std::size_t>(peak.channel)],
            peak.angle);
        if (above_one_ == AlbedoAboveOne::refuse)
            throw InputError(place, finding + "; --scale-albedo takes the scene all the same");
        warn(place, fmt::format("{}; diffuse and specular reflectance are scaled by {:.4g}",
                                finding, 1 / peak.albedo));
        return scaled_to_albedo(material, 1);
    }

    /// The material of those that have none: 0.5 grey, or the one the scene names.
    int fallback() {
        if (!default_name_.empty()) return index_of(default_name_);
        if (grey_ < 0) {
            grey_ = static_cast<int>(choice_.materials.size());
            choice_.materials.emplace_back();
            choice_.materials.back().name = "0.5 grey";
        }
        return grey_;
    }

    void warn(const Place& place, const std::string& message) {
        warnings_.push_back({place, message});
    }

    void warn_of_unknown(const std::vector<std::string>& unknown) {
        constexpr std::size_t named = 8;
        if (unknown.empty()) return;
        std::string list;
        for (std::size_t i = 0; i < std::min(named, unknown.size()); ++i)
            list += (i > 0 ? ", " : "") + in_quotes(unknown[i]);
        if (unknown.size() > named) list += fmt::format(" and {} more", unknown.size() - named);
        const std::string instead =
            default_name_.empty() ? "0.5 grey" : "the default " + in_quotes(default_name_);
        warn(Place{soup_.file}, fmt::format("no description of material{} {}: {} is taken",
                                            unknown.size() > 1 ? "s" : "", list, instead));
    }

    const PolygonSoup& soup_;
    std::string default_name_;
    AlbedoAboveOne above_one_;
    std::vector<Warning>& warnings_;
    Descriptions described_;
    MaterialChoice choice_;
    std::map<std::string, int> index_;
    int grey_ = -1;
};

}  // namespace

MaterialChoice choose_materials(const PolygonSoup& soup,
                                const std::vector<MaterialDescription>& own,
                                const std::string& default_name, AlbedoAboveOne above_one,
                                std::vector<Warning>& warnings) {
    return MaterialChooser(soup, own, default_name, above_one, warnings).choose();
}

}  // namespace lightwell
