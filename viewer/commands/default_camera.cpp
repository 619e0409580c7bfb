#include "viewer/commands/default_camera.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "runtime/drawing/camera_rays.h"

namespace lightwell {

namespace {

constexpr double vertical_angle = 60;   // [degrees]
constexpr double eye_height = 1.6;      // [m]
constexpr int columns = 24, rows = 16;  // of the rays that judge a place
constexpr int most_floors = 16;

/// Sum of what a picture from there shows, by its distance [m]; surfaces close by, and those that
/// take no part, show nothing.
double depth_of(const Camera& camera, const RadianceSpace& space, const Visibility& visibility) {
    const CameraRays rays(camera, columns, rows);
    double sum = 0;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const Hit hit =
                visibility.nearest(camera.position, free_point, rays.direction(x + 0.5, y + 0.5));
            if (hit && space.element_on(hit.quad, hit.front) >= 0) sum += hit.distance;
        }
    return sum;
}

/// Heights above `top`, negative, at which an eye stands on the floors that a ray straight down
/// from there meets: at eye level, or half way up where a ceiling is lower.
std::vector<double> eyes_below(const Vec3& top, const Vec3& up, const Visibility& visibility) {
    std::vector<double> eyes;
    Vec3 at = top;
    int on = free_point;
    double ceiling = 0;
    for (int floor = 0; floor < most_floors; ++floor) {
        const Hit hit = visibility.nearest(at, on, -up);
        if (!hit) break;
        at -= hit.distance * up;
        on = hit.quad;
        const double height = (at - top).dot(up);
        // The roof has no ceiling above it.
        if (floor > 0) eyes.push_back(height + std::min(eye_height, 0.5 * (ceiling - height)));
        ceiling = height;
    }
    return eyes;
}

}  // namespace

Camera default_camera(const Scene& scene, const RadianceSpace& space,
                      const Visibility& visibility) {
    Eigen::AlignedBox3d box;
    for (const SceneQuad& quad : scene.quads)
        for (const Vec3& vertex : quad.quad.vertex)
            box.extend(vertex);

    int up = 0;
    scene.up.cwiseAbs().maxCoeff(&up);
    const int across = (up + 1) % 3, along = (up + 2) % 3;
    const double extent = box.sizes()[up];
    const double top =
        (scene.up[up] > 0 ? box.max() : box.min())[up] + 0.01 * extent * scene.up[up];
    // Where there is no floor, as in a box that lies open, eyes stand on the lowest point.
    const double lowest = std::min(eye_height, 0.5 * extent) - 1.01 * extent;

    Camera best;
    double deepest = -1;
    const auto judge = [&](const Vec3& position) {
        Camera camera;
        camera.up = scene.up;
        camera.vertical_angle = vertical_angle;
        camera.position = position;
        camera.target = box.center();
        camera.target[up] = position[up];
        // A flat scene has no inside to stand in.
        const double width = std::max(box.sizes()[across], box.sizes()[along]);
        if ((camera.target - camera.position).norm() < 1e-3 * width) return;
        const double depth = depth_of(camera, space, visibility);
        if (depth <= deepest) return;
        deepest = depth;
        best = camera;
    };
    // Golden-section shares keep off symmetry planes, where walls like to stand.
    const double shares[] = {0.06, 0.191, 0.382, 0.618, 0.809, 0.94};
    std::vector<Vec3> on_floors, elsewhere;
    for (const double a : shares)
        for (const double b : shares) {
            Vec3 place;
            place[up] = top;
            place[across] = box.min()[across] + a * box.sizes()[across];
            place[along] = box.min()[along] + b * box.sizes()[along];
            for (const double eye : eyes_below(place, scene.up, visibility))
                on_floors.push_back(place + eye * scene.up);
            elsewhere.push_back(place + lowest * scene.up);
        }
    for (const Vec3& place : on_floors)
        judge(place);
    if (!(deepest > 0))
        for (const Vec3& place : elsewhere)
            judge(place);
    return best;
}

}  // namespace lightwell
