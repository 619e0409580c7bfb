#include "radiance4d/scene/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <embree3/rtcore.h>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

/// Distance from a coplanar surface that a hit may be off by, in scenes of unit size: measured
/// at 2.6 units in the last place of a float, taken three times.
constexpr float rounding_reach = 8.0F * 5.9604645e-8F;

/// What a ray carries to the filter: the quads that its two ends lie on.
struct EndAwareContext {
    RTCIntersectContext base;
    unsigned first_quad;
    unsigned second_quad;
};

/// Rejects hits on the quads that the ray starts from and ends at.
void pass_over_ends(const RTCFilterFunctionNArguments* arguments) {
    const auto* context = reinterpret_cast<const EndAwareContext*>(arguments->context);
    for (unsigned lane = 0; lane < arguments->N; ++lane) {
        const unsigned met = RTCHitN_primID(arguments->hit, arguments->N, lane);
        if (met == context->first_quad || met == context->second_quad) arguments->valid[lane] = 0;
    }
}

unsigned index_or_none(int quad) {
    return quad < 0 ? RTC_INVALID_GEOMETRY_ID : static_cast<unsigned>(quad);
}

const char* why_no_device() {
    return rtcGetDeviceError(nullptr) == RTC_ERROR_UNSUPPORTED_CPU
               ? "this processor is not supported"
               : "cannot start, most likely for want of memory";
}

}  // namespace

struct Visibility::Tracer {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    Vec3 centre = Vec3::Zero();
    double scale = 1;  ///< world length times scale is Embree length
    int count = 0;
    std::vector<Vec3> normals;

    Vec3 inside(const Vec3& world) const { return (world - centre) * scale; }

    ~Tracer() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }

    void require(bool fine, const char* what) const {
        if (!fine) throw SystemError(std::string("ray tracing: ") + what);
    }

    /// Moves a point off its quad towards the side that `direction` leaves to.
    Vec3 lifted(const Vec3& point, int on, const Vec3& direction) const {
        if (on < 0) return point;
        const Vec3& n = normals[static_cast<std::size_t>(on)];
        return point + (n.dot(direction) < 0 ? -rounding_reach : rounding_reach) * n;
    }
};

Visibility::Visibility(const std::vector<Quad>& quads) : tracer_(std::make_unique<Tracer>()) {
    Tracer& tracer = *tracer_;
    tracer.count = static_cast<int>(quads.size());

    // Move the scene to the origin and to unit half-size: the error of a hit grows with the
    // coordinates.
    Eigen::AlignedBox3d box;
    for (const Quad& quad : quads)
        for (const Vec3& corner : quad.vertex)
            box.extend(corner);
    if (!quads.empty()) {
        tracer.centre = box.center();
        const double half_size = 0.5 * box.sizes().maxCoeff();
        if (half_size > 0) tracer.scale = 1 / half_size;
    }

    // One instruction set for all machines that have it, so that answers do not change from one to
    // the next.
    tracer.device = rtcNewDevice("isa=avx2");
    tracer.require(tracer.device != nullptr, why_no_device());
    tracer.scene = rtcNewScene(tracer.device);
    rtcSetSceneFlags(tracer.scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(tracer.scene, RTC_BUILD_QUALITY_MEDIUM);

    RTCGeometry geometry = rtcNewGeometry(tracer.device, RTC_GEOMETRY_TYPE_QUAD);
    if (!quads.empty()) {
        auto* corners = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), 4 * quads.size()));
        auto* indices = static_cast<unsigned*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4,
                                    4 * sizeof(unsigned), quads.size()));
        tracer.require(corners != nullptr && indices != nullptr, "out of memory");
        for (std::size_t q = 0; q < quads.size(); ++q) {
            tracer.normals.push_back(quads[q].normal());
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 corner = tracer.inside(quads[q].vertex[k]);
                for (int axis = 0; axis < 3; ++axis)
                    corners[3 * (4 * q + k) + static_cast<std::size_t>(axis)] =
                        static_cast<float>(corner[axis]);
                indices[4 * q + k] = static_cast<unsigned>(4 * q + k);
            }
        }
    }
    rtcSetGeometryOccludedFilterFunction(geometry, pass_over_ends);
    rtcSetGeometryIntersectFilterFunction(geometry, pass_over_ends);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(tracer.scene, geometry, 0);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(tracer.scene);
    tracer.require(rtcGetDeviceError(tracer.device) == RTC_ERROR_NONE, "cannot build the scene");
}

Visibility::~Visibility() = default;
Visibility::Visibility(Visibility&&) noexcept = default;
Visibility& Visibility::operator=(Visibility&&) noexcept = default;

int Visibility::quad_count() const {
    return tracer_->count;
}

bool Visibility::occluded(const Vec3& a, int on_a, const Vec3& b, int on_b) const {
    const Tracer& tracer = *tracer_;
    const Vec3 raw = b - a;
    const Vec3 from = tracer.lifted(tracer.inside(a), on_a, raw);
    const Vec3 to = tracer.lifted(tracer.inside(b), on_b, -raw);
    const Vec3 way = to - from;
    const double length = way.norm();
    if (!(length > 0)) return false;

    EndAwareContext context;
    rtcInitIntersectContext(&context.base);
    context.first_quad = index_or_none(on_a);
    context.second_quad = index_or_none(on_b);
    alignas(16) RTCRay ray;
    ray.org_x = static_cast<float>(from[0]);
    ray.org_y = static_cast<float>(from[1]);
    ray.org_z = static_cast<float>(from[2]);
    ray.dir_x = static_cast<float>(way[0]);
    ray.dir_y = static_cast<float>(way[1]);
    ray.dir_z = static_cast<float>(way[2]);
    // A hit exactly at either end is neither promised nor excluded: stay clear of both by the
    // rounding error.
    const auto margin = static_cast<float>(std::min(0.25, rounding_reach / length));
    ray.tnear = margin;
    ray.tfar = 1.0F - margin;
    ray.time = 0;
    ray.mask = ~0U;
    ray.id = 0;
    ray.flags = 0;
    rtcOccluded1(tracer.scene, &context.base, &ray);
    return ray.tfar < 0;
}

Hit Visibility::nearest(const Vec3& origin, int on_origin, const Vec3& direction) const {
    const Tracer& tracer = *tracer_;
    const Vec3 from = tracer.lifted(tracer.inside(origin), on_origin, direction);

    EndAwareContext context;
    rtcInitIntersectContext(&context.base);
    context.first_quad = index_or_none(on_origin);
    context.second_quad = RTC_INVALID_GEOMETRY_ID;
    alignas(16) RTCRayHit query;
    query.ray.org_x = static_cast<float>(from[0]);
    query.ray.org_y = static_cast<float>(from[1]);
    query.ray.org_z = static_cast<float>(from[2]);
    query.ray.dir_x = static_cast<float>(direction[0]);
    query.ray.dir_y = static_cast<float>(direction[1]);
    query.ray.dir_z = static_cast<float>(direction[2]);
    query.ray.tnear = on_origin < 0 ? 0 : rounding_reach;
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.time = 0;
    query.ray.mask = ~0U;
    query.ray.id = 0;
    query.ray.flags = 0;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tracer.scene, &context.base, &query);

    Hit hit;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
    hit.quad = static_cast<int>(query.hit.primID);
    hit.distance = static_cast<double>(query.ray.tfar) / tracer.scale;
    hit.front = tracer.normals[static_cast<std::size_t>(hit.quad)].dot(direction) < 0;
    return hit;
}

}  // namespace lightwell
