// Apart from GlContext: whoever draws in a window must not load what draws without one.
#include "viewer/offscreen/gl_context.h"

namespace lightwell {

std::unique_ptr<GlContext> make_context(OffscreenGl kind) {
    return kind == OffscreenGl::egl ? make_egl_context() : make_offscreen_context();
}

}  // namespace lightwell
