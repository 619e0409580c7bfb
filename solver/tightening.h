#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "solver/settings.h"

namespace lightwell {

/// Makes settings tighter after an operator came out `missed` times as wrong as asked; missed >= 1.
using Tighten = std::function<void(double missed, Settings&)>;

/// Memory [bytes] to compute an operator with given settings.
using MemoryOf = std::function<double(const Settings&)>;

/// What the first of two ways makes of settings, or, where that changes nothing or does not fit
/// into memory, the second; where neither fits, smaller steps of both; none where these do not fit
/// either.
///
/// @param allowed  memory [bytes]
std::optional<Settings> tighter_settings(const Settings& settings, double missed,
                                         const std::array<Tighten, 2>& ways, const MemoryOf& memory,
                                         double allowed);

/// Memory [bytes] to compute a diffuse operator of tighter settings than one that came to so many
/// links.
double memory_for_links(std::uint64_t links, const Settings& settings, const Settings& tighter);

}  // namespace lightwell
