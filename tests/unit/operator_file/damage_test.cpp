#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "radiance4d/failure.h"
#include "radiance4d/operator/chunk_source.h"
#include "radiance4d/operator/file_layout.h"
#include "radiance4d/operator/operator_file.h"
#include "tests/scratch_folder.h"
#include "tests/unit/operator_file/forgery.h"
#include "tests/unit/operator_file/sample_transport.h"

namespace lightwell::testing {

namespace {

class Damage : public ::testing::Test {
  protected:
    void SetUp() override {
        write_operator_file(good_, sample_transport());
        bytes_ = bytes_of(good_);
    }

    /// The message with which the bad file is refused.
    std::string refusal() const {
        try {
            read_operator_file(bad_);
        } catch (const InputError& error) {
            return error.what();
        }
        return "it was believed";
    }

    std::string refusal_of(const std::string& bytes) const {
        put_bytes(bad_, bytes);
        return refusal();
    }

    /// The message about a file with one chunk forged.
    template <typename Change>
    std::string refusal_with(const std::string& wanted, const Change& change) const {
        forge(good_, bad_, [&](std::string& tag, std::string& content) {
            if (tag == wanted) change(content);
        });
        return refusal();
    }

    /// As above, with a number put somewhere into the content.
    template <typename Number>
    std::string refusal_with(const std::string& tag, std::size_t offset, Number number) const {
        return refusal_with(tag, [&](std::string& content) {
            ASSERT_LE(offset + sizeof(Number), content.size());
            std::memcpy(content.data() + offset, &number, sizeof(Number));
        });
    }

