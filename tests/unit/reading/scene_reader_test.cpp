#include "solver/reading/scene_reader.h"

#include <gtest/gtest.h>

#include "radiance4d/scene/brdf.h"
#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

const std::string square = "v 0 0 0\nv 200 0 0\nv 200 100 0\nv 0 100 0\n";
const std::string square_above = "v 0 0 50\nv 200 0 50\nv 200 100 50\nv 0 100 50\n";

/// A folder with an OBJ of one face each of the materials red, lamp and unknown.
class SceneReader : public ::testing::Test {
  protected:
    void SetUp() override {
        folder.write("room.mtl", "newmtl red\nKd 0.8 0.1 0.1\nnewmtl lamp\nKd 0 0 0\nKe 5 6 7\n");
        folder.write("room.obj", "mtllib room.mtl\n" + square + square_above +
                                     "usemtl red\nf 1 2 3 4\nusemtl lamp\nf 8 7 6 5\n");
    }

    ReadScene read(const std::string& toml) { return read_scene(folder.write("scene.toml", toml)); }
    std::string error_of(const std::string& toml) {
        return input_error_of([&] { read(toml); });
    }
    /// The error of a scene file that is sound but for some lines at its end.
    std::string error_after_geometry(const std::string& lines) {
        return error_of("geometry = \"room.obj\"\n" + lines);
    }

    ScratchFolder folder;
};

TEST_F(SceneReader, ReadsABareObjWithItsMaterials) {
    const ReadScene read = read_scene(folder / "room.obj");
    EXPECT_EQ(read.scene.name, "room");
    ASSERT_EQ(read.scene.quads.size(), 2u);
    EXPECT_DOUBLE_EQ(read.scene.quads[0].quad.area(), 20000);
    EXPECT_TRUE((read.scene.material_of(0).reflectance == Rgb(0.8, 0.1, 0.1)).all());
    EXPECT_TRUE((read.scene.material_of(1).emission == Rgb(5, 6, 7)).all());
    EXPECT_EQ(read.scene.material_of(1).reflecting, Sides::both);
    EXPECT_EQ(read.scene.material_of(1).emitting, Sides::front);
    EXPECT_EQ(read.scene.quads[1].line, 13);
    EXPECT_TRUE(read.report.warnings.empty());
    EXPECT_EQ(read.scene.up, Vec3::UnitZ());
}

TEST_F(SceneReader, TakesBareGeometryForWhatItIsToldToBe) {
    BareGeometry bare;
    EXPECT_EQ(assumed_of("room.obj", bare), "lengths are in metres and z points up");
    bare.metres_per_unit = metres_in("cm");
    EXPECT_EQ(assumed_of("room.obj", bare), "z points up");
    bare.up = axis_called("y");
    EXPECT_EQ(assumed_of("room.obj", bare), "");
    EXPECT_EQ(assumed_of("scene.toml", {}), "");
    const Scene scene = read_scene(folder / "room.obj", AlbedoAboveOne::refuse, bare).scene;
    EXPECT_NEAR(scene.quads[0].quad.area(), 2, 1e-12);
    EXPECT_EQ(scene.up, Vec3::UnitY());
    const std::string file = folder.write("scene.toml", "geometry = \"room.obj\"\n");
    EXPECT_EQ(input_error_of([&] {
                  read_scene(file, AlbedoAboveOne::refuse, bare);
              }).rfind("scene.toml: is a scene file", 0),
              0u);
}

