#include "solver/tightening.h"

#include <cmath>

namespace lightwell {

std::optional<Settings> tighter_settings(const Settings& settings, double missed,
                                         const std::array<Tighten, 2>& ways, const MemoryOf& memory,
                                         double allowed) {
    // Steps as of errors that are missed by the root of it, and the root of that: a smaller one is
    // hardly worth an operator.
    constexpr int smaller_steps = 2;
    double step = missed;
    for (int k = 0; k <= smaller_steps; ++k, step = std::sqrt(step)) {
        for (const Tighten& tighten : ways) {
            Settings tighter = settings;
            tighten(step, tighter);
            if (!(tighter == settings) && memory(tighter) <= allowed) return tighter;
        }
    }
    return std::nullopt;
}

double memory_for_links(std::uint64_t links, const Settings& settings, const Settings& tighter) {
    // Measured: 40 to 51 bytes a link where there are many (boxes, an office, a maze), which
    // multiply as the tolerance to the power of -0.4 to -0.7, and at most as the cells.
    constexpr double bytes_a_link = 55, growth = 0.7;
    return bytes_a_link * static_cast<double>(links) *
           std::pow(settings.oracle_tolerance / tighter.oracle_tolerance, growth) *
           std::pow(settings.cell_size / tighter.cell_size, 2);
}

}  // namespace lightwell
