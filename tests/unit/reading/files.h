#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace lightwell::testing {

/// What the InputError says that `action` throws, with the folder of the file left out; the test
/// fails where none is thrown.
std::string input_error_of(const std::function<void()>& action);

/// The read-only material beside the checkout, or nothing where it is absent.
std::optional<std::filesystem::path> shared_folder();

}  // namespace lightwell::testing
