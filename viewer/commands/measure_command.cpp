#include "viewer/commands/measure_command.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "runtime/outgoing/final_gather.h"
#include "runtime/outgoing/surface_lookup.h"
#include "runtime/propagation/lighting.h"
#include "solver/reading/input_file.h"
#include "solver/reading/sensor_reader.h"
#include "viewer/commands/lit_scene.h"
#include "viewer/commands/opened_operator.h"
#include "viewer/commands/output.h"
#include "viewer/commands/stop_signal.h"

namespace lightwell {

namespace {

/// Illuminance at one sensor [lx].
struct Reading {
    Rgb direct = Rgb::Zero();
    Rgb indirect = Rgb::Zero();
};

std::vector<Sensor> sensors_of(const SensorGrid& grid) {
    std::vector<Sensor> sensors;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i)
            sensors.push_back({grid.origin + (i + 0.5) / grid.columns * grid.along +
                                   (j + 0.5) / grid.rows * grid.across,
                               grid.normal.normalized()});
    return sensors;
}

std::vector<Sensor> chosen_sensors(const MeasureRequest& request, const Scene& scene) {
    if (request.sensors) return read_sensors_csv(*request.sensors);
    std::string names;
    for (const SensorGrid& grid : scene.sensor_grids) {
        if (request.grid && grid.name == *request.grid) return sensors_of(grid);
        names += (names.empty() ? "" : ", ") + in_quotes(grid.name);
    }
    const std::string there = names.empty() ? "the scene has none" : "the scene has " + names;
    throw InputError(
        request.grid
            ? fmt::format("--grid: no sensor grid {}; {}", in_quotes(*request.grid), there)
            : fmt::format(
                  "--sensors FILE.csv, --grid NAME or --probes FILE.csv is needed; grids: {}",
                  there));
}

/// Indirect illuminance as the basis shows it.
Rgb basis_irradiance(const RadianceSpace& space, const std::vector<SmoothSurface>& surfaces,
                     const SensorStand& stand) {
    const int e = space.element_on(stand.quad, stand.front);
    // A side that takes no part sees no other surface.
    if (e < 0) return Rgb::Zero();
    const auto element = static_cast<std::size_t>(e);
    const Vec2 uv = space.element(element).geometry.parameters(stand.point);
    return surfaces[element].at(uv[0], uv[1]);
}

void require_on_surface(const std::vector<SensorStand>& stands,
                        const std::vector<Sensor>& sensors) {
    for (std::size_t k = 0; k < stands.size(); ++k)
        if (stands[k].quad == free_point) {
            const Vec3& p = sensors[k].position;
            throw InputError(fmt::format(
                "--no-gather: sensor {} at ({}, {}, {}) lies on no surface, or does not face along "
                "its normal; only the gather can measure there",
                k + 1, p[0], p[1], p[2]));
        }
}

std::vector<Reading> readings(const OpenedOperator& opened, const std::vector<Light>& lights,
                              const std::vector<Sensor>& sensors, bool gather) {
    const GlobalTransport& transport = opened.transport;
    const SurfaceLookup lookup(opened.quads, opened.occluders);
    std::vector<SensorStand> stands;
    stands.reserve(sensors.size());
    for (const Sensor& sensor : sensors)
        stands.push_back(lookup.stand(sensor.position, sensor.normal));
    if (!gather) require_on_surface(stands, sensors);

    const LitScene lit(opened, lights);
    const std::vector<SmoothSurface> surfaces =
        smooth_irradiance(transport.space, lit.lighting().indirect);
    const FinalGather last_bounce = lit.gather(gather_strata(transport.provenance.error_asked));

    std::vector<Reading> result(sensors.size());
    tbb::parallel_for(std::size_t{0}, sensors.size(), [&](std::size_t k) {
        if (stop_requested()) throw Interrupted("stopped on request");
        const SensorStand& stand = stands[k];
        const Vec3& normal = sensors[k].normal;
        result[k].direct = lit.direct().irradiance(stand.point, normal, stand.quad, lights);
        result[k].indirect = gather ? last_bounce.irradiance(stand.point, normal, stand.quad)
                                    : basis_irradiance(transport.space, surfaces, stand);
    });
    return result;
}

/// What probes see [cd/m2].
std::vector<Reading> looks(const OpenedOperator& opened, const std::vector<Light>& lights,
                           const std::vector<LookingPoint>& probes, bool gather,
                           LampDirections lamps) {
    const LitScene lit(opened, lights, lamps);
    const std::vector<SmoothSurface> surfaces =
        smooth_irradiance(opened.transport.space, lit.lighting().indirect);
    const FinalGather last_bounce =
        lit.gather(gather_strata(opened.transport.provenance.error_asked));
    std::vector<Reading> result(probes.size());
    tbb::parallel_for(std::size_t{0}, probes.size(), [&](std::size_t k) {
        if (stop_requested()) throw Interrupted("stopped on request");
        const SeenLight seen =
            seen_light(opened, lit, lights, surfaces, gather ? &last_bounce : nullptr,
                       probes[k].position, probes[k].direction);
        result[k] = {seen.direct, seen.indirect};
    });
    return result;
}

std::string row(const Vec3& position, const Vec3& direction, const Reading& reading) {
    const auto& [direct, indirect] = reading;
    return fmt::format("{},{},{},{},{},{},", position[0], position[1], position[2], direction[0],
                       direction[1], direction[2]) +
           fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", direct[0], direct[1],
                       direct[2], indirect[0], indirect[1], indirect[2],
                       luminance(Rgb(direct + indirect)));
}

}  // namespace

int gather_strata(double error) {
    constexpr double finest = 0.01, coarsest = 0.08;
    return static_cast<int>(
        std::lround(90 * std::sqrt(finest / std::clamp(error, finest, coarsest))));
}

void run_measure(const MeasureRequest& request) {
    if (!request.output.empty()) {
        require_writable(request.output);
        require_not_read(request.output,
                         {request.operator_file, request.sensors.value_or(""),
                          request.probes.value_or(""), request.lights.value_or("")});
    }
    const OpenedOperator opened = open_operator(request.operator_file);
    const std::vector<Light> lights = chosen_lights(request.lights, opened.transport.scene);
    std::string text;
    if (request.probes) {
        const std::vector<LookingPoint> probes = read_probes_csv(*request.probes);
        const std::vector<Reading> seen =
            looks(opened, lights, probes, request.gather,
                  request.spread_lamps ? LampDirections::forgotten : LampDirections::kept);
        text = "x,y,z,dx,dy,dz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,cd_m2\n";
        for (std::size_t k = 0; k < probes.size(); ++k)
            text += row(probes[k].position, probes[k].direction, seen[k]);
    } else {
        const std::vector<Sensor> sensors = chosen_sensors(request, opened.transport.scene);
        const std::vector<Reading> measured = readings(opened, lights, sensors, request.gather);
        text = "x,y,z,nx,ny,nz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,lux\n";
        for (std::size_t k = 0; k < sensors.size(); ++k)
            text += row(sensors[k].position, sensors[k].normal, measured[k]);
    }
    write_result(request.output, text);
}

}  // namespace lightwell
