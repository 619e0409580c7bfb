#include "radiance4d/operator/operator_file.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "radiance4d/atomic_file.h"
#include "radiance4d/failure.h"
#include "radiance4d/operator/byte_stream.h"
#include "radiance4d/operator/chunk_source.h"
#include "radiance4d/operator/file_flaws.h"
#include "radiance4d/operator/file_layout.h"
#include "radiance4d/operator/operator_chunks.h"
#include "radiance4d/operator/provenance_chunk.h"
#include "radiance4d/operator/scene_chunks.h"
#include "radiance4d/operator/space_chunk.h"

namespace lightwell {

namespace {

constexpr std::size_t single_chunks =
    7;  // SCEN LITE SPAC CHAN DTOI DTOV PROV, without LOBE and dimm

std::string flaw_of_channels(const std::array<int, 3>& channel, std::size_t distinct) {
    if (distinct < 1 || distinct > 3) return fmt::format("{} distinct channels", distinct);
    for (const int number : channel)
        if (number < 0 || static_cast<std::size_t>(number) >= distinct)
            return fmt::format("channel {} of {}", number, distinct);
    return {};
}

/// What read_operator_file would refuse.
std::string flaw_of(const GlobalTransport& transport, const std::vector<ElementShape>& shapes) {
    const std::uint64_t functions = transport.space.functions();
    if (std::string flaw = flaw_of_surfaces(transport.scene); !flaw.empty()) return flaw;
    if (std::string flaw = flaw_of_surroundings(transport.scene); !flaw.empty()) return flaw;
    if (std::string flaw = flaw_of_space(shapes, transport.scene); !flaw.empty()) return flaw;
    if (std::string flaw = flaw_of_channels(transport.channel, transport.indirect.size());
        !flaw.empty())
        return flaw;
    if (std::string flaw = flaw_of_operator(transport.bounce.upper, functions, true); !flaw.empty())
        return "bounce: " + flaw;
    for (const TransportOperator& channel : transport.indirect)
        if (std::string flaw = flaw_of_operator(channel, functions, false); !flaw.empty())
            return "indirect: " + flaw;
    // The file keeps the scene's quads only.
    for (std::size_t e = 0; e < shapes.size(); ++e)
        if (geometry_of(shapes[e], transport.scene).vertex !=
            transport.space.element(e).geometry.vertex)
            return fmt::format("element {} does not lie on its quad", e);
    // Nor does it keep the bases, which must follow from quads, trees and masks.
    if (space_from(shapes, transport.scene).area() != transport.space.area())
        return "an element has a basis other than its quad, tree and masks give";
    return {};
}

std::string channel_bytes(const GlobalTransport& transport) {
    ByteWriter writer;
    writer.count(transport.indirect.size());
    for (const int number : transport.channel)
        writer.count(static_cast<std::size_t>(number));
    return writer.bytes();
}

/// Does work 0 to count - 1 at once. Of several failures the first in order is thrown, so that the
/// message does not depend on which thread was faster.
template <typename Work>
void at_once(std::size_t count, const Work& work) {
    std::vector<std::exception_ptr> failures(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t n) {
        try {
            work(n);
        } catch (...) {
            failures[n] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

/// An operator file whose chunks are what this version knows.
class OperatorFileReader {
  public:
    explicit OperatorFileReader(const std::string& path) : path_(path), source_(path) {
        for (const ChunkSummary& chunk : source_.chunks())
            if (!is_known(chunk.tag)) pass_over(chunk);
        for (const char* tag : {"SCEN", "LITE", "SPAC", "CHAN", "DTOI", "DTOV", "PROV"})
            require_count(tag, 1);
    }

    const ChunkSource& source() const { return source_; }

    Scene scene() const {
        Scene scene;
        const bool glossy = source_.count("LOBE") > 0;
        const auto require_hash = [&](const ByteReader& reader) {
            reader.require_no(lightwell::scene_hash(scene) == source_.scene_hash()
                                  ? ""
                                  : "the scene hash in the head is of another scene");
        };
        decode("SCEN", 0, [&](ByteReader& reader) {
            read_surfaces(reader, scene);
            if (!glossy) require_hash(reader);
        });
        if (glossy) {
            require_count("LOBE", 1);
            decode("LOBE", 0, [&](ByteReader& reader) {
                read_lobes(reader, scene);
                require_hash(reader);
            });
        }
        decode("LITE", 0, [&](ByteReader& reader) { read_surroundings(reader, scene); });
        return scene;
    }

    /// The lights of the scene, before they are dimmed.
    std::vector<DimmedLight> lights(const Scene& scene) const {
        if (source_.count("dimm") == 0) return undimmed(scene.lights);
        require_count("dimm", 1);
        return decode("dimm", 0, [&](ByteReader& reader) { return read_dimmers(reader, scene); });
    }

    std::vector<ElementShape> shapes(const Scene& scene) const {
        return decode("SPAC", 0, [&](ByteReader& reader) { return read_space(reader, scene); });
    }

    /// Which distinct channel red, green and blue use.
    std::array<int, 3> channel() const {
        return decode("CHAN", 0, [&](ByteReader& reader) {
            const int distinct = reader.index();
            std::array<int, 3> channel = {reader.index(), reader.index(), reader.index()};
            reader.finish();
            reader.require_no(flaw_of_channels(channel, static_cast<std::size_t>(distinct)));
            require_count("GTOI", static_cast<std::size_t>(distinct));
            require_count("GTOV", static_cast<std::size_t>(distinct));
            return channel;
        });
    }

    /// The n-th operator whose chunks' tags start with `name`.
    TransportOperator transport(const std::string& name, std::size_t nth, std::uint64_t functions,
                                bool upper_half) const {
        TransportOperator result;
        const ChunkSummary& value_chunk = source_.chunk(name + "V", nth);
        std::optional<ChunkContent> values;
        at_once(2, [&](std::size_t part) {
            if (part == 0)
                result =
                    decode(name + "I", nth, [](ByteReader& reader) { return read_index(reader); });
            else
                values = source_.content(value_chunk);
        });
        ByteReader reader(values->view(), source_.place(value_chunk));
        read_values(reader, result);
        reader.require_no(flaw_of_operator(result, functions, upper_half));
        return result;
    }

    std::size_t distinct_channels() const { return source_.count("GTOI"); }

    Provenance provenance(std::string& options_json) const {
        return decode("PROV", 0,
                      [&](ByteReader& reader) { return read_provenance(reader, options_json); });
    }

  private:
    static bool is_known(const std::string& tag) {
        const auto known = {"SCEN", "LOBE", "LITE", "dimm", "SPAC", "CHAN",
                            "DTOI", "DTOV", "GTOI", "GTOV", "PROV"};
        return std::find(known.begin(), known.end(), tag) != known.end();
    }

    void pass_over(const ChunkSummary& chunk) const {
        if (chunk.tag[0] >= 'A' && chunk.tag[0] <= 'Z')
            throw InputError(
                fmt::format("{}: needs chunk {}, which this program does not know: use a newer one",
                            path_, chunk.tag));
        source_.stored(chunk);
    }

    void require_count(const char* tag, std::size_t wanted) const {
        if (source_.count(tag) != wanted)
            throw InputError(fmt::format("{}: damaged operator file: {} chunks {} instead of {}",
                                         path_, source_.count(tag), tag, wanted));
    }

    template <typename Read>
    std::invoke_result_t<Read, ByteReader&> decode(const std::string& tag, std::size_t nth,
                                                   Read read) const {
        const ChunkSummary& chunk = source_.chunk(tag, nth);
        const ChunkContent content = source_.content(chunk);
        ByteReader reader(content.view(), source_.place(chunk));
        return read(reader);
    }

    std::string path_;
    ChunkSource source_;
};

FileAssembly assembled(const GlobalTransport& transport, const std::string& options_json,
                       const std::vector<DimmedLight>& lights) {
    const std::vector<ElementShape> shapes = shapes_of(transport.space);
    std::string flaw = flaw_of(transport, shapes);
    if (flaw.empty() && !lights.empty()) flaw = flaw_of_dimmers(lights, transport.scene);
    if (!flaw.empty()) throw BrokenInvariant("a transport that cannot be written: " + flaw);

    const std::string lobes = lobes_bytes(transport.scene);
    const std::string dimmers = dimmers_bytes(lights);
    FileAssembly file(single_chunks + (lobes.empty() ? 0 : 1) + (dimmers.empty() ? 0 : 1) +
                      2 * transport.indirect.size());
    file.add("SCEN", surfaces_bytes(transport.scene));
    if (!lobes.empty()) file.add("LOBE", lobes);
    file.add("LITE", surroundings_bytes(transport.scene));
    if (!dimmers.empty()) file.add("dimm", dimmers);
    file.add("SPAC", space_bytes(shapes));
    file.add("CHAN", channel_bytes(transport));
    file.add("DTOI", index_bytes(transport.bounce.upper));
    file.add("DTOV", value_bytes(transport.bounce.upper));
    for (const TransportOperator& channel : transport.indirect) {
        file.add("GTOI", index_bytes(channel));
        file.add("GTOV", value_bytes(channel));
    }
    file.add("PROV", provenance_bytes(transport.provenance, options_json));
    return file;
}

}  // namespace

void write_operator_file(const std::string& path, const GlobalTransport& transport,
                         const std::string& options_json, const std::vector<DimmedLight>& lights) {
    FileAssembly file = assembled(transport, options_json, lights);
    write_atomically(path, file.finished(scene_hash(transport.scene)));
}

std::vector<ChunkSummary> operator_file_chunks(const GlobalTransport& transport) {
    return assembled(transport, "{}", {}).table();
}

GlobalTransport read_operator_file(const std::string& path, std::vector<DimmedLight>* lights) {
    try {
        const OperatorFileReader file(path);
        GlobalTransport transport;
        transport.scene = file.scene();
        // Read where nobody wants them, too: they may be damaged.
        const std::vector<DimmedLight> undimmed = file.lights(transport.scene);
        if (lights) *lights = undimmed;
        const std::vector<ElementShape> shapes = file.shapes(transport.scene);
        const std::uint64_t functions = functions_of(shapes);
        transport.channel = file.channel();
        // The operators come before the space: their columns, which take bytes in the file, bound
        // the functions that the trees announce.
        transport.indirect.resize(file.distinct_channels());
        at_once(1 + file.distinct_channels(), [&](std::size_t n) {
            if (n == 0)
                transport.bounce.upper = file.transport("DTO", 0, functions, true);
            else
                transport.indirect[n - 1] = file.transport("GTO", n - 1, functions, false);
        });
        transport.space = space_from(shapes, transport.scene);
        if (has_angles(transport.space))
            transport.reflection = Reflection(transport.scene, transport.space);
        std::string options_json;
        transport.provenance = file.provenance(options_json);
        return transport;
    } catch (const std::bad_alloc&) {
        throw SystemError(path + ": not enough memory to read it");
    }
}

OperatorFileInfo inspect_operator_file(const std::string& path) {
    const OperatorFileReader file(path);
    const ChunkSource& source = file.source();
    for (const ChunkSummary& chunk : source.chunks())
        source.stored(chunk);

    OperatorFileInfo info;
    info.version = source.version();
    info.bytes = source.bytes();
    info.scene_hash = source.scene_hash();
    info.chunks = source.chunks();
    info.scene = file.scene();
    info.lights = file.lights(info.scene);
    const std::vector<ElementShape> shapes = file.shapes(info.scene);
    info.elements = shapes.size();
    info.functions = functions_of(shapes);
    info.channel = file.channel();
    info.dto_coefficients = source.chunk("DTOV").content / sizeof(float);
    for (std::size_t n = 0; n < file.distinct_channels(); ++n)
        info.gto_coefficients.push_back(source.chunk("GTOV", n).content / sizeof(float));
    info.provenance = file.provenance(info.options_json);
    return info;
}

std::uint64_t scene_hash(const Scene& scene) {
    return checksum_of(surfaces_bytes(scene) + lobes_bytes(scene));
}

}  // namespace lightwell
