#pragma once

#include <string>
#include <vector>

#include "viewer/charts/chart.h"
#include "viewer/charts/chart_page.h"
#include "viewer/charts/scene_sweep.h"

namespace lightwell {

/// A chart with the name of its file and what it shows.
struct NamedChart {
    std::string name;
    Chart chart;
    std::string caption;
};

/// Everything that is drawn of a sweep.
std::vector<NamedChart> charts_of(const SceneSweep& sweep, const std::string& scene);

/// One page with all charts and tables.
/// @param made_with  by which program, how, and where: a sentence
ChartPage page_of(const SceneSweep& sweep, const std::vector<NamedChart>& charts,
                  const std::string& scene, const std::string& made_with);

}  // namespace lightwell
