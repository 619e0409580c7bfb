// What the world does to programs: full disks, little memory, sudden death, foreign locales, files
// from other systems. A clear message, the right status, no half file, earlier results intact.
#include <cstdlib>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>
#include <signal.h>

#include "tests/commands/program.h"

namespace lightwell {
namespace {

using Words = std::vector<std::string>;

Words quick_work(const std::string& output, const std::string& error = "0.1") {
    return {"precompute", sample_scene("corner"), "-o", output, "--error",
            error,        "--attempts",           "0",  "-q"};
}

void expect_clear_message(const ProgramRun& run, int status, const std::string& part) {
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.err.rfind("lightwell: ", 0), 0U) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
}

TEST(Faults, AFullDiskKeepsWhatWasThereAndLeavesNothing) {
    const ScratchFolder folder;
    const std::string output = folder / "x.gto";
    ASSERT_EQ(lightwell(quick_work(output)).status, 0);
    const std::string before = contents(output);
    const std::string sensors = folder.write("s.csv", "1,1,0,0,0,1\n");
    ProgramSetting setting;
    setting.limits_files = true;
    for (const std::uint64_t room : {std::uint64_t{1000}, before.size() / 2, std::uint64_t{0}}) {
        setting.file_limit = room;
        expect_clear_message(lightwell(quick_work(output), setting), 2, output);
    }
    expect_clear_message(
        lightwell({"render", output, "-o", folder / "x.png", "--size", "64x48"}, setting), 2,
        "x.png");
    expect_clear_message(
        lightwell({"measure", output, "--sensors", sensors, "-o", folder / "x.csv"}, setting), 2,
        "x.csv");
    EXPECT_EQ(contents(output), before);
    EXPECT_EQ(folder.names(), (Words{"s.csv", "x.gto"}));
}

TEST(Faults, NamesAreTakenUpToTheirLimitAndRefusedBeyondItBeforeTheWork) {
    const ScratchFolder folder;
    const std::string longest = folder / (std::string(251, 'x') + ".gto");
    EXPECT_EQ(lightwell(quick_work(longest)).status, 0);
    EXPECT_EQ(folder.names().size(), 1U);
    const ProgramRun refused =
        lightwell({"precompute", folder / "none.toml", "-o", folder / std::string(300, 'x')});
    expect_clear_message(refused, 1, "too long");
    expect_clear_message(lightwell(quick_work("")), 1, "no name");
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST(Faults, WhatIsReadIsNotReplaced) {
    const ScratchFolder folder;
    const std::string mtl = folder.write("white.mtl", "newmtl white\nKd 0.7 0.7 0.7\n");
    const std::string room =
        folder.write("room.obj",
                     "mtllib white.mtl\nusemtl white\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
                     "v 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\nf 1 2 3 4\nf 5 8 7 6\n"
                     "f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    const std::string scene = folder.write("room.toml",
                                           "geometry = \"room.obj\"\n[[light]]\ntype = \"point\"\n"
                                           "position = [1, 1, 1]\nintensity = 10\nname = \"l\"\n");
    const std::string lights = folder.write(
        "lights.toml",
        "[[light]]\ntype = \"point\"\nposition = [1, 1, 1]\nintensity = 10\nname = \"l\"\n");
    const std::string sensors = folder.write("sensors.csv", "1,1,0,0,0,1\n");
    const std::string file = folder / "room.gto", other_name = folder / "./room.gto";
    const auto precompute = [&](const std::string& output) {
        return lightwell({"precompute", scene, "-o", output, "--error", "0.5", "--attempts", "0"});
    };
    for (const std::string& output : {scene, room, mtl}) {
        const std::string before = contents(output);
        expect_clear_message(precompute(output), 1, "read by this very command");
        EXPECT_EQ(contents(output), before);
    }
    ASSERT_EQ(precompute(file).status, 0);
    for (const std::string& output : {file, other_name, sensors, lights}) {
        const std::string before = contents(output);
        expect_clear_message(
            lightwell({"measure", file, "--sensors", sensors, "--lights", lights, "-o", output}), 1,
            "read by this very command");
        EXPECT_EQ(contents(output), before);
    }
}

// The limit is that of the process, as a batch system sets it: whatever does not fit is told.
TEST(Faults, LittleMemoryIsToldAndKeepsWhatWasThere) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer itself takes terabytes of address space";
#endif
    const ScratchFolder folder;
    const std::string output = folder.write("x.gto", "precious");
    int refused = 0;
    for (const std::uint64_t mebibytes : {320, 400, 480, 640}) {
        ProgramSetting setting;
        setting.memory_limit = mebibytes << 20U;
        const ProgramRun run =
            lightwell({"precompute", sample_scene("office"), "-o", output, "--error", "0.01",
                       "--attempts", "0", "-q", "--threads", "1"},
                      setting);
        if (run.status != 0) {
            expect_clear_message(run, 2, "memory");
            EXPECT_EQ(contents(output), "precious");
            EXPECT_EQ(folder.names(), Words{"x.gto"});
            ++refused;
        }
    }
    EXPECT_GT(refused, 0) << "no limit was small enough to test anything";
}

/// How often the program is killed: LIGHTWELL_KILLS says, for a night's run.
int kills() {
    const char* text = std::getenv("LIGHTWELL_KILLS");
    return text != nullptr ? std::atoi(text) : 12;
}

TEST(Faults, KilledAtAnyMomentTheFileIsTheOldOrTheNewOne) {
    const ScratchFolder folder;
    const std::string output = folder / "x.gto", other = folder / "y.gto";
    ASSERT_EQ(lightwell(quick_work(output, "0.3")).status, 0);
    ASSERT_EQ(lightwell(quick_work(other, "0.2")).status, 0);
    const std::string old_file = contents(output), new_file = contents(other);
    ASSERT_NE(old_file, new_file);
    std::filesystem::remove(other);
    std::mt19937 random(2006);
    std::uniform_real_distribution<double> moment(0, 0.25);
    int finished = 0;
    for (int k = 0; k < kills(); ++k) {
        ProgramSetting setting;
        setting.signal = SIGKILL;
        setting.signal_after = moment(random);
        const ProgramRun run = lightwell(quick_work(output, "0.2"), setting);
        EXPECT_TRUE(run.status == 0 || run.status == 128 + SIGKILL) << run.err;
        const std::string now = contents(output);
        if (run.status == 0) {
            ++finished;
            EXPECT_EQ(now, new_file);
        } else {
            EXPECT_TRUE(now == old_file || now == new_file) << "a file that nobody wrote";
        }
        EXPECT_EQ(folder.names(), Words{"x.gto"}) << "a part of a file was left";
        folder.write("x.gto", old_file);
    }
    RecordProperty("finished", finished);
    ASSERT_EQ(lightwell(quick_work(output, "0.2")).status, 0);
    EXPECT_EQ(contents(output), new_file);
}

TEST(Faults, ADamagedFileIsNeverBelieved) {
    // In this process every byte of a small file is damaged in turn, see the tests of the file;
    // here the program itself meets a few of these in a file of its own making.
    const ScratchFolder folder;
    const std::string sound = folder / "x.gto", bad = folder / "bad.gto";
    ASSERT_EQ(lightwell(quick_work(sound, "0.3")).status, 0);
    const std::string bytes = contents(sound);
    std::mt19937 random(5000);
    for (int k = 0; k < 25; ++k) {
        std::string damaged = bytes;
        const std::size_t at = random() % bytes.size();
        damaged[at] = static_cast<char>(damaged[at] ^ (1U << random() % 8));
        if (k % 5 == 0) damaged.resize(at);
        folder.write("bad.gto", damaged);
        for (const Words& command : {Words{"info", bad}, Words{"measure", bad, "--grid", "x"},
                                     Words{"render", bad, "-o", folder / "x.png"}})
            expect_clear_message(lightwell(command), 1, bad);
    }
    EXPECT_EQ(folder.names(), (Words{"bad.gto", "x.gto"}));
}

/// A room as a user's files describe it.
struct UserFiles {
    std::string obj =
        "# a room\nmtllib room.mtl\nv 0 0 0\nv 4.5 0 0\nv 4.5 3.25 0\nv 0 3.25 0\nv 0 0 2.75\n"
        "v 4.5 0 2.75\nv 4.5 3.25 2.75\nv 0 3.25 2.75\nusemtl w\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\n"
        "f 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n";
    std::string mtl = "newmtl w\nKd 0.5 0.25 0.75\n";
    std::string toml =
        "geometry = \"room.obj\"\n[[light]]\nname = \"l\"\ntype = \"point\"\n"
        "position = [1.25, 1.5, 2.0]\nintensity = 1000.5\n";
    std::string lights =
        "[[light]]\nname = \"l\"\ntype = \"point\"\nposition = [3.25, 1.5, 1.5]\nintensity = "
        "99.5\n";
    std::string camera = "[camera]\nposition = [0.5, 0.5, 1.5]\ntarget = [4.0, 3.0, 0.5]\n";
    std::string sensors = "x,y,z,nx,ny,nz\n1.5,1.25,0,0,0,1\n2.5,0.75,0.85,0,0,1\n";
};

/// Everything the command line makes of them: the operator's bytes, what is measured, a picture.
std::string made_of(const ScratchFolder& folder, const UserFiles& files,
                    const ProgramSetting& setting = {}) {
    folder.write("room.obj", files.obj);
    folder.write("room.mtl", files.mtl);
    const std::string scene = folder.write("room.toml", files.toml);
    const std::string lights = folder.write("l.toml", files.lights);
    const std::string camera = folder.write("c.toml", files.camera);
    const std::string sensors = folder.write("s.csv", files.sensors);
    const std::string gto = folder / "room.gto", png = folder / "room.png";
    std::string all;
    const auto run = [&](const Words& words) {
        const ProgramRun done = lightwell(words, setting);
        EXPECT_EQ(done.status, 0) << words[0] << ": " << done.err;
        all += done.out;
    };
    run({"precompute", scene, "-o", gto, "--error", "0.25", "--attempts", "0", "-q"});
    run({"measure", gto, "--sensors", sensors, "--lights", lights});
    run({"render", gto, "-o", png, "--camera", camera, "--size", "40x30"});
    run({"info", scene});
    return all + contents(gto) + contents(png);
}

std::string with_crlf(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '\n' ? std::string("\r\n") : std::string(1, c);
    return result;
}

TEST(Faults, FilesFromOtherSystemsMeanTheSame) {
    const ScratchFolder folder;
    const std::string plain = made_of(folder, {});
    ASSERT_GT(plain.size(), 1000U);
    UserFiles windows;
    for (std::string* file : {&windows.obj, &windows.mtl, &windows.toml, &windows.lights,
                              &windows.camera, &windows.sensors})
        *file = "\xef\xbb\xbf" + with_crlf(*file);
    EXPECT_TRUE(made_of(folder, windows) == plain) << "CRLF and a byte order mark";
}

TEST(Faults, AGermanLocaleChangesNothing) {
    const ScratchFolder files, folder;
    const std::string plain = made_of(files, {});
    ProgramSetting setting;
    for (const char* variable : {"LC_ALL", "LANG", "LC_NUMERIC"})
        setting.environment.emplace_back(variable, "de_DE.UTF-8");
    // A locale of our own making where the system has none of that name.
    const std::string make =
        "localedef -i de_DE -f UTF-8 '" + folder.path() + "/de_DE.UTF-8' >/dev/null 2>&1";
    if (std::system(make.c_str()) == 0) setting.environment.emplace_back("LOCPATH", folder.path());
    EXPECT_TRUE(made_of(files, {}, setting) == plain);
}

}  // namespace
}  // namespace lightwell
