#pragma once

#include <cstdint>
#include <string>

#include "radiance4d/operator/global_transport.h"

namespace lightwell::testing {

/// A transport with something of everything: five quads with both sides and trees of different
/// depth, spatial and angular; every kind of light, a camera, sensor grids, two distinct channels.
/// Its operators are random: up to `per_column` coefficients in every column.
GlobalTransport sample_transport(std::uint32_t per_column = 4);

/// A random operator of ascending rows; with `upper_half`, none below the diagonal. Values spread
/// over many magnitudes.
TransportOperator random_operator(std::uint32_t size, std::uint32_t per_column, bool upper_half,
                                  std::uint32_t seed);

/// Everything of a transport that the file holds, bit by bit, as text to compare.
std::string fingerprint(const GlobalTransport& transport);

std::string bytes_of(const std::string& path);
void put_bytes(const std::string& path, const std::string& bytes);

}  // namespace lightwell::testing