    ScratchFolder folder_;
    std::string good_ = folder_ / "good.gto";
    std::string bad_ = folder_ / "bad.gto";
    std::string bytes_;
};

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_F(Damage, OfAnyByteIsNoticed) {
    put_bytes(bad_, bytes_);
    std::fstream file(bad_, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](std::size_t at, int byte) {
        file.seekp(static_cast<std::streamoff>(at));
        file.put(static_cast<char>(byte));
        file.flush();
    };
    for (std::size_t k = 0; k < bytes_.size(); ++k) {
        for (const int flip : {0x01, 0x80, 0xff}) {
            put(k, bytes_[k] ^ flip);
            const std::string message = refusal();
            ASSERT_EQ(message.rfind(bad_ + ": ", 0), 0U) << "byte " << k << ": " << message;
            ASSERT_THROW(inspect_operator_file(bad_), InputError) << "byte " << k;
        }
        put(k, bytes_[k]);
    }
    EXPECT_EQ(refusal(), "it was believed") << "the undamaged file";
}

TEST_F(Damage, ByCuttingAnywhereIsNoticed) {
    put_bytes(bad_, bytes_);
    for (std::size_t size = bytes_.size(); size-- > 0;) {
        std::filesystem::resize_file(bad_, size);
        const std::string message = refusal();
        ASSERT_TRUE(contains(message, "cut short") || contains(message, "is empty")) << message;
    }
}

TEST_F(Damage, ByAppendingIsNoticed) {
    EXPECT_TRUE(contains(refusal_of(bytes_ + '\0'), "has 1 bytes after its end"));
    EXPECT_TRUE(contains(refusal_of(bytes_ + bytes_), "after its end"));
}

// Chunks are read at once; what is said must not depend on which thread was faster.
TEST_F(Damage, InManyPlacesIsToldOfTheFirst) {
    std::string damaged = bytes_;
    for (const ChunkSummary& chunk : inspect_operator_file(good_).chunks)
        if (chunk.tag.substr(0, 3) == "DTO" || chunk.tag.substr(0, 3) == "GTO")
            damaged[chunk.offset + chunk.stored / 2] ^= 1;
    for (int k = 0; k < 200; ++k)
        ASSERT_TRUE(contains(refusal_of(damaged), "chunk DTOI")) << refusal();
}

// The lobes of the sample's two materials: none, one byte, then Phong's: its kind, three
// reflectances, the exponent.
TEST_F(Damage, OfLobesIsNamed) {
    GlobalTransport glossy = sample_transport();
    glossy.scene.materials[1].lobe = PhongLobe{Rgb::Constant(0.5), 10};
    write_operator_file(good_, glossy);
    EXPECT_TRUE(contains(refusal_with("LOBE", 1, std::uint8_t{3}), "LOBE")) << refusal();
    EXPECT_TRUE(contains(refusal_with("LOBE", 2, 1.5), "its lobe is not in [0,1]")) << refusal();
    EXPECT_TRUE(contains(refusal_with("LOBE", 26, -1.0), "exponent")) << refusal();
    EXPECT_TRUE(contains(refusal_with("LOBE", 26, 11.0), "another scene")) << refusal();
    EXPECT_TRUE(contains(refusal_with("LOBE", [](auto& content) { content.pop_back(); }), "LOBE"));
    EXPECT_TRUE(contains(refusal_with("LOBE", [](auto& content) { content += '\0'; }), "LOBE"));
}

TEST_F(Damage, ByTextTransferIsNamed) {
    std::string damaged = bytes_;
    damaged.erase(4, 1);
    EXPECT_TRUE(contains(refusal_of(damaged), "damaged in transfer"));
}

TEST_F(Damage, NamesTheChunkAndWhereItLies) {
    const ChunkSummary values = inspect_operator_file(good_).chunks.at(7);
    std::string damaged = bytes_;
    damaged[values.offset + 5] ^= 1;
    const std::string place = "chunk GTOV (bytes " + std::to_string(values.offset) + " to " +
                              std::to_string(values.offset + values.stored) + ")";
    EXPECT_TRUE(contains(refusal_of(damaged), place)) << refusal();
}

TEST_F(Damage, NewerVersionIsNamed) {
    std::string newer = bytes_;
    newer[8] = 2;
    EXPECT_TRUE(contains(refusal_of(with_valid_head(newer)), "format version 2"));
}

TEST_F(Damage, UnknownChunksArePassedOverOnlyIfOptional) {
    const auto with_chunk = [&](const std::string& tag) {
        const ChunkSource good(good_);
        FileAssembly file(good.chunks().size() + 1);
        for (const ChunkSummary& chunk : good.chunks())
            file.add(chunk.tag, good.content(chunk).view());
        file.add(tag, "from the future");
        put_bytes(bad_, file.finished(good.scene_hash()));
    };
    with_chunk("glos");
    EXPECT_EQ(fingerprint(read_operator_file(bad_)), fingerprint(read_operator_file(good_)));
    EXPECT_EQ(inspect_operator_file(bad_).chunks.size(), 12U);
    std::string damaged = bytes_of(bad_);
    damaged.back() ^= 1;
    EXPECT_TRUE(contains(refusal_of(damaged), "chunk glos"));
    with_chunk("Glos");
    EXPECT_TRUE(contains(refusal(), "needs chunk Glos"));
    with_chunk("SCEN");
    EXPECT_TRUE(contains(refusal(), "2 chunks SCEN"));
}

// A table that claims lengths which the file cannot hold, its checksum right.
TEST_F(Damage, ImpossibleLengthsTakeNoMemory) {
    const auto claiming = [&](std::size_t entry, std::uint32_t encoding, std::uint64_t stored,
                              std::uint64_t content) {
        std::string forged = bytes_;
        char* at = forged.data() + table_offset + entry * table_entry_bytes;
        std::memcpy(at + 4, &encoding, 4);
        std::memcpy(at + 8, &stored, 8);
        std::memcpy(at + 16, &content, 8);
        return refusal_of(with_valid_head(forged));
    };
    const std::uint64_t huge = ~std::uint64_t{0};
    const std::uint64_t size = inspect_operator_file(good_).chunks[0].stored;
    EXPECT_TRUE(contains(claiming(0, 0, huge, huge), "reaches beyond the file"));
    EXPECT_TRUE(contains(claiming(0, 1, size, huge), "claims to grow"));
    EXPECT_TRUE(contains(claiming(0, 1, size, 257 * size), "claims to grow"));
    EXPECT_TRUE(contains(claiming(0, 1, size, 255 * size), "does not unpack"));
    EXPECT_TRUE(contains(claiming(0, 0, size - 1, size - 1), "do not fill the file"));
    EXPECT_TRUE(contains(claiming(0, 2, size, size), "encoding 2"));
}

TEST_F(Damage, CountsBeyondTheContentTakeNoMemory) {
    const std::uint32_t huge = ~std::uint32_t{0};
    EXPECT_TRUE(contains(refusal_with("SCEN", 0, huge), "4294967295 entries are announced"));
    EXPECT_TRUE(contains(refusal_with("SCEN", 4, huge), "4294967295 entries are announced"));
    EXPECT_TRUE(contains(refusal_with("LITE", 0, huge), "entries are announced"));
    EXPECT_TRUE(contains(refusal_with("SPAC", 0, huge), "entries are announced"));
    EXPECT_TRUE(contains(refusal_with("DTOI", 0, huge), "bytes are needed"));
    EXPECT_TRUE(contains(refusal_with("DTOI", 8, ~std::uint64_t{0}), "coefficients are announced"));
    EXPECT_TRUE(contains(refusal_with("DTOI", 4, std::uint32_t{0}), "0 byte planes"));
    EXPECT_TRUE(contains(refusal_with("DTOI", 16, huge), "do not add up"));
    EXPECT_TRUE(contains(refusal_with("CHAN", 0, huge), "is no index"));
    EXPECT_TRUE(contains(refusal_with("CHAN", 0, std::uint32_t{3}), "2 chunks GTOI instead of 3"));
}

// Two trees of 2^28 functions would take gigabytes: the operators in the file are smaller.
TEST_F(Damage, DeepTreesTakeNoMemory) {
    const auto deep = [](int levels) {
        const auto most = static_cast<char>(levels);
        return std::string("\1\0\0\0\0\0\0\0\0", 9) + most + '\0' +
               std::string(static_cast<std::size_t>(levels), '\2') + '\0';
    };
    EXPECT_TRUE(contains(refusal_with("SPAC", [&](std::string& c) { c = deep(14); }),
                         "over 268435456 basis functions"));
    EXPECT_TRUE(contains(refusal_with("SPAC", [&](std::string& c) { c = deep(15); }),
                         "more than 2^28 functions"));
    EXPECT_TRUE(contains(refusal_with("SPAC", [&](std::string& c) { c = deep(29); }),
                         "29 stands where at most 28 may"));
}

TEST_F(Damage, ImpossibleSurfacesAreRefused) {
    const std::size_t reflectance = 8 + 4 + 5;  // counts, name "paint"
    const std::size_t quads = 8 + (4 + 5 + 50) + (4 + 7 + 50);
    EXPECT_TRUE(contains(refusal_with("SCEN", reflectance, 1.5), "material 0: its reflectance"));
    EXPECT_TRUE(contains(refusal_with("SCEN", reflectance, std::nan("")), "its reflectance"));
    EXPECT_TRUE(contains(refusal_with("SCEN", reflectance + 24, -1.0), "its emission"));
    EXPECT_TRUE(contains(refusal_with("SCEN", reflectance + 48, '\2'), "2 stands where"));
    EXPECT_TRUE(contains(refusal_with("SCEN", quads, double{INFINITY}), "vertex is not finite"));
    EXPECT_TRUE(contains(refusal_with("SCEN", quads + 96, 2), "quad 0: material 2 of 2"));
    EXPECT_TRUE(contains(refusal_with("SCEN", quads + 100, -1), "is no index"));
    EXPECT_TRUE(contains(refusal_with("SCEN", quads + 16, 0.5), "is not planar"));
    EXPECT_TRUE(contains(refusal_with("SCEN", quads, 100.0), "is not convex"));
    EXPECT_TRUE(contains(refusal_with("SCEN", [](std::string& c) { c += '\0'; }), "left over"));
}

TEST_F(Damage, ImpossibleElementsAreRefused) {
    EXPECT_TRUE(contains(refusal_with("SPAC", 4, 5), "element 0: quad 5 of 5"));
    EXPECT_TRUE(contains(refusal_with("SPAC", 8, '\1'), "element 1: quad 0 has this side already"));
    EXPECT_TRUE(contains(refusal_with("SPAC", 11, '\3'), "3 stands where at most 2 may"));
    EXPECT_TRUE(contains(refusal_with("SPAC", 13, '\2'), "2 stands where at most 1 may"));
    // One element of four cells with masks, of which only one follows.
    const std::string short_of_masks("\1\0\0\0\0\0\0\0\0\1\0\2\1MASKMASK", 21);
    EXPECT_TRUE(contains(refusal_with("SPAC", [&](std::string& c) { c = short_of_masks; }),
                         "masks of cells are missing"));
}

TEST_F(Damage, ImpossibleOperatorsAreRefused) {
    const GlobalTransport transport = sample_transport();
    const std::size_t size = transport.space.functions();
    EXPECT_TRUE(contains(refusal_with("DTOI", 16 + 4 * size, '\xff'), "do not ascend below"));
    EXPECT_TRUE(contains(refusal_with("DTOV",
                                      [&](std::string& content) {
                                          const std::size_t n = content.size() / 4;
                                          content[2 * n] = '\x80';
                                          content[3 * n] = '\x7f';
                                      }),
                         "a coefficient is not finite"));
    EXPECT_TRUE(contains(refusal_with("GTOV", [](std::string& c) { c.resize(c.size() - 4); }),
                         "values for"));
    EXPECT_TRUE(contains(refusal_with("GTOV", [](std::string& c) { c += "1234"; }), "left over"));
}

TEST_F(Damage, ImpossibleProvenanceIsRefused) {
    const auto with_json = [&](const std::string& json) {
        return refusal_with("PROV", [&](std::string& content) { content = json; });
    };
    EXPECT_TRUE(contains(with_json("{"), "chunk PROV"));
    EXPECT_TRUE(contains(with_json("[]"), "chunk PROV"));
    EXPECT_TRUE(contains(with_json(std::string(100000, '[')), "nested too deeply"));
    EXPECT_TRUE(contains(with_json(R"({"options":{},"provenance":{}})"), "chunk PROV"));
}

TEST_F(Damage, ImpossibleDimmersAreRefused) {
    constexpr std::size_t dimmer = 3 * sizeof(double), on = dimmer + sizeof(double), light = on + 1;
    GlobalTransport transport = sample_transport();
    std::vector<DimmedLight> lights = undimmed(transport.scene.lights);
    lights[0].on = false;
    transport.scene.lights = shining(lights);
    write_operator_file(good_, transport, "{}", lights);
    EXPECT_EQ(refusal_with("dimm", dimmer, 0.5), "it was believed") << "the light is off";
    EXPECT_TRUE(contains(refusal_with("dimm", dimmer, 1.5), "dimmer is not within 0 and 1"));
    EXPECT_TRUE(contains(refusal_with("dimm", light + dimmer, 0.5), "light 1 does not shine"));
    EXPECT_TRUE(contains(refusal_with("dimm", on, '\1'), "light 0 does not shine"));
    EXPECT_TRUE(contains(refusal_with("dimm", on, '\2'), "chunk dimm"));
    EXPECT_TRUE(contains(refusal_with("dimm", [](std::string& content) { content.pop_back(); }),
                         "chunk dimm"));
}

// Contents changed at random, with checksums that match: refused or read, never a crash.
TEST_F(Damage, RandomContentsAreReadOrRefused) {
    std::mt19937 random(7);
    int refused = 0;
    for (int round = 0; round < 2000; ++round) {
        forge(good_, bad_, [&](std::string&, std::string& content) {
            if (random() % 4 != 0 || content.empty()) return;
            const std::size_t at = random() % content.size();
            switch (random() % 4) {
                case 0:
                    content[at] = static_cast<char>(random());
                    break;
                case 1:
                    content.erase(at, 1 + random() % 8);
                    break;
                case 2:
                    content.insert(at, 1 + random() % 8, static_cast<char>(random()));
                    break;
                default:
                    content.replace(at, 4, "\xff\xff\xff\xff");
                    break;
            }
        });
        try {
            read_operator_file(bad_);
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace lightwell::testing
