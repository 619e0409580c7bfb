#include "solver/reading/reading_report.h"

#include <fmt/format.h>

namespace lightwell {

namespace {

constexpr std::size_t places_named = 4;

/// "7 triangles", "1 triangle".
std::string counted(int number, const std::string& noun) {
    return with_separators(number) + " " + noun + (number == 1 ? "" : "s");
}

void append(std::string& list, const std::string& item) {
    if (!list.empty()) list += ", ";
    list += item;
}

}  // namespace

std::string Warning::to_string() const {
    const std::string where = place.to_string();
    return where.empty() ? message : where + ": " + message;
}

std::string with_separators(long long number) {
    std::string digits = std::to_string(number);
    for (long long i = static_cast<long long>(digits.size()) - 3; i > (number < 0 ? 1 : 0); i -= 3)
        digits.insert(static_cast<std::size_t>(i), ",");
    return digits;
}

std::string to_string(const PolygonCounts& counts) {
    std::string kinds;
    append(kinds, counted(counts.quads, "quad"));
    if (counts.triangles > 0) append(kinds, counted(counts.triangles, "triangle"));
    if (counts.larger > 0) append(kinds, counted(counts.larger, "larger polygon"));
    if (counts.concave > 0) append(kinds, counted(counts.concave, "concave polygon"));
    if (counts.bent > 0) append(kinds, counted(counts.bent, "bent polygon"));
    if (counts.degenerate > 0)
        append(kinds, with_separators(counts.degenerate) + " without area, left out");
    if (counts.crossing > 0)
        append(kinds, with_separators(counts.crossing) + " crossing themselves, left out");
    std::string deeds;
    if (counts.pairs > 0)
        append(deeds, counted(2 * counts.pairs, "triangle") + " paired into " +
                          counted(counts.pairs, "quad"));
    if (counts.cut > 0)
        append(deeds,
               counted(counts.cut, "triangle") + " cut into " + counted(3 * counts.cut, "quad"));
    if (counts.flattened > 0)
        append(deeds, counted(counts.flattened, "polygon") + " moved onto the mean plane");
    if (counts.copies > 0)
        append(deeds, with_separators(counts.copies) +
                          (counts.copies == 1 ? " copy left out" : " copies left out"));
    if (counts.along_walls > 0)
        append(deeds, counted(counts.along_walls, "quad") + " cut along walls into " +
                          with_separators(counts.pieces));
    return counted(counts.faces, "face") + ": " + kinds + (deeds.empty() ? "" : "; ") + deeds +
           "; " + counted(counts.elements, "quad") + " in all";
}

void Occurrences::add(int line, int column) {
    ++count_;
    if (first_.size() < places_named) first_.emplace_back(line, column);
}

void Occurrences::report(const std::string& file, const std::string& message,
                         std::vector<Warning>& warnings) const {
    if (count_ == 0) return;
    std::string others;
    if (first_.front().first > 0)
        for (std::size_t i = 1; i < first_.size(); ++i)
            append(others, std::to_string(first_[i].first));
    const int unnamed = count_ - static_cast<int>(first_.size());
    if (!others.empty()) {
        others =
            " (also at line" + std::string(first_.size() > 2 || unnamed > 0 ? "s " : " ") + others;
        if (unnamed > 0) others += " and " + with_separators(unnamed) + " more";
        others += ")";
    }
    warnings.push_back({{file, first_.front().first, first_.front().second}, message + others});
}

}  // namespace lightwell
