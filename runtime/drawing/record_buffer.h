#pragma once

#include <vector>

#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/surface_records.h"

namespace lightwell {

/// Records that shaders read through a buffer texture.
class RecordBuffer {
  public:
    /// Empty. Keeps a reference to `gl`.
    explicit RecordBuffer(const GlFunctions& gl);

    void set(const std::vector<Record>& records);
    unsigned texture() const { return texture_.name(); }

  private:
    const GlFunctions& gl_;
    GlObject buffer_, texture_;
};

}  // namespace lightwell
