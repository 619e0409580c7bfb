#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/scratch_folder.h"

namespace lightwell {

/// What a run of the lightwell program left.
struct ProgramRun {
    int status = -1;  ///< exit status; 128 + n if signal n ended it
    std::string out;  ///< standard output
    std::string err;  ///< standard error
};

/// How to run it.
struct ProgramSetting {
    int signal = 0;                  ///< to send, 0: none
    double signal_after = 0;         ///< when [s]
    std::string signal_at;           ///< or, if not empty, once standard error holds this text
    bool on_terminal = false;        ///< standard error is a terminal
    std::string out_file = "";       ///< where standard output goes instead
    std::uint64_t memory_limit = 0;  ///< of the address space [bytes], 0: none
    bool limits_files = false;       ///< whether no file may grow beyond ...
    std::uint64_t file_limit = 0;    ///< ... so much [bytes], as if the disk were full
    std::vector<std::pair<std::string, std::string>> environment;  ///< variables to set
};

/// Runs the program and waits for its end.
ProgramRun lightwell(const std::vector<std::string>& arguments, const ProgramSetting& setting = {});

/// A scene of the project by its folder's name.
std::string sample_scene(const std::string& name);

using testing::ScratchFolder;

std::string contents(const std::string& path);

/// Precomputes a scene, without judging the result, and expects it to go well. @return the path of
/// the operator, in `folder`.
std::string precomputed(const ScratchFolder& folder, const std::string& scene,
                        const std::string& error = "0.3");

/// Rows of numbers under a CSV header, by the column's name.
using Table = std::vector<std::map<std::string, double>>;
Table table_from(const std::string& csv);

}  // namespace lightwell
