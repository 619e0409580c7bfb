#include "tests/unit/reading/files.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <stdlib.h>

#include "radiance4d/failure.h"

namespace lightwell::testing {

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
