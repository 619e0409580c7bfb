#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "radiance4d/operator/global_transport.h"
#include "radiance4d/scene/dimmed_light.h"

namespace lightwell {

/// The `.gto` file: a scene, its radiance space and its transport operators, enough to measure and
/// to render without anything else. Format version 1; all numbers are little-endian.
///
/// | bytes     | content                                                                       |
/// |-----------|-------------------------------------------------------------------------------|
/// | 0 .. 7    | magic 89 47 54 4F 0D 0A 1A 0A: "GTO" in bytes that a transfer as text damages |
/// | 8 .. 11   | format version, u32                                                           |
/// | 12 .. 15  | number of chunks n, u32, at most 64                                           |
/// | 16 .. 23  | size of the whole file, u64                                                   |
/// | 24 .. 31  | scene hash, u64: XXH3-64 of the content of chunk SCEN, then LOBE if any       |
/// | 32 ..     | chunk table, n entries of 32 bytes: tag (4 letters), encoding u32 (0 plain,   |
/// |           | 1 zstd), stored length u64, content length u64, XXH3-64 of the stored bytes   |
/// | 32 + 32 n | XXH3-64 of everything before, u64                                             |
/// | 40 + 32 n | the chunks, in the order of the table, without gaps, up to the end            |
///
/// A tag that starts with a small letter marks a chunk that a reader may pass over; one that
/// starts with a capital and is unknown is an error. A zstd chunk is one frame that states its
/// size, which is the content length and at most 256 times the stored length (what compresses
/// better is stored plain); so a file never makes its reader take more than that much memory.
///
/// | chunk | content (every count and index u32, text as length u32 and bytes)                  |
/// |-------|------------------------------------------------------------------------------------|
/// | SCEN  | number of materials, of quads; per material: name, reflectance and emission (3     |
/// |       | doubles each), sides that reflect, sides that emit (u8: 0 front, 1 both); per quad: |
/// |       | vertices (12 doubles [m]), material, face, line                                    |
/// | LOBE  | only where a material is glossy; per material: u8 kind (0 none, 1 Phong, 2 GGX),   |
/// |       | unless none: reflectance (3 doubles), exponent or roughness (double)               |
/// | LITE  | scene name, geometry file, up (3 doubles); number of lights, each: u8 kind (0      |
/// |       | point, 1 spot), name, position, intensity, for spots direction, inner and outer    |
/// |       | angle (doubles); u8 camera present, position, target, up, vertical angle; number of |
/// |       | sensor grids, each: name, origin, along, across, normal, columns, rows             |
/// | dimm  | only where a light of LITE, which holds them as they shine, is dimmed or off; per  |
/// |       | light: full intensity (3 doubles), dimmer (double), u8 on                          |
/// | SPAC  | number of elements, each: quad, u8 side (0 front, 1 back), u8 levels of the        |
/// |       | spatial tree, u8 levels of the angular tree, their splits (u8: 0 u, 1 v, 2 both);  |
/// |       | u8 masks present, then the open mask of every finest cell (u64)                    |
/// | CHAN  | number of distinct channels (1 to 3), then which of them red, green and blue use   |
/// | DTOI  | where the coefficients of the symmetric bounce operator stand (row <= column):     |
/// |       | columns u32, planes p u32 (1 to 4), coefficients u64, coefficients of each column  |
/// |       | u32, and the gaps between the rows of a column (row - previous row - 1, the first  |
/// |       | row itself) as p byte planes, low byte first                                       |
/// | DTOV  | their values: floats as 4 byte planes, low byte first                              |
/// | GTOI, | the same for each distinct channel of H = G - I (all rows), in the order of the    |
/// | GTOV  | channels                                                                           |
/// | PROV  | JSON: {"options": {...}, "provenance": {...}}                                      |
///
/// Equal input gives equal bytes.
///
/// Writes the file so that `path` holds all of it or what it held before (see write_atomically).
/// @param options_json  a JSON object: what the user asked for, kept with the provenance
/// @param lights        those of the transport's scene, before they are dimmed; none: they are not
/// @throws InputError or SystemError as write_atomically does; BrokenInvariant if the transport
/// holds what read_operator_file would refuse.
void write_operator_file(const std::string& path, const GlobalTransport& transport,
                         const std::string& options_json = "{}",
                         const std::vector<DimmedLight>& lights = {});

/// Reads and checks a whole file: checksums of all bytes, then every value (indices in range, rows
/// ascending, numbers finite, reflectance in [0,1], quads of elements planar and convex, ...).
/// @throws InputError that names the file, the chunk and the flaw if the file is damaged, cut
/// short, of another kind or of a newer version; SystemError if the disk fails or memory does not
/// suffice.
/// @param lights  unless null, takes the lights of the scene, before they are dimmed
GlobalTransport read_operator_file(const std::string& path,
                                   std::vector<DimmedLight>* lights = nullptr);

/// One entry of the chunk table.
struct ChunkSummary {
    std::string tag;
    bool compressed = false;
    std::uint64_t offset = 0;    ///< of the stored bytes in the file
    std::uint64_t stored = 0;    ///< bytes in the file
    std::uint64_t content = 0;   ///< bytes when unpacked
    std::uint64_t checksum = 0;  ///< XXH3-64 of the stored bytes
};

/// The chunks that write_operator_file would write, without writing them: the last one ends where
/// the file does.
/// @throws BrokenInvariant as write_operator_file
std::vector<ChunkSummary> operator_file_chunks(const GlobalTransport& transport);

/// What a file says about itself.
struct OperatorFileInfo {
    std::uint32_t version = 0;
    std::uint64_t bytes = 0;
    std::uint64_t scene_hash = 0;
    std::vector<ChunkSummary> chunks;
    Scene scene;
    std::vector<DimmedLight> lights;  ///< of the scene, before they are dimmed
    std::uint64_t elements = 0;
    std::uint64_t functions = 0;                  ///< of the radiance space
    std::uint64_t dto_coefficients = 0;           ///< each unordered pair once
    std::vector<std::uint64_t> gto_coefficients;  ///< per distinct channel
    std::array<int, 3> channel = {0, 0, 0};       ///< which of them red, green and blue use
    Provenance provenance;
    std::string options_json;  ///< as given to write_operator_file, keys in alphabetical order
};

/// Verifies the checksums of a file and reads all of it but the operators.
/// @throws as read_operator_file
OperatorFileInfo inspect_operator_file(const std::string& path);

/// XXH3-64 of the quads and materials: equal for equal scenes, whatever their lights and names.
std::uint64_t scene_hash(const Scene& scene);

}  // namespace lightwell
