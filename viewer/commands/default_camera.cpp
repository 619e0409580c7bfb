#include "viewer/commands/default_camera.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "runtime/drawing/camera_rays.h"

namespace lightwell {

namespace {

constexpr double vertical_angle = 60;   // [degrees]
constexpr double eye_height = 1.6;      // [m]
constexpr int columns = 24, rows = 16;  // of the rays that judge a place

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
    const double above_floor = std::min(eye_height, 0.5 * extent);
    const double height =
        scene.up[up] > 0 ? box.min()[up] + above_floor : box.max()[up] - above_floor;

    Camera best;
    double deepest = -1;
    // Golden-section shares keep off symmetry planes, where walls like to stand.
    const double shares[] = {0.06, 0.191, 0.382, 0.618, 0.809, 0.94};
    for (const double a : shares)
        for (const double b : shares) {
            Camera camera;
            camera.up = scene.up;
            camera.vertical_angle = vertical_angle;
            camera.position[up] = height;
            camera.position[across] = box.min()[across] + a * box.sizes()[across];
            camera.position[along] = box.min()[along] + b * box.sizes()[along];
            camera.target = box.center();
            camera.target[up] = height;
            // A flat scene has no inside to stand in.
            const double width = std::max(box.sizes()[across], box.sizes()[along]);
            if ((camera.target - camera.position).norm() < 1e-3 * width) continue;
            const double depth = depth_of(camera, space, visibility);
            if (depth > deepest) {
                deepest = depth;
                best = camera;
            }
        }
    return best;
}

}  // namespace lightwell
