#include "runtime/drawing/surface_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lightwell {

namespace {

/// Room for the rounding of a few products in double, relative to their size.
constexpr double rounding = 1e-14;

/// A quad as a pencil of rays from one eye meets it.
class SeenQuad {
  public:
    SeenQuad(const Quad& quad, const Vec3& eye) : normal_(quad.normal()) {
        const Vec3 centre = quad.centre() - eye;
        offset_ = normal_.dot(centre);
        in_plane_ = !(std::abs(offset_) > rounding * (centre.norm() + eye.norm()));
        // The planes through the eye and an edge, with the quad on their positive side. Two quads
        // that share an edge get the same plane, exactly turned round: no ray passes between them.
        const double side = front() ? -1 : 1;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 a = quad.vertex[k] - eye, b = quad.vertex[(k + 1) % 4] - eye;
            edge_[k] = side * a.cross(b);
            slack_[k] = -rounding * a.norm() * b.norm();
        }
    }

    /// Whether the eye is in front of the quad.
    bool front() const { return offset_ < 0; }

    /// Distance along the ray from the eye to the quad's plane, if that lies ahead [m].
    std::optional<double> plane_distance(const Vec3& direction) const {
        if (in_plane_) return std::nullopt;
        const double distance = offset_ / normal_.dot(direction);
        if (!(distance > 0) || !std::isfinite(distance)) return std::nullopt;
        return distance;
    }

    /// The same if the ray meets the quad itself, its edges included.
    std::optional<double> distance(const Vec3& direction) const {
        for (std::size_t k = 0; k < 4; ++k)
            if (edge_[k].dot(direction) < slack_[k]) return std::nullopt;
        return plane_distance(direction);
    }

  private:
    Vec3 normal_;
    double offset_;  ///< of the plane from the eye along the normal [m]
    bool in_plane_;  ///< the eye lies in the quad's plane: nothing of it is seen
    std::array<Vec3, 4> edge_;
    std::array<double, 4> slack_;
};

/// The 3 x 3 pixels around one, without repetition and in rising order.
struct Neighbourhood {
    std::array<int, 9> quad;
    std::size_t count = 0;

    Neighbourhood(const DrawnQuads& drawn, int x, int y) {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                quad[count++] = drawn.at(x + dx, y + dy);
        std::sort(quad.begin(), quad.end());
        count = static_cast<std::size_t>(std::unique(quad.begin(), quad.end()) - quad.begin());
    }
    bool has_background() const { return quad[0] < 0; }
};

struct Meeting {
    int quad = -1;
    double distance = 0;
};

/// The nearest of the candidates that the ray meets; of coplanar ones the first.
Meeting nearest(const std::vector<SeenQuad>& seen, const Neighbourhood& candidates,
                const Vec3& direction) {
    // Distances to one and the same plane differ by rounding only.
    constexpr double same_plane = 1e-10;
    Meeting best;
    for (std::size_t k = 0; k < candidates.count; ++k) {
        const int quad = candidates.quad[k];
        if (quad < 0) continue;
        const auto distance = seen[static_cast<std::size_t>(quad)].distance(direction);
        if (!distance) continue;
        if (best.quad < 0 || *distance < (1 - same_plane) * best.distance) best = {quad, *distance};
    }
    return best;
}

/// The point of the quad nearest, in its parameters, to where the ray meets its plane.
std::optional<Vec3> point_beside(const Quad& quad, const SeenQuad& seen, const Vec3& eye,
                                 const Vec3& direction) {
    const auto distance = seen.plane_distance(direction);
    if (!distance) return std::nullopt;
    const Vec2 uv = quad.parameters(eye + *distance * direction);
    if (!uv.allFinite()) return std::nullopt;
    return quad.point(std::clamp(uv[0], 0.0, 1.0), std::clamp(uv[1], 0.0, 1.0));
}

}  // namespace

SurfaceBuffer meet_surfaces(const std::vector<Quad>& quads, const CameraRays& camera,
                            const DrawnQuads& drawn) {
    const PixelWindow& window = drawn.window;
    const Vec3 eye = camera.position();
    std::vector<SeenQuad> seen;
    seen.reserve(quads.size());
    for (const Quad& quad : quads)
        seen.emplace_back(quad, eye);

    SurfaceBuffer buffer;
    buffer.width = window.width;
    buffer.height = window.height;
    const std::size_t count = buffer.index(0, window.height);
    buffer.quad.assign(count, -1);
    buffer.front.assign(count, 0);
    buffer.position.assign(count, Vec3::Zero());

    const auto set = [&](std::size_t pixel, int quad, const Vec3& position) {
        buffer.quad[pixel] = quad;
        buffer.front[pixel] = seen[static_cast<std::size_t>(quad)].front();
        buffer.position[pixel] = position;
    };
    const auto meet_pixel = [&](int x, int y) {
        const Neighbourhood around(drawn, x, y);
        if (around.count == 1 && around.has_background()) return;
        const Vec3 direction = camera.direction(window.left + x + 0.5, window.top + y + 0.5);
        const Meeting met = nearest(seen, around, direction);
        if (met.quad >= 0) {
            set(buffer.index(x, y), met.quad, eye + met.distance * direction);
        } else if (!around.has_background()) {
            // The ray slips through a crack as narrow as the rounding of the vertices. Nothing but
            // surface is round about, so it is surface that belongs here.
            const int quad = drawn.at(x, y);
            const auto q = static_cast<std::size_t>(quad);
            if (const auto point = point_beside(quads[q], seen[q], eye, direction))
                set(buffer.index(x, y), quad, *point);
        }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, window.height),
                      [&](const tbb::blocked_range<int>& rows) {
                          for (int y = rows.begin(); y < rows.end(); ++y)
                              for (int x = 0; x < window.width; ++x)
                                  meet_pixel(x, y);
                      });
    return buffer;
}

}  // namespace lightwell