TEST_F(SceneReader, ReadsEverythingASceneFileCanSay) {
    const ReadScene read = this->read(R"(
name = "Room 7"
geometry = "room.obj"
unit = "cm"
up = "y"

[material.red]
reflectance = 0.3
sides = "front"

[material.lamp]
emission = [1, 2, 3]
emission_sides = "both"

[[light]]
name = "lamp"
type = "point"
position = [2.0, 1.5, 2.4]
intensity = [100, 90, 80]

[[light]]
type = "spot"
position = [1, 1, 2]
intensity = 50
direction = [0, 0, -2]
inner_angle = 10
outer_angle = 25

[camera]
position = [5, 4, 1.6]
target = [0, 0, 1]
vertical_angle = 40

[[sensors]]
name = "desk"
origin = [0, 0, 0.8]
along = [4, 0, 0]
across = [0, 3, 0]
columns = 8
rows = 6
)");
    const Scene& scene = read.scene;
    EXPECT_EQ(scene.name, "Room 7");
    EXPECT_EQ(scene.up, Vec3::UnitY());
    EXPECT_DOUBLE_EQ(scene.quads[0].quad.area(), 2);
    EXPECT_TRUE((scene.material_of(0).reflectance == 0.3).all());
    EXPECT_EQ(scene.material_of(0).reflecting, Sides::front);
    // The table gives the emission alone; the reflectance is the MTL's.
    EXPECT_TRUE((scene.material_of(1).emission == Rgb(1, 2, 3)).all());
    EXPECT_TRUE((scene.material_of(1).reflectance == 0).all());
    EXPECT_EQ(scene.material_of(1).emitting, Sides::both);
    ASSERT_EQ(scene.lights.size(), 2u);
    const auto& point = std::get<PointLight>(scene.lights[0]);
    EXPECT_EQ(point.name, "lamp");
    EXPECT_EQ(point.position, Vec3(2, 1.5, 2.4));
    EXPECT_TRUE((point.intensity == Rgb(100, 90, 80)).all());
    const auto& spot = std::get<SpotLight>(scene.lights[1]);
    EXPECT_EQ(spot.name, "light 2");
    EXPECT_TRUE((spot.intensity == 50).all());
    EXPECT_EQ(spot.direction, -Vec3::UnitZ());
    EXPECT_EQ(spot.inner_angle, 10);
    EXPECT_EQ(spot.outer_angle, 25);
    ASSERT_TRUE(scene.camera);
    EXPECT_EQ(scene.camera->position, Vec3(5, 4, 1.6));
    EXPECT_EQ(scene.camera->up, Vec3::UnitY());
    EXPECT_EQ(scene.camera->vertical_angle, 40);
    ASSERT_EQ(scene.sensor_grids.size(), 1u);
    EXPECT_EQ(scene.sensor_grids[0].name, "desk");
    EXPECT_EQ(scene.sensor_grids[0].normal, Vec3::UnitZ());
    EXPECT_EQ(scene.sensor_grids[0].columns, 8);
    EXPECT_EQ(scene.sensor_grids[0].rows, 6);
    EXPECT_TRUE(read.report.warnings.empty());
}

TEST_F(SceneReader, KnowsEveryUnit) {
    const std::vector<std::pair<std::string, double>> units = {
        {"\"m\"", 1},       {"\"cm\"", 0.01},     {"\"mm\"", 0.001}, {"\"in\"", 0.0254},
        {"\"ft\"", 0.3048}, {"0.03125", 1. / 32}, {"2", 2}};
    for (const auto& [name, metres] : units) {
        const ReadScene read = this->read("geometry = \"room.obj\"\nunit = " + name + "\n");
        EXPECT_DOUBLE_EQ(read.scene.quads[0].quad.vertex[1][0], 200 * metres) << name;
    }
}

TEST_F(SceneReader, TakesGreyForMissingMaterialsAndSaysSo) {
    const std::string file = folder.write("bare.obj", "mtllib none.mtl\n" + square + square_above +
                                                          "f 1 2 3 4\nusemtl blue\nf 5 6 7 8\n");
    const ReadScene read = read_scene(file);
    for (int quad : {0, 1}) {
        EXPECT_TRUE((read.scene.material_of(quad).reflectance == 0.5).all());
        EXPECT_TRUE((read.scene.material_of(quad).emission == 0).all());
    }
    ASSERT_EQ(read.report.warnings.size(), 3u);
    EXPECT_EQ(read.report.warnings[0].message, "material file 'none.mtl' is not there");
    EXPECT_EQ(read.report.warnings[0].place.line, 1);
    EXPECT_EQ(read.report.warnings[1].message,
              "no description of material 'blue': 0.5 grey is taken");
    EXPECT_EQ(read.report.warnings[2].message, "1 face has no material: 0.5 grey is taken");
}

