#include "runtime/drawing/record_buffer.h"

#include <algorithm>

#include <GL/glcorearb.h>

namespace lightwell {

RecordBuffer::RecordBuffer(const GlFunctions& gl)
    : gl_(gl), buffer_(make_buffer(gl)), texture_(make_texture(gl)) {
    set({});
}

void RecordBuffer::set(const std::vector<Record>& records) {
    // A buffer of no size cannot be read at all.
    const Record nothing = {0, 0, 0, 0};
    gl_.bind_buffer(GL_TEXTURE_BUFFER, buffer_.name());
    gl_.buffer_data(
        GL_TEXTURE_BUFFER,
        static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, records.size()) * sizeof(Record)),
        records.empty() ? &nothing : records.data(), GL_DYNAMIC_DRAW);
    gl_.active_texture(GL_TEXTURE0);
    gl_.bind_texture(GL_TEXTURE_BUFFER, texture_.name());
    gl_.tex_buffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffer_.name());
    gl_.bind_texture(GL_TEXTURE_BUFFER, 0);
    gl_.bind_buffer(GL_TEXTURE_BUFFER, 0);
    check_gl(gl_, "uploading records");
}

}  // namespace lightwell
