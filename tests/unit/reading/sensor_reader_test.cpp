#include "solver/reading/sensor_reader.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"
#include "tests/unit/reading/files.h"

namespace lightwell {
namespace {

using testing::input_error_of;
using testing::ScratchFolder;

std::vector<Sensor> read(const std::string& text) {
    const ScratchFolder folder;
    return read_sensors_csv(folder.write("s.csv", text));
}

std::string error_of(const std::string& text) {
    return input_error_of([&] { read(text); });
}

TEST(SensorReader, ReadsRowsWithOrWithoutAHeader) {
    for (const std::string header :
         {"", "x,y,z,nx,ny,nz\n", "# desk\n\n x, y, z, nx, ny, nz\r\n"}) {
        const auto sensors =
            read("\xef\xbb\xbf" + header + "0.5,1,2.25,0,0,2\n\n# more\n -1 , 0 ,0, 3,0,4\r\n");
        ASSERT_EQ(sensors.size(), 2u) << header;
        EXPECT_EQ(sensors[0].position, Vec3(0.5, 1, 2.25));
        EXPECT_EQ(sensors[0].normal, Vec3(0, 0, 1));
        EXPECT_EQ(sensors[1].position, Vec3(-1, 0, 0));
        EXPECT_TRUE(sensors[1].normal.isApprox(Vec3(0.6, 0, 0.8), 1e-15));
    }
}

TEST(SensorReader, NormalisesTinyAndHugeNormals) {
    EXPECT_EQ(read("0,0,0,0,1e-300,0\n")[0].normal, Vec3::UnitY());
    EXPECT_EQ(read("0,0,0,0,0,-1e300\n")[0].normal, -Vec3::UnitZ());
}

TEST(SensorReader, NamesThePlaceOfWhatIsWrong) {
    EXPECT_EQ(error_of("0,0,0,0,0,1\n0,a,0,0,0,1\n"), "s.csv:2:3: 'a' is not a number");
    EXPECT_EQ(error_of("0,0,nan,0,0,1\n"), "s.csv:1:5: 'nan' is not a finite number");
    EXPECT_EQ(error_of("0,0,-1e13,0,0,1\n"), "s.csv:1:5: z is beyond 1e+12 metres");
    EXPECT_EQ(error_of("0,0,0,0,1\n"), "s.csv:1: nz is missing; a row is x,y,z,nx,ny,nz");
    EXPECT_EQ(error_of("0,,0,0,0,1\n"), "s.csv:1:3: y is missing; a row is x,y,z,nx,ny,nz");
    EXPECT_EQ(error_of("0,0,0,0,0,1,7\n"),
              "s.csv:1:13: 7 numbers in the row; a row is x,y,z,nx,ny,nz");
    EXPECT_EQ(error_of("0,0,0, 0,0,0\n"), "s.csv:1:8: the normal has no length");
    EXPECT_EQ(error_of("0,0,0,0,0,1\nx,y,z,nx,ny,nz\n"), "s.csv:2:1: 'x' is not a number");
    EXPECT_EQ(error_of("0;0;0;0;0;1\n"), "s.csv:1:1: '0;0;0;0;0;1' is not a number");
    EXPECT_EQ(error_of("x,y,z,nx,ny,nz\n"), "s.csv: no sensors in the file");
}

}  // namespace
}  // namespace lightwell