TEST_F(SceneReader, TakesTheDefaultMaterialWhereThereIsOne) {
    folder.write("bare.obj", square + square_above + "f 1 2 3 4\nusemtl blue\nf 5 6 7 8\n");
    const ReadScene read = this->read(
        "geometry = \"bare.obj\"\ndefault_material = \"plaster\"\n"
        "[material.plaster]\nreflectance = [0.9, 0.8, 0.7]\n");
    ASSERT_EQ(read.scene.materials.size(), 1u);
    for (int quad : {0, 1})
        EXPECT_TRUE((read.scene.material_of(quad).reflectance == Rgb(0.9, 0.8, 0.7)).all());
    ASSERT_EQ(read.report.warnings.size(), 1u);
    EXPECT_EQ(read.report.warnings[0].message,
              "no description of material 'blue': the default 'plaster' is taken");
}

TEST_F(SceneReader, ReadsLobesOfBothKinds) {
    folder.write("room.mtl",
                 "newmtl red\nKd 0.4\nKs 0.1 0.2 0.3\nNs 20\nnewmtl lamp\nKd 0.1\nKs 0.5\n");
    const Scene bare = read_scene(folder / "room.obj").scene;
    const auto* phong = std::get_if<PhongLobe>(&bare.material_of(0).lobe);
    ASSERT_NE(phong, nullptr);
    EXPECT_TRUE((phong->reflectance == Rgb(0.1, 0.2, 0.3)).all());
    EXPECT_EQ(phong->exponent, 20);
    // A highlight without an exponent has no shape.
    EXPECT_TRUE(std::holds_alternative<NoLobe>(bare.material_of(1).lobe));

    // The scene file gives the shape, the MTL file the reflectance, and the other way round.
    const Scene scene = this->read(
                                "geometry = \"room.obj\"\n[material.red]\nroughness = 0.3\n"
                                "[material.lamp]\nspecular = [0.2, 0.3, 0.4]\nexponent = 7\n")
                            .scene;
    const auto* ggx = std::get_if<GgxLobe>(&scene.material_of(0).lobe);
    ASSERT_NE(ggx, nullptr);
    EXPECT_TRUE((ggx->reflectance == Rgb(0.1, 0.2, 0.3)).all());
    EXPECT_EQ(ggx->roughness, 0.3);
    phong = std::get_if<PhongLobe>(&scene.material_of(1).lobe);
    ASSERT_NE(phong, nullptr);
    EXPECT_TRUE((phong->reflectance == Rgb(0.2, 0.3, 0.4)).all());
    EXPECT_EQ(phong->exponent, 7);
}

TEST_F(SceneReader, SaysWhichHighlightsHaveNoShape) {
    folder.write("room.mtl", "newmtl red\nKd 0.4\nKs 0.1\nnewmtl lamp\nKd 0\n");
    const ReadScene read = read_scene(folder / "room.obj");
    ASSERT_EQ(read.report.warnings.size(), 1u);
    EXPECT_EQ(read.report.warnings[0].place.line, 1);
    EXPECT_EQ(read.report.warnings[0].message,
              "material 'red' has a specular reflectance, but no exponent and no roughness: it is "
              "taken as diffuse");
}

TEST_F(SceneReader, RefusesMaterialsThatMakeLight) {
    folder.write("room.mtl", "newmtl red\nKd 0.7 0.725 0.2\nKs 0.3\nNs 32\nnewmtl lamp\nKd 0\n");
    EXPECT_EQ(input_error_of([&] { read_scene(folder / "room.obj"); }),
              "room.mtl:1:8: material 'red' reflects more light than it receives: 1.025 of the "
              "green at 0 degrees from the normal; --scale-albedo takes the scene all the same");
    const ReadScene scaled = read_scene(folder / "room.obj", AlbedoAboveOne::scale);
    EXPECT_NEAR(scaled.scene.material_of(0).reflectance[1], 0.725 / 1.025, 1e-9);
    EXPECT_NEAR(lobe_reflectance(scaled.scene.material_of(0).lobe)[0], 0.3 / 1.025, 1e-9);
    ASSERT_EQ(scaled.report.warnings.size(), 1u);
    EXPECT_EQ(scaled.report.warnings[0].message,
              "material 'red' reflects more light than it receives: 1.025 of the green at 0 "
              "degrees from the normal; diffuse and specular reflectance are scaled by 0.9756");
    // Rough facets hide each other at the normal, not at grazing angles.
    const auto rough = [&](double diffuse) {
        return this->read(
            "geometry = \"room.obj\"\n[material.red]\nspecular = 0.5\nroughness = 1\n"
            "reflectance = " +
            std::to_string(diffuse) + "\n");
    };
    EXPECT_NO_THROW(rough(0.45));
    EXPECT_NE(input_error_of([&] { rough(0.8); }).find("of the red at 89 degrees"),
              std::string::npos);
}

