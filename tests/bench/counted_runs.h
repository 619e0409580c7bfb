#pragma once

#include <functional>
#include <string>

#include "viewer/charts/chart.h"

namespace lightwell {

/// The main function of a benchmark program: runs what is registered and prints a table with the
/// counts of each run first and its time last, since time depends on the machine and on who else
/// uses it.
///
/// @param afterwards  called at the end if anything ran: prints what follows from all runs
/// @return exit status
int run_and_count(int argc, char** argv, const std::function<void()>& afterwards = {});

/// Writes a chart as NAME.svg and NAME.csv beside the benchmark programs, and says where.
void write_chart(const std::string& name, const Chart& chart);

}  // namespace lightwell
