#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "radiance4d/scene/scene_quads.h"
#include "solver/reading/scene_reader.h"
#include "solver/reference/path_tracer.h"

namespace lightwell {
namespace {

struct Sample {
    const char* name;
    int quads;
};

std::ostream& operator<<(std::ostream& out, const Sample& sample) {
    return out << sample.name;
}

std::string file_of(const Sample& sample, const std::string& file) {
    return std::string(LIGHTWELL_SCENES) + "/" + sample.name + "/" + file;
}

/// A line of expected.csv: a sensor and what it must show.
struct Expectation {
    SurfacePoint sensor;
    double indirect = 0;  ///< [lx]
    double total = 0;     ///< [lx]
    double error = 0;     ///< one standard error of total [lx]
};

std::vector<double> numbers_in(const std::string& line) {
    std::vector<double> numbers;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
        double number = std::nan("");
        std::from_chars(field.data(), field.data() + field.size(), number);
        numbers.push_back(number);
    }
    return numbers;
}

/// The quad whose side towards `normal` the point lies on; free_point for a point in the air.
int quad_under(const Scene& scene, const Vec3& position, const Vec3& normal) {
    for (std::size_t i = 0; i < scene.quads.size(); ++i) {
        const Quad& quad = scene.quads[i].quad;
        if (std::abs(quad.normal().dot(normal)) < 1 - 1e-9) continue;
        if (std::abs(quad.normal().dot(position - quad.vertex[0])) > 1e-9) continue;
        const Vec2 at = quad.parameters(position);
        if (at.minCoeff() >= 0 && at.maxCoeff() <= 1) return static_cast<int>(i);
    }
    return free_point;
}

std::vector<Expectation> expectations(const Sample& sample, const Scene& scene) {
    std::ifstream file(file_of(sample, "expected.csv"));
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line,
              "x,y,z,nx,ny,nz,direct_r,direct_g,direct_b,indirect_r,indirect_g,indirect_b,lux,"
              "lux_error");
    std::vector<Expectation> result;
    while (std::getline(file, line)) {
        const std::vector<double> n = numbers_in(line);
        if (n.size() != 14) {
            ADD_FAILURE() << "not 14 numbers: " << line;
            continue;
        }
        Expectation row;
        row.sensor.position = {n[0], n[1], n[2]};
        row.sensor.normal = {n[3], n[4], n[5]};
        row.sensor.quad = quad_under(scene, row.sensor.position, row.sensor.normal);
        row.indirect = luminance({n[9], n[10], n[11]});
        row.total = n[12];
        row.error = n[13];
        EXPECT_NEAR(luminance({n[6], n[7], n[8]}) + row.indirect, row.total, 1e-3 * row.total)
            << line;
        result.push_back(row);
    }
    return result;
}

class SampleScenes : public ::testing::TestWithParam<Sample> {
  protected:
    ReadScene read_ = read_scene(file_of(GetParam(), "scene.toml"));
};

TEST_P(SampleScenes, IsReadAsItIsWithoutAWarning) {
    for (const Warning& warning : read_.report.warnings)
        ADD_FAILURE() << warning.to_string();
    EXPECT_EQ(read_.report.counts.faces, GetParam().quads);
    EXPECT_EQ(read_.report.counts.quads, GetParam().quads);
    EXPECT_EQ(read_.scene.quads.size(), static_cast<std::size_t>(GetParam().quads));
    EXPECT_TRUE(read_.scene.camera.has_value());
    EXPECT_FALSE(read_.scene.sensor_grids.empty());
}

TEST_P(SampleScenes, BareGeometryHasTheSameColours) {
    const Scene bare = read_scene(file_of(GetParam(), std::string(GetParam().name) + ".obj")).scene;
    ASSERT_EQ(bare.quads.size(), read_.scene.quads.size());
    for (int quad = 0; quad < GetParam().quads; ++quad) {
        const Material& of_bare = bare.material_of(quad);
        const Material& of_scene = read_.scene.material_of(quad);
        EXPECT_TRUE((of_bare.reflectance == of_scene.reflectance).all()) << bare.describe(quad);
        EXPECT_TRUE((of_bare.emission == of_scene.emission).all()) << bare.describe(quad);
    }
}

// The numbers in expected.csv come from another program; ours must agree within the noise of both.
TEST_P(SampleScenes, ThePathTracerFindsTheExpectedNumbers) {
    const Scene& scene = read_.scene;
    const std::vector<Expectation> expected = expectations(GetParam(), scene);
    ASSERT_GE(expected.size(), 5u);

    const std::vector<Quad> quads = quads_of(scene);
    const Visibility visibility(quads);
    const PathTracer tracer(scene, visibility, scene.lights);
    std::vector<SurfacePoint> sensors;
    for (const Expectation& row : expected)
        sensors.push_back(row.sensor);
    PathTracing how;
    how.samples = 16384;
    const LightSurvey total = tracer.total(sensors, how);
    const LightSurvey indirect = tracer.indirect(sensors, how);

    const auto agrees = [](const LightEstimate& found, double truth, double error) {
        // Noise of the channels counts as wholly correlated, which can only make it larger.
        const double noise = luminance(found.standard_error);
        EXPECT_LE(noise, 0.03 * truth) << "too noisy to say anything";
        const double rounding = 1e-4 * truth;  // of the five digits in the file
        return std::abs(luminance(found.mean) - truth) <= 4.5 * std::hypot(noise, error) + rounding;
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_TRUE(agrees(total.at[i], expected[i].total, expected[i].error))
            << "sensor " << i << ": " << luminance(total.at[i].mean) << " lx, expected "
            << expected[i].total;
        EXPECT_TRUE(agrees(indirect.at[i], expected[i].indirect, expected[i].error))
            << "sensor " << i << ": " << luminance(indirect.at[i].mean) << " lx indirect, expected "
            << expected[i].indirect;
    }
}

INSTANTIATE_TEST_SUITE_P(All, SampleScenes,
                         ::testing::Values(Sample{"cornell-box", 16}, Sample{"furnace", 38},
                                           Sample{"corner", 3}, Sample{"two-rooms", 11},
                                           Sample{"maze", 88}, Sample{"office", 145}),
                         [](const auto& scene) {
                             std::string name = scene.param.name;
                             for (char& letter : name)
                                 if (letter == '-') letter = '_';
                             return name;
                         });

}  // namespace
}  // namespace lightwell
