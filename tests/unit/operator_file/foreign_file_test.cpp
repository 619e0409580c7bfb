#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "radiance4d/failure.h"
#include "radiance4d/operator/operator_file.h"
#include "tests/scratch_folder.h"
#include "tests/unit/operator_file/sample_transport.h"

namespace lightwell::testing {

namespace {

std::string refusal(const std::string& path) {
    const auto start = std::chrono::steady_clock::now();
    std::string message = "it was believed";
    try {
        read_operator_file(path);
    } catch (const InputError& error) {
        message = error.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1)) << path;
    return message;
}

/// While it lives, no file may grow beyond some bytes: what a full disk does to a write.
class SmallDisk {
  public:
    explicit SmallDisk(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

  private:
    rlimit before_{};
};

}  // namespace

TEST(ForeignFile, IsRefusedForWhatItIs) {
    const ScratchFolder folder;
    const std::string path = folder / "thing.gto";
    const auto refusal_of = [&](const std::string& bytes) {
        put_bytes(path, bytes);
        return refusal(path);
    };
    const std::string foreign = path + ": is not an operator file of Lightwell";
    EXPECT_EQ(refusal_of(""), path + ": is empty");
    EXPECT_EQ(refusal_of("x"), foreign);
    EXPECT_EQ(refusal_of("# Blender OBJ\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"), foreign);
    EXPECT_EQ(refusal_of("\x89PNG\r\n\x1a\n" + std::string(100, '\0')), foreign);
    EXPECT_EQ(refusal_of(std::string(100000, '\0')), foreign);
    EXPECT_EQ(refusal_of("\x89GTO\n\x1a\n" + std::string(100, '\0')),
              path + ": is an operator file that was damaged in transfer");
}

TEST(ForeignFile, IsRefusedIfItIsNoFile) {
    const ScratchFolder folder;
    EXPECT_NE(refusal(folder / "none.gto").find("cannot be opened"), std::string::npos);
    EXPECT_NE(refusal(folder / "").find("is not a regular file"), std::string::npos);
    EXPECT_NE(refusal("/dev/zero").find("is not a regular file"), std::string::npos);
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(refusal(pipe).find("is not a regular file"), std::string::npos);
    EXPECT_THROW(inspect_operator_file("/dev/zero"), InputError);
}

// A terabyte of holes: nothing is read beyond the head.
TEST(ForeignFile, IsRefusedQuicklyHoweverLarge) {
    const ScratchFolder folder;
    const std::string path = folder / "holes.gto";
    write_operator_file(path, sample_transport());
    std::filesystem::resize_file(path, std::uintmax_t{1} << 40U);
    EXPECT_NE(refusal(path).find("after its end"), std::string::npos);
}

TEST(FullDisk, KeepsTheEarlierFileAndLeavesNothing) {
    const ScratchFolder folder;
    const std::string path = folder / "room.gto";
    write_operator_file(path, sample_transport());
    const std::string before = bytes_of(path);
    {
        const SmallDisk disk(before.size() / 2);
        EXPECT_THROW(write_operator_file(path, sample_transport(20)), SystemError);
        EXPECT_THROW(write_operator_file(folder / "new.gto", sample_transport()), SystemError);
    }
    EXPECT_EQ(bytes_of(path), before);
    EXPECT_EQ(folder.names().size(), 1U);
}

TEST(FullDisk, DeviceIsNoTarget) {
    EXPECT_THROW(write_operator_file("/dev/full", sample_transport()), InputError);
    EXPECT_THROW(write_operator_file("/nowhere/room.gto", sample_transport()), InputError);
}

}  // namespace lightwell::testing
