#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace lightwell::testing {

/// A folder of its own for a test, removed with everything in it at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Writes a file and gives its path.
    std::string write(const std::string& name, const std::string& content) const;
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

  private:
    std::filesystem::path folder_;
};

/// What the InputError says that `action` throws, with the folder of the file left out; the test
/// fails where none is thrown.
std::string input_error_of(const std::function<void()>& action);

/// The read-only material beside the checkout, or nothing where it is absent.
std::optional<std::filesystem::path> shared_folder();

}  // namespace lightwell::testing
