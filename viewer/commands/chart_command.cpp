#include "viewer/commands/chart_command.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

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

void require_folder(const std::string& path) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!fs::is_directory(path))
        throw InputError(Place{path}, error ? error.message() : "is not a folder");
    require_writable((fs::path(path) / "index.html").string());
}

}  // namespace

void run_chart(const ChartRequest& request) {
    const ReadScene read = read_scene_argument(request.scene, AlbedoAboveOne::scale, request.bare);
    const std::string assumption = assumption_text(request.scene, request.bare);
    if (!assumption.empty()) print_message(assumption);
    require_folder(request.output);
    const fs::path folder = request.output;
    SweepOptions options;
    options.quick = request.quick;
    options.scratch = (folder / "operator.gto").string();
    SceneSweep sweep;
    {
        std::optional<ProgressLine> line;
        double done = 0;
        const Progress progress =
            progress_on(line, request.progress, [&done](const std::string& stage, double share) {
                return stage == "chart" ? done = share : done;
            });
        sweep = swept(read.scene, options, progress);
    }
    const std::string& name = read.scene.name;
    const std::vector<NamedChart> charts = charts_of(sweep, name);
    write_atomically((folder / "measured.csv").string(), csv_of(sweep.settings));
    for (const NamedChart& one : charts) {
        write_atomically((folder / (one.name + ".svg")).string(), svg_of(one.chart));
        write_atomically((folder / (one.name + ".csv")).string(), csv_of(one.chart));
    }
    write_atomically((folder / "index.html").string(), html_of(page_of(sweep, charts, name)));
    print_result(fmt::format("{}: {} charts of {} settings, to be opened with a browser\n",
                             (folder / "index.html").string(), charts.size(),
                             sweep.settings.size()));
}

}  // namespace lightwell
