#pragma once

#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace lightwell {

/// Path of a file of the read-only reference folder, which lies outside the project: named by the
/// environment variable LIGHTWELL_SHARED, else where it was when the tests were configured.
inline std::string shared_path(const std::string& file) {
    const char* folder = std::getenv("LIGHTWELL_SHARED");
    return std::string(folder != nullptr ? folder : LIGHTWELL_SHARED_DEFAULT) + "/" + file;
}

/// The reference file as JSON, or nothing if the folder is not there: the test then skips.
inline std::optional<nlohmann::json> shared_json(const std::string& file) {
    std::ifstream stream(shared_path(file));
    if (!stream) return std::nullopt;
    return nlohmann::json::parse(stream);
}

}  // namespace lightwell

/// Declares `name` as the JSON of a reference file, or skips the test and says which file is
/// missing.
#define LIGHTWELL_SHARED_JSON(name, file)                                      \
    const auto name##_file = ::lightwell::shared_json(file);                   \
    if (!name##_file) GTEST_SKIP() << "no " << ::lightwell::shared_path(file); \
    const nlohmann::json& name = *name##_file
