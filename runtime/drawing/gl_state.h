#pragma once

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// Remembers the framebuffer that is bound, and binds it again at the end.
class KeptFramebuffer {
  public:
    explicit KeptFramebuffer(const GlFunctions& gl);
    ~KeptFramebuffer();
    KeptFramebuffer(const KeptFramebuffer&) = delete;
    KeptFramebuffer& operator=(const KeptFramebuffer&) = delete;

    /// Binds it for drawing already now.
    void bind_drawn() const;

  private:
    const GlFunctions& gl_;
    int drawn_ = 0, read_ = 0;
};

/// Nothing is drawn or cleared outside of some rows, from .. to - 1, until the end.
class LimitedRows {
  public:
    LimitedRows(const GlFunctions& gl, int width, int from, int to);
    ~LimitedRows();
    LimitedRows(const LimitedRows&) = delete;
    LimitedRows& operator=(const LimitedRows&) = delete;

  private:
    const GlFunctions& gl_;
};

/// A program in use, with its uniforms by name; names that it has no use for are passed over. At
/// the end no program is in use, and no texture is bound to the units that it took.
class ProgramInUse {
  public:
    ProgramInUse(const GlFunctions& gl, const GlObject& program);
    ~ProgramInUse();
    ProgramInUse(const ProgramInUse&) = delete;
    ProgramInUse& operator=(const ProgramInUse&) = delete;

    void set(const char* name, int value) const;
    void set(const char* name, double value) const;
    void set(const char* name, const Vec3& value) const;
    void set(const char* name, const Eigen::Matrix3d& value) const;
    void set(const char* name, const Eigen::Vector4d& value) const;
    /// Binds the texture to the next unit.
    void set_texture(const char* name, unsigned target, unsigned texture);

  private:
    int at(const char* name) const;

    const GlFunctions& gl_;
    unsigned program_;
    int used_ = 0;  ///< texture units
};

}  // namespace lightwell
