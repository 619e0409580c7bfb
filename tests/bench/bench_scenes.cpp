#include "tests/bench/bench_scenes.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "radiance4d/operator/operator_file.h"
#include "radiance4d/scene/scene_quads.h"
#include "solver/precompute.h"
#include "solver/reading/scene_reader.h"

namespace lightwell {

namespace {

struct Made {
    BenchScene scene;
    double seconds = 0;
};

Made made(const std::string& name) {
    using Clock = std::chrono::steady_clock;
    GlobalTransport transport;
    double seconds = 0;
    const char* folder = std::getenv("LIGHTWELL_BENCH_OPERATORS");
    const std::string file = std::string(folder ? folder : "") + "/" + name + ".gto";
    if (folder && std::filesystem::exists(file)) {
        transport = read_operator_file(file);
    } else {
        PrecomputeReport report;
        const Clock::time_point start = Clock::now();
        transport = precompute(read_scene(LIGHTWELL_SCENES "/" + name + "/scene.toml").scene, {},
                               {}, report);
        seconds = std::chrono::duration<double>(Clock::now() - start).count();
    }
    std::vector<Quad> quads = quads_of(transport.scene);
    OccluderTree occluders(quads);
    return {{std::move(transport), std::move(quads), std::move(occluders)}, seconds};
}

const Made& kept(const std::string& name) {
    static std::map<std::string, Made> all;
    const auto found = all.find(name);
    return found != all.end() ? found->second : all.emplace(name, made(name)).first->second;
}

}  // namespace

std::vector<Light> BenchScene::lamp(const Vec3& by) const {
    Light light = transport.scene.lights.at(0);
    std::visit([&](auto& any) { any.position += by; }, light);
    return {light};
}

const BenchScene& bench_scene(const std::string& name) {
    return kept(name).scene;
}

double precompute_seconds(const std::string& name) {
    return kept(name).seconds;
}

}  // namespace lightwell
