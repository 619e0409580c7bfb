#include "tests/fuzz/parsers.h"

#include <algorithm>
#include <fstream>

#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "solver/reading/mtl_reader.h"
#include "solver/reading/obj_reader.h"
#include "solver/reading/path_reader.h"
#include "solver/reading/ply_reader.h"
#include "solver/reading/scene_reader.h"
#include "solver/reading/sensor_reader.h"

namespace lightwell::fuzz {

const std::vector<Parser>& parsers() {
    static const std::vector<Parser> all = {
        // Through the scene, so that what was read is made into quads, too.
        {"obj", "fuzzed.obj", [](const std::string& path) { read_scene(path); }},
        {"ply", "fuzzed.ply", [](const std::string& path) { read_scene(path); }},
        {"mtl", "fuzzed.mtl",
         [](const std::string& path) {
             std::vector<Warning> warnings;
             read_mtl(path, warnings);
         }},
        {"scene", "fuzzed.toml", [](const std::string& path) { read_scene(path); }},
        {"lights", "fuzzed.toml", [](const std::string& path) { read_lights(path); }},
        {"camera", "fuzzed.toml", [](const std::string& path) { read_camera(path); }},
        {"path", "fuzzed.toml", [](const std::string& path) { read_path(path); }},
        {"sensors", "fuzzed.csv", [](const std::string& path) { read_sensors_csv(path); }},
        {"operator", "fuzzed.gto",
         [](const std::string& path) {
             inspect_operator_file(path);
             read_operator_file(path);
         }},
    };
    return all;
}

const Parser* parser_named(const std::string& name) {
    const auto found = std::find_if(parsers().begin(), parsers().end(),
                                    [&](const Parser& parser) { return name == parser.name; });
    return found == parsers().end() ? nullptr : &*found;
}

void read_bytes_as(const Parser& parser, const std::string& folder, const std::string& bytes) {
    const std::string path = folder + "/" + parser.file;
    std::ofstream(path, std::ios::binary) << bytes;
    try {
        parser.read(path);
    } catch (const InputError&) {
    }
}

}  // namespace lightwell::fuzz
