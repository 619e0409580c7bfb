#include "viewer/commands/chart_command.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "viewer/charts/scene_charts.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/output.h"
#include "viewer/commands/progress_line.h"
#include "viewer/commands/scene_argument.h"

namespace lightwell {

namespace {

namespace fs = std::filesystem;

/// The folder that charts are put into. Made if it is not there, and gone again if nothing is.
class ChartFolder {
  public:
    /// @throws InputError if there is something else of that name; SystemError if it cannot be made
    /// or written to
    explicit ChartFolder(const std::string& path) : path_(path) {
        if (path.empty()) throw InputError("--output: the folder for charts has no name");
        std::error_code error, ignored;
        is_made_ = fs::create_directories(path_, error);
        if (fs::exists(path_, ignored) && !fs::is_directory(path_, ignored))
            throw InputError(Place{path}, "is not a folder");
        if (error == std::errc::not_a_directory) throw InputError(Place{path}, error.message());
        if (error)
            throw SystemError(fmt::format("{}: cannot make the folder: {}", path, error.message()));
        require_writable(file("index.html"));
    }
    ~ChartFolder() {
        std::error_code is_not_empty;
        if (is_made_) fs::remove(path_, is_not_empty);
    }
    ChartFolder(const ChartFolder&) = delete;
    ChartFolder& operator=(const ChartFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }

  private:
    fs::path path_;
    bool is_made_ = false;
};

/// A file's name, and what it holds.
using NamedText = std::pair<std::string, std::string>;

std::vector<NamedText> files_of(const SceneSweep& sweep, const std::vector<NamedChart>& charts,
                                const ChartPage& page) {
    std::vector<NamedText> files = {{"measured.csv", csv_of(sweep.settings)}};
    for (const NamedChart& one : charts) {
        files.emplace_back(one.name + ".svg", svg_of(one.chart));
        files.emplace_back(one.name + ".csv", csv_of(one.chart));
    }
    files.emplace_back("index.html", html_of(page));
    return files;
}

/// The processor's name, as far as Linux tells.
std::string processor_name() {
    const std::string key = "model name";
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind(key, 0) == 0) return line.substr(std::min(line.find(": ") + 2, line.size()));
    return "an unknown processor";
}

/// By which program, how, where and when charts were made.
std::string made_with(bool quick) {
    return fmt::format(
        "Made by lightwell " LIGHTWELL_VERSION
        " chart{}, {:%Y-%m-%d}, with {} threads on {}. Times "
        "are of this machine as it was loaded; all else means the same everywhere.",
        quick ? " --quick" : "", fmt::localtime(std::time(nullptr)),
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism),
        processor_name());
}

}  // namespace

void run_chart(const ChartRequest& request) {
    const ReadScene read = read_scene_argument(request.scene, AlbedoAboveOne::scale, request.bare);
    const std::string assumption = assumption_text(request.scene, request.bare);
    if (!assumption.empty()) print_message(assumption);
    const ChartFolder folder(request.output);
    SceneSweep sweep;
    {
        std::optional<ProgressLine> line;
        double done = 0;
        const Progress progress =
            progress_on(line, request.progress, [&done](const std::string& stage, double share) {
                return stage == "chart" ? done = share : done;
            });
        sweep = swept(read.scene, request.quick, progress);
    }
    const std::vector<NamedChart> charts = charts_of(sweep, read.scene.name);
    const std::vector<NamedText> files =
        files_of(sweep, charts, page_of(sweep, charts, read.scene.name, made_with(request.quick)));
    // All or none, as far as can be told before.
    for (const auto& [name, text] : files)
        require_writable(folder.file(name));
    for (const auto& [name, text] : files)
        write_atomically(folder.file(name), text);
    print_result(fmt::format("{}: {} charts of {} settings, to be opened with a browser\n",
                             folder.file("index.html"), charts.size(), sweep.settings.size()));
}

}  // namespace lightwell
