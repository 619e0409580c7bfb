#include "solver/reading/path_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "solver/reading/input_file.h"
#include "solver/reading/scene_tables.h"

namespace lightwell {

namespace {

constexpr int most_frames = 100'000;
constexpr double latest = 1e6;  ///< [s]

double time_from(const TomlTable& table) {
    const double time = table.number("time");
    if (!(time >= 0 && time <= latest))
        table.fail("time", fmt::format("time {} is not within 0 and {:g} seconds", time, latest));
    return time;
}

void require_later(const TomlTable& table, double time, double before) {
    if (!(time > before))
        table.fail("time", fmt::format("time {} is not after the key before, {}", time, before));
}

std::vector<LightKey>& keys_of(const std::string& name, Keyframes& keyframes) {
    for (std::vector<LightKey>& keys : keyframes.lights)
        if (name_of(keys.front().light) == name) return keys;
    return keyframes.lights.emplace_back();
}

void add_light(const TomlTable& table, Keyframes& keyframes) {
    const double time = time_from(table);
    const std::string name = table.text("name");
    const Light light = shining({light_from(table, name)})[0];
    std::vector<LightKey>& keys = keys_of(name, keyframes);
    if (!keys.empty()) {
        require_later(table, time, keys.back().time);
        if (keys.back().light.index() != light.index())
            table.fail("type", in_quotes(name) + " has another type in the key before");
    }
    keys.push_back({time, light});
}

}  // namespace

Keyframes read_path(const std::string& path, const Vec3& up) {
    const TomlTable file = TomlTable::read(path);
    Keyframes keyframes;
    if (file.has("frames_per_second")) {
        keyframes.frames_per_second = file.number("frames_per_second");
        if (!(keyframes.frames_per_second > 0 && keyframes.frames_per_second <= 1000))
            file.fail("frames_per_second",
                      fmt::format("frames_per_second {} is not above 0 and at most 1000",
                                  keyframes.frames_per_second));
    }
    if (file.has("camera"))
        for (const TomlTable& table : file.tables("camera")) {
            const double time = time_from(table);
            if (!keyframes.camera.empty()) require_later(table, time, keyframes.camera.back().time);
            keyframes.camera.push_back({time, camera_from(table, up)});
        }
    if (file.has("light"))
        for (const TomlTable& table : file.tables("light"))
            add_light(table, keyframes);
    file.refuse_unknown_keys();
    if (keyframes.camera.empty() && keyframes.lights.empty())
        throw InputError(Place{path}, "no [[camera]] and no [[light]] in the path");
    const double pictures = (keyframes.end() - keyframes.begin()) * keyframes.frames_per_second;
    if (!(pictures < most_frames))
        throw InputError(Place{path}, fmt::format("the path takes {:.0f} pictures; at most {} are "
                                                  "drawn",
                                                  pictures + 1, most_frames));
    return keyframes;
}

}  // namespace lightwell