TEST_F(SceneReader, RefusesLobesOfNoShapeOrTwo) {
    EXPECT_EQ(error_after_geometry("[material.red]\nroughness = 0\n"),
              "scene.toml:3:13: roughness 0 is not within 0.01 and 1");
    EXPECT_EQ(error_after_geometry("[material.red]\nexponent = -1\n"),
              "scene.toml:3:12: exponent -1 is not within 0 and 10000");
    EXPECT_EQ(error_after_geometry("[material.red]\nspecular = 2\n"),
              "scene.toml:3:12: specular [2, 2, 2] is not within 0 and 1");
    EXPECT_EQ(error_after_geometry("[material.red]\nexponent = 3\nroughness = 0.5\n"),
              "scene.toml:4:13: a lobe has an exponent (Phong) or a roughness (GGX), not both");
}

TEST_F(SceneReader, WarnsOfMaterialsThatNothingUses) {
    const ReadScene read =
        this->read("geometry = \"room.obj\"\n[material.Red]\nreflectance = 0.1\n");
    ASSERT_EQ(read.report.warnings.size(), 1u);
    EXPECT_EQ(read.report.warnings[0].place.line, 2);
}

TEST_F(SceneReader, FindsMaterialFilesWhoseNamesHaveBlanks) {
    folder.write("my room.mtl", "newmtl white\nKd 1 1 1\n");
    folder.write("b.mtl", "newmtl black\nKd 0 0 0\n");
    for (const std::string library :
         {"my room.mtl\nmtllib b.mtl", "none.mtl my\\ room.mtl b.mtl"}) {
        const ReadScene read = read_scene(
            folder.write("a.obj", "mtllib " + library + "\n" + square + square_above +
                                      "usemtl white\nf 1 2 3 4\nusemtl black\nf 5 6 7 8\n"));
        EXPECT_TRUE((read.scene.material_of(0).reflectance == 1).all()) << library;
        EXPECT_TRUE((read.scene.material_of(1).reflectance == 0).all()) << library;
    }
}

TEST_F(SceneReader, RefusesADimmerThatBrightens) {
    EXPECT_EQ(error_after_geometry("[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\n"
                                   "intensity = 1\ndimmer = 1.5\n"),
              "scene.toml:6:10: dimmer 1.5 is not within 0 and 1");
}

TEST_F(SceneReader, RefusesUnknownKeysWithTheirPlace) {
    EXPECT_EQ(error_after_geometry("colour = 1\n"),
              "scene.toml:2:1: unknown key 'colour'; known here: camera, cut_along_walls, "
              "default_material, geometry, light, material, name, sensors, unit, up");
    EXPECT_EQ(error_after_geometry("[material.red]\n  gloss = 1\n"),
              "scene.toml:3:3: unknown key 'gloss' in [material.red]; known here: emission, "
              "emission_sides, exponent, reflectance, roughness, sides, specular");
    EXPECT_EQ(
        error_after_geometry("[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\n"
                             "intensity = 1\ninner_angle = 3\n"),
        "scene.toml:6:1: unknown key 'inner_angle' in [[light]]; known here: dimmer, intensity, "
        "name, on, position, type");
}

