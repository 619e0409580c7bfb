#include "tests/window/virtual_display.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace lightwell {

VirtualDisplay::VirtualDisplay() {
    if (!is_installed("Xvfb")) return;
    int number[2];
    if (pipe(number) != 0) return;
    server_ = fork();
    if (server_ == 0) {
        const std::string descriptor = std::to_string(number[1]);
        close(number[0]);
        execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1280x800x24",
               "-nolisten", "tcp", static_cast<char*>(nullptr));
        _exit(127);
    }
    close(number[1]);
    // It tells its number once it takes clients.
    std::string text;
    for (char c; read(number[0], &c, 1) == 1 && c != '\n';)
        text += c;
    close(number[0]);
    if (text.empty()) return;
    name_ = ":" + text;
    setenv("DISPLAY", name_.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
    if (server_ <= 0) return;
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
    unsetenv("DISPLAY");
}

bool is_installed(const std::string& program) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

std::string xdotool(const std::string& words) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(("xdotool " + words).c_str(), "r"),
                                                     pclose);
    std::string text;
    std::array<char, 256> block;
    while (pipe && fgets(block.data(), block.size(), pipe.get()))
        text += block.data();
    return text;
}

}  // namespace lightwell
