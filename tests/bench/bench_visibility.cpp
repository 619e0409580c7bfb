// How much of Embree's own speed is left to Visibility::occluded, on the same rays in the same run.
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include "radiance4d/scene/scene_quads.h"
#include "radiance4d/scene/visibility.h"
#include "solver/reading/scene_reader.h"
#include "tests/bench/counted_runs.h"

namespace lightwell {
namespace {

constexpr int ray_count = 1 << 15;

/// Two points, each on a quad.
struct Segment {
    Vec3 a, b;
    int on_a = 0, on_b = 0;
};

std::vector<Quad> quads_of(const std::string& scene) {
    const std::string folder = std::string(LIGHTWELL_SCENES) + "/" + scene;
    return quads_of(read_scene(folder + "/scene.toml").scene);
}

/// Segments between random points of quads that face each other: what transport asks about.
std::vector<Segment> facing_segments(const std::vector<Quad>& quads) {
    std::mt19937_64 random(1);
    std::uniform_int_distribution<int> any_quad(0, static_cast<int>(quads.size()) - 1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Segment> segments;
    while (segments.size() < ray_count) {
        Segment segment;
        segment.on_a = any_quad(random);
        segment.on_b = any_quad(random);
        const Quad& from = quads[static_cast<std::size_t>(segment.on_a)];
        const Quad& to = quads[static_cast<std::size_t>(segment.on_b)];
        segment.a = from.point(unit(random), unit(random));
        segment.b = to.point(unit(random), unit(random));
        const Vec3 way = segment.b - segment.a;
        if (from.normal().dot(way) > 1e-6 && to.normal().dot(way) < -1e-6)
            segments.push_back(segment);
    }
    return segments;
}

/// Embree and nothing else: one float ray a segment, made beforehand, robust mode, no filters.
class EmbreeAlone {
  public:
    EmbreeAlone(const std::vector<Quad>& quads, const std::vector<Segment>& segments)
        : device_(rtcNewDevice("isa=avx2")), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
        auto* corner = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), 4 * quads.size()));
        auto* index = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                    4 * sizeof(unsigned), quads.size()));
        unsigned next = 0;
        for (const Quad& quad : quads)
            for (const Vec3& vertex : quad.vertex) {
                for (int axis = 0; axis < 3; ++axis)
                    *corner++ = static_cast<float>(vertex[axis]);
                *index++ = next++;
            }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
        for (const Segment& segment : segments)
            rays_.push_back(ray_along(segment));
    }
    ~EmbreeAlone() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeAlone(const EmbreeAlone&) = delete;
    EmbreeAlone& operator=(const EmbreeAlone&) = delete;

    int occluded() const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        int count = 0;
        for (RTCRay ray : rays_) {
            rtcOccluded1(scene_, &context, &ray);
            count += ray.tfar < 0 ? 1 : 0;
        }
        return count;
    }

  private:
    static RTCRay ray_along(const Segment& segment) {
        const Eigen::Vector3f from = segment.a.cast<float>();
        const Eigen::Vector3f way = (segment.b - segment.a).cast<float>();
        RTCRay ray{};
        ray.org_x = from[0], ray.org_y = from[1], ray.org_z = from[2];
        ray.dir_x = way[0], ray.dir_y = way[1], ray.dir_z = way[2];
        ray.tnear = 1e-4F;
        ray.tfar = 1 - 1e-4F;
        ray.mask = ~0U;
        return ray;
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<RTCRay> rays_;
};

int occluded(const Visibility& visibility, const std::vector<Segment>& segments) {
    int count = 0;
    for (const Segment& s : segments)
        count += visibility.occluded(s.a, s.on_a, s.b, s.on_b) ? 1 : 0;
    return count;
}

/// Both ways in turn, so that whatever disturbs the machine disturbs both. Counters: rays per
/// second of processor time each way, `of_embree` (their ratio), and the share of rays that met
/// something each way.
void visibility_against_embree(benchmark::State& state, const std::string& scene) {
    const std::vector<Quad> quads = quads_of(scene);
    const std::vector<Segment> segments = facing_segments(quads);
    const Visibility visibility(quads);
    const EmbreeAlone embree(quads, segments);
    // Processor time: what others do on the machine is not in it.
    std::clock_t ours = 0, theirs = 0;
    int our_count = 0, their_count = 0;
    for (auto _ : state) {
        const std::clock_t start = std::clock();
        our_count = occluded(visibility, segments);
        const std::clock_t middle = std::clock();
        their_count = embree.occluded();
        const std::clock_t end = std::clock();
        ours += middle - start;
        theirs += end - middle;
    }
    const double rays = static_cast<double>(state.iterations()) * ray_count * CLOCKS_PER_SEC;
    state.counters["rays/s"] = rays / static_cast<double>(ours);
    state.counters["embree_rays/s"] = rays / static_cast<double>(theirs);
    state.counters["of_embree"] = static_cast<double>(theirs) / static_cast<double>(ours);
    state.counters["occluded"] = static_cast<double>(our_count) / ray_count;
    state.counters["embree_occluded"] = static_cast<double>(their_count) / ray_count;
}

BENCHMARK_CAPTURE(visibility_against_embree, cornell_box, std::string("cornell-box"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(visibility_against_embree, maze, std::string("maze"))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(visibility_against_embree, office, std::string("office"))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lightwell

int main(int argc, char** argv) {
    return lightwell::run_and_count(argc, argv);
}