TEST_F(SceneReader, RefusesWrongTypesWithTheirPlace) {
    EXPECT_EQ(error_after_geometry("name = 3\n"),
              "scene.toml:2:8: name must be a text, not the number 3");
    EXPECT_EQ(error_after_geometry("[material.red]\nreflectance = \"0.3\"\n"),
              "scene.toml:3:15: reflectance must be a number or three [r, g, b], not the text "
              "'0.3'");
    EXPECT_EQ(error_after_geometry("light = 3\n"),
              "scene.toml:2:9: light must be a list of tables [[light]], not the number 3");
    EXPECT_EQ(error_after_geometry("camera = [1]\n"),
              "scene.toml:2:10: camera must be a table [camera], not a list");
    EXPECT_EQ(error_after_geometry("[camera]\nposition = [1, 2]\n"),
              "scene.toml:3:12: position must be three numbers, not 2");
    EXPECT_EQ(error_after_geometry("[camera]\nposition = [1, 2, true]\n"),
              "scene.toml:3:19: position must be three finite numbers, not true");
    EXPECT_EQ(error_after_geometry("[camera]\nposition = [1, 2, nan]\n"),
              "scene.toml:3:19: position must be three finite numbers, not the number nan");
}

TEST_F(SceneReader, RefusesValuesOutOfRangeWithTheirPlace) {
    EXPECT_EQ(error_after_geometry("[material.red]\nreflectance = 1.01\n"),
              "scene.toml:3:15: reflectance [1.01, 1.01, 1.01] is not within 0 and 1");
    EXPECT_EQ(error_after_geometry("[material.red]\nemission = [0, -1, 0]\n"),
              "scene.toml:3:12: emission [0, -1, 0] is negative or too large");
    EXPECT_EQ(error_after_geometry("[material.red]\nsides = \"back\"\n"),
              "scene.toml:3:9: sides must be \"front\" or \"both\", not 'back'");
    EXPECT_EQ(error_after_geometry("unit = \"km\"\n"),
              "scene.toml:2:8: unit must be \"m\", \"cm\", \"mm\", \"in\", \"ft\" or a number of "
              "metres, not 'km'");
    EXPECT_EQ(error_after_geometry("unit = 0\n"),
              "scene.toml:2:8: unit 0 is not within 1e-9 and 1e9 metres");
    EXPECT_EQ(error_after_geometry("up = \"w\"\n"),
              "scene.toml:2:6: up must be \"x\", \"y\" or \"z\", not 'w'");
    EXPECT_EQ(error_after_geometry("default_material = \"x\"\n"),
              "scene.toml:2:20: there is no [material.'x'] in the file");
    const std::string light = "[[light]]\nposition = [0, 0, 0]\n";
    EXPECT_EQ(error_after_geometry(light + "type = \"point\"\nintensity = -1\n"),
              "scene.toml:5:13: intensity [-1, -1, -1] is negative or too large");
    EXPECT_EQ(error_after_geometry(light + "type = \"sun\"\nintensity = 1\n"),
              "scene.toml:4:8: type must be \"point\" or \"spot\", not 'sun'");
    EXPECT_EQ(error_after_geometry("[[light]]\nposition = [0, 1e13, 0]\ntype = \"point\"\n"),
              "scene.toml:3:12: position is beyond 1e+12 metres");
    EXPECT_EQ(error_after_geometry(light + "type = \"point\"\n"),
              "scene.toml:2:1: the key intensity is missing in [[light]]");
    const std::string spot = light + "type = \"spot\"\nintensity = 1\n";
    EXPECT_EQ(error_after_geometry(spot + "direction = [0, 0, 0]\n"),
              "scene.toml:6:13: direction has no length");
    EXPECT_EQ(error_after_geometry(spot + "direction = [0, 0, 1]\ninner_angle = 30\n"
                                          "outer_angle = 20\n"),
              "scene.toml:7:15: inner_angle 30 is not within 0 and 20 degrees");
    const std::string camera = "[camera]\nposition = [0, 0, 0]\ntarget = [0, 0, 1]\n";
    EXPECT_EQ(error_after_geometry(camera),
              "scene.toml:4:10: the camera looks along its up direction; give another up");
    EXPECT_EQ(error_after_geometry(camera + "up = [1, 0, 0]\nvertical_angle = 180\n"),
              "scene.toml:6:18: vertical_angle must lie between 0 and 180 degrees");
    const std::string grid =
        "[[sensors]]\norigin = [0, 0, 0]\nalong = [1, 0, 0]\nacross = [2, 0, 0]\ncolumns = 2\n";
    EXPECT_EQ(error_after_geometry(grid + "rows = 2\n"),
              "scene.toml:5:10: across is parallel to along: the grid needs a normal");
    EXPECT_EQ(error_after_geometry(grid + "rows = 0\n"),
              "scene.toml:7:8: rows 0 is not within 1 and 100000");
    EXPECT_EQ(error_after_geometry(grid + "rows = 2.0\n"),
              "scene.toml:7:8: rows must be a whole number, not the number 2");
}

