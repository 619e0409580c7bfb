#include "tests/unit/reading/files.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "radiance4d/failure.h"

namespace lightwell::testing {

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lightwell-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
    std::ofstream file(folder_ / name, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw std::runtime_error("cannot write " + name);
    return path(name);
}

std::string input_error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        std::string message = error.what();
        const std::string temporary = std::filesystem::temp_directory_path().string();
        if (message.rfind(temporary, 0) == 0) {
            const std::size_t folder_end = message.find('/', temporary.size() + 1);
            message.erase(0, folder_end + 1);
        }
        return message;
    }
    ADD_FAILURE() << "no InputError";
    return "";
}

std::optional<std::filesystem::path> shared_folder() {
    const char* chosen = std::getenv("LIGHTWELL_SHARED");
    const std::filesystem::path folder = chosen != nullptr ? chosen : LIGHTWELL_SHARED;
    if (!std::filesystem::is_directory(folder)) return std::nullopt;
    return folder;
}

}  // namespace lightwell::testing
