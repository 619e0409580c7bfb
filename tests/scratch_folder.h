#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace lightwell::testing {

/// A folder of its own for a test, removed with everything in it at the end.
class ScratchFolder {
  public:
    ScratchFolder() {
        // A space and letters beyond ASCII: names that real users' folders have.
        std::string name =
            (std::filesystem::temp_directory_path() / "lightwell t\xc3\xa9st XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    /// Path of a file in it, whether it exists or not.
    std::string operator/(const std::string& name) const { return (folder_ / name).string(); }
    std::string path() const { return folder_.string(); }
    /// Writes a file. @return its path.
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return *this / name;
    }
    /// Names of all that lies in it, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

  private:
    std::filesystem::path folder_;
};

}  // namespace lightwell::testing
