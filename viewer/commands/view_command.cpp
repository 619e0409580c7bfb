#include "viewer/commands/view_command.h"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "radiance4d/failure.h"

namespace lightwell {

void run_view(const std::vector<std::string>& words) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    std::vector<std::string> arguments = {(here / "lightwell-view").string()};
    arguments.insert(arguments.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    const std::error_code cause(errno, std::generic_category());
    throw SystemError(
        fmt::format("{}: the window cannot be opened: {}", arguments[0], cause.message()));
}

}  // namespace lightwell
