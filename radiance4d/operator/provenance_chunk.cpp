#include "radiance4d/operator/provenance_chunk.h"

#include <cmath>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "radiance4d/failure.h"

namespace lightwell {

namespace {

using Json = nlohmann::json;

/// Deeper nesting is refused: writing JSON takes stack for each level.
constexpr int most_nesting = 64;

Json parsed(std::string_view text) {
    return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
        if (depth > most_nesting) throw std::invalid_argument("it is nested too deeply");
        return true;
    });
}

/// Calls visit(key, member) for every member, so that writing and reading name the same keys.
template <typename Record, typename Visit>
void for_each_member(Record& provenance, Visit visit) {
    visit("program", provenance.program);
    visit("oracle", provenance.oracle);
    visit("error_asked", provenance.error_asked);
    visit("error_estimated", provenance.error_estimated);
    visit("cell_size", provenance.cell_size);
    visit("oracle_tolerance", provenance.oracle_tolerance);
    visit("truncation", provenance.truncation);
    visit("rays", provenance.rays);
    visit("links", provenance.links);
    visit("bounces", provenance.bounces);
    visit("energy_dropped", provenance.energy_dropped);
}

/// The same for members that files of earlier versions of the program lack.
template <typename Record, typename Visit>
void for_each_later_member(Record& provenance, Visit visit) {
    visit("error_bound", provenance.error_bound);
    visit("error_basis", provenance.error_basis);
}

void take(const Json& value, std::string& member) {
    value.get_to(member);
}

void take(const Json& value, double& member) {
    value.get_to(member);
    if (!std::isfinite(member)) throw std::invalid_argument("a number is not finite");
}

void take(const Json& value, std::uint64_t& member) {
    if (!value.is_number_unsigned()) throw std::invalid_argument("a count is no whole number");
    value.get_to(member);
}

void take(const Json& value, int& member) {
    std::uint64_t number = 0;
    take(value, number);
    if (number > 0x7fffffffU) throw std::invalid_argument("a count is too large");
    member = static_cast<int>(number);
}

}  // namespace

std::string provenance_bytes(const Provenance& provenance, const std::string& options_json) {
    LIGHTWELL_CHECK_OP(provenance.bounces, >=, 0);
    Json record;
    const auto put = [&](const char* key, const auto& member) {
        record[key] = member;
        if (record[key].is_number_float())
            LIGHTWELL_CHECK(std::isfinite(record[key].template get<double>()));
    };
    for_each_member(provenance, put);
    for_each_later_member(provenance, put);
    try {
        const Json options = parsed(options_json);
        LIGHTWELL_CHECK(options.is_object());
        // Text may come from file names, which need not be UTF-8.
        return Json{{"options", options}, {"provenance", record}}.dump(
            -1, ' ', false, Json::error_handler_t::replace);
    } catch (const BrokenInvariant&) {
        throw;
    } catch (const std::exception& error) {
        throw BrokenInvariant(std::string("the options are not JSON: ") + error.what());
    }
}

Provenance read_provenance(ByteReader& reader, std::string& options_json) {
    Provenance provenance;
    try {
        const Json both = parsed(reader.take(reader.left()));
        const Json& record = both.at("provenance");
        for_each_member(provenance,
                        [&](const char* key, auto& member) { take(record.at(key), member); });
        for_each_later_member(provenance, [&](const char* key, auto& member) {
            if (record.contains(key)) take(record.at(key), member);
        });
        if (!both.at("options").is_object()) throw std::invalid_argument("options is no object");
        options_json = both.at("options").dump();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        reader.fail(error.what());
    }
    return provenance;
}

}  // namespace lightwell