TEST_F(SceneReader, RefusesDamagedFiles) {
    EXPECT_EQ(error_of("name = \"x\"\n"), "scene.toml:1:1: the key geometry is missing");
    EXPECT_EQ(error_of("geometry = \"a.step\"\n"),
              "scene.toml:1:12: geometry must be an .obj or .ply file, not 'a.step'");
    EXPECT_EQ(error_of("geometry = \"none.obj\"\n"),
              "none.obj: cannot be opened: No such file or directory");
    EXPECT_EQ(error_of("geometry = \"room.obj\"\ngeometry = 1\n").substr(0, 15), "scene.toml:2:12");
    EXPECT_EQ(error_of("geometry = \n").substr(0, 15), "scene.toml:1:12");
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    EXPECT_EQ(
        error_of("geometry = \"flat.obj\"\n"),
        "flat.obj: no surface is left: 1 face: 0 quads, 1 without area, left out; 0 quads in all");
    EXPECT_EQ(input_error_of([&] { read_scene(folder.write("a.off", "OFF\n")); }),
              "a.off: a scene is a scene file (.toml) or a geometry file (.obj, .ply); convert "
              "other formats to one of these");
}

TEST_F(SceneReader, CutsQuadsAlongWallsUnlessToldNotTo) {
    // A floor and a wall across it.
    folder.write("two.obj", square +
                                "v 80 0 0\nv 80 100 0\nv 80 100 50\nv 80 0 50\n"
                                "f 1 2 3 4\nf 5 6 7 8\n");
    for (const std::string& toml :
         {std::string("geometry = \"two.obj\"\n"),
          std::string("geometry = \"two.obj\"\ncut_along_walls = true\n")}) {
        const ReadScene read = this->read(toml);
        ASSERT_EQ(read.scene.quads.size(), 3u);
        EXPECT_EQ(read.scene.quads[0].line, 9);
        EXPECT_EQ(read.scene.quads[1].line, 9);
        EXPECT_EQ(read.scene.quads[2].line, 10);
        EXPECT_EQ(read.report.counts.elements, 3);
        EXPECT_EQ(to_string(read.report.counts),
                  "2 faces: 2 quads; 1 quad cut along walls into 2; 3 quads in all");
    }
    EXPECT_EQ(read_scene(folder / "two.obj").scene.quads.size(), 3u);
    const ReadScene whole = read("geometry = \"two.obj\"\ncut_along_walls = false\n");
    EXPECT_EQ(whole.scene.quads.size(), 2u);
    EXPECT_EQ(to_string(whole.report.counts), "2 faces: 2 quads; 2 quads in all");
    EXPECT_EQ(error_after_geometry("cut_along_walls = 1\n"),
              "scene.toml:2:19: cut_along_walls must be true or false, not the number 1");
}

TEST_F(SceneReader, ReadsLightsAndCameraFromOneFileOfTheirOwn) {
    const std::string file =
        folder.write("extras.toml",
                     "[camera]\nposition = [0, 0, 0]\ntarget = [1, 0, 0]\n"
                     "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\nintensity = 3\n");
    EXPECT_EQ(read_lights(file).size(), 1u);
    EXPECT_EQ(read_camera(file).target, Vec3::UnitX());
    const std::string none = folder.write("none.toml", "light = []\n");
    EXPECT_TRUE(read_lights(none).empty());
    EXPECT_EQ(input_error_of([&] { read_camera(none); }), "none.toml: no [camera] in the file");
    const std::string empty = folder.write("empty.toml", "");
    EXPECT_EQ(input_error_of([&] { read_lights(empty); }),
              "empty.toml: no [[light]] in the file (for none at all say light = [])");
    EXPECT_EQ(input_error_of([&] { read_lights(folder.write("a.toml", "lihgt = 1\n")); }),
              "a.toml:1:1: unknown key 'lihgt'; known here: camera, light, sensors");
}

}  // namespace
}  // namespace lightwell
