#include "tests/commands/program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lightwell {

namespace {

/// What comes out of a descriptor until its other end is closed; told to `heard` as it grows.
template <typename Heard>
std::string drained(int descriptor, const Heard& heard) {
    std::string text;
    char block[4096];
    for (;;) {
        const ssize_t count = read(descriptor, block, sizeof block);
        if (count < 0 && errno == EINTR) continue;
        // A terminal whose other end is closed fails instead of ending.
        if (count <= 0) break;
        text.append(block, static_cast<std::size_t>(count));
        heard(text);
    }
    close(descriptor);
    return text;
}

/// Both ends of a pipe, or of a terminal: what is written to [1] is read from [0].
std::array<int, 2> channel(bool terminal) {
    std::array<int, 2> ends{};
    if (terminal)
        EXPECT_EQ(openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr), 0);
    else
        EXPECT_EQ(pipe(ends.data()), 0);
    for (const int end : ends)
        fcntl(end, F_SETFD, FD_CLOEXEC);
    return ends;
}

/// Of this process and what it becomes.
void limit(const ProgramSetting& setting) {
    if (setting.memory_limit > 0) {
        const rlimit memory{setting.memory_limit, setting.memory_limit};
        setrlimit(RLIMIT_AS, &memory);
    }
    if (setting.limits_files) {
        const rlimit files{setting.file_limit, setting.file_limit};
        setrlimit(RLIMIT_FSIZE, &files);
    }
}

}  // namespace

ProgramRun lightwell(const std::vector<std::string>& arguments, const ProgramSetting& setting) {
    const std::array<int, 2> out = channel(false), err = channel(setting.on_terminal);
    std::vector<std::string> words = {LIGHTWELL_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t child = fork();
    if (child == 0) {
        int target = out[1];
        if (!setting.out_file.empty()) target = open(setting.out_file.c_str(), O_WRONLY);
        dup2(target, STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
        limit(setting);
        for (const auto& [name, value] : setting.environment)
            setenv(name.c_str(), value.c_str(), 1);
        execv(argv[0], argv.data());
        _exit(127);
    }
    close(out[1]);
    close(err[1]);
    ProgramRun run;
    // Sent at most once, and never to a process that was waited for: its number may be another's.
    bool is_sent = setting.signal == 0;
    const auto send = [&] {
        if (!is_sent) kill(child, setting.signal);
        is_sent = true;
    };
    std::thread reader([&] {
        run.err = drained(err[0], [&](const std::string& text) {
            if (!setting.signal_at.empty() && text.find(setting.signal_at) != std::string::npos)
                send();
        });
    });
    std::thread signaller([&] {
        if (setting.signal == 0 || !setting.signal_at.empty()) return;
        std::this_thread::sleep_for(std::chrono::duration<double>(setting.signal_after));
        send();
    });
    run.out = drained(out[0], [](const std::string&) {});
    reader.join();
    signaller.join();
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return run;
}

std::string sample_scene(const std::string& name) {
    return std::string(LIGHTWELL_SCENES) + "/" + name + "/scene.toml";
}

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string precomputed(const ScratchFolder& folder, const std::string& scene,
                        const std::string& error) {
    const std::string file = folder / "scene.gto";
    const ProgramRun run =
        lightwell({"precompute", scene, "-o", file, "--error", error, "--attempts", "0", "-q"});
    EXPECT_EQ(run.status, 0) << run.err;
    return file;
}

Table table_from(const std::string& csv) {
    std::istringstream lines(csv);
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(lines, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        names.push_back(cell);
    Table table;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        auto& row = table.emplace_back();
        for (const std::string& name : names) {
            EXPECT_TRUE(std::getline(cells, cell, ',')) << line;
            row[name] = std::stod(cell);
        }
    }
    return table;
}

}  // namespace lightwell
