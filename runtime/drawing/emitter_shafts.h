#pragma once

#include <vector>

#include "radiance4d/scene/occluder_tree.h"
#include "radiance4d/scene/scene.h"
#include "runtime/drawing/surface_records.h"

namespace lightwell {

/// What may stand between emitting quads and every part of every side of every quad. Neither moves,
/// so it is found once.
///
/// A side is cut into columns x rows parts of its front's (u,v). Of each part and each emitting
/// quad it is known whether the emitter lights no point of it, or else which quads reach into the
/// convex hull of both.
class EmitterShafts {
  public:
    explicit EmitterShafts(const Scene& scene);

    /// The emitting quads.
    const std::vector<int>& emitters() const { return emitters_; }
    /// For a shader, first a record for each side, 2 * quad + (front ? 0 : 1): columns, rows and
    /// the index of the first part's first record; then a record for each part and emitter: the
    /// index of the first of the quads between, and their number, or -1 if it is dark; then those
    /// quads, four in a record, their indices counted in single numbers.
    const std::vector<Record>& records() const { return records_; }
    /// Index of the record that holds the first quads between.
    int first_list() const { return first_list_; }

  private:
    std::vector<int> emitters_;
    std::vector<Record> records_;
    int first_list_ = 0;
};

}  // namespace lightwell
