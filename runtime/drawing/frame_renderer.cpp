#include "runtime/drawing/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <GL/glcorearb.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/camera_rays.h"
#include "runtime/drawing/canvas.h"
#include "runtime/drawing/developing.h"
#include "runtime/drawing/emitter_shafts.h"
#include "runtime/drawing/frame_shaders.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/gl_state.h"
#include "runtime/drawing/index_drawing.h"
#include "runtime/drawing/lamp_maps.h"
#include "runtime/drawing/lamp_records.h"
#include "runtime/drawing/record_buffer.h"
#include "runtime/drawing/surface_records.h"

namespace lightwell {

namespace {

std::vector<Quad> scaled_quads(const Scene& scene, const SceneScale& scale) {
    std::vector<Quad> quads;
    for (const SceneQuad& quad : scene.quads) {
        quads.push_back(quad.quad);
        for (Vec3& vertex : quads.back().vertex)
            vertex = scale.scaled(vertex);
    }
    return quads;
}

}  // namespace

class FrameRenderer::Drawing {
  public:
    Drawing(const GlobalTransport& transport, const GlLoader& loader,
            const FrameRendererOptions& options)
        : gl_(loader),
          scale_(transport.scene),
          surfaces_(transport, scale_),
          indices_(gl_, scaled_quads(transport.scene, scale_)),
          covering_(gl_),
          developing_(gl_, covering_),
          surface_buffer_(gl_),
          lamp_buffer_(gl_),
          emitter_buffer_(gl_),
          shaft_buffer_(gl_),
          shown_(make_texture(gl_)),
          exact_(make_texture(gl_)),
          lobes_(make_texture(gl_)),
          emitted_lobes_(make_texture(gl_)),
          lamp_maps_(gl_, indices_, options.lamp_side) {
        surface_buffer_.set(surfaces_.records);
        lamp_buffer_.set({});
        const KeptFramebuffer kept(gl_);
        const EmitterShafts shafts(transport.scene);
        std::vector<Record> emitters;
        for (const int emitter : shafts.emitters())
            emitters.push_back({static_cast<float>(emitter), 0, 0, 0});
        emitter_buffer_.set(emitters);
        shaft_buffer_.set(shafts.records());
        emitter_count_ = static_cast<int>(emitters.size());
        first_list_ = shafts.first_list();
        // One texel with its border, for all elements.
        const std::array<float, 4 * 9> darkness = {};
        for (const GlObject* texture : {&shown_, &exact_, &lobes_, &emitted_lobes_})
            fill(*texture, {3, 3}, darkness.data());
    }

    void set_lights(const std::vector<Light>& lamps) {
        const KeptFramebuffer kept(gl_);
        std::vector<Record> records;
        std::vector<Vec3> places;
        for (const Light& lamp : lamps) {
            append_records(lamp, scale_, records);
            places.push_back(scale_.scaled(position_of(lamp)));
        }
        lamp_buffer_.set(records);
        lamp_maps_.look_from(places);
        lamp_count_ = static_cast<int>(lamps.size());
    }

    void upload(const TextureAtlas& textures, bool is_exact) {
        if (surfaces_.place(textures)) surface_buffer_.set(surfaces_.records);
        fill(is_exact ? exact_ : shown_, textures.size(), textures.pixels());
        check_gl(gl_, "uploading textures");
    }

    void upload_lobes(const TextureAtlas& indirect, const TextureAtlas& emitted) {
        if (surfaces_.place_lobes(indirect)) surface_buffer_.set(surfaces_.records);
        fill(lobes_, indirect.size(), indirect.pixels());
        fill(emitted_lobes_, emitted.size(), emitted.pixels());
        check_gl(gl_, "uploading textures");
    }

    void draw(const Camera& camera, const FrameView& view, int width, int height,
              const PictureRows& rows) {
        LIGHTWELL_CHECK(view.coarseness == 1 || (rows.from == 0 && rows.to == 1));
        const KeptFramebuffer kept(gl_);
        const int from = static_cast<int>(std::lround(rows.from * height));
        const int to = static_cast<int>(std::lround(rows.to * height));
        draw_light(camera, view, width, height, from, to);
        kept.bind_drawn();
        const LimitedRows limits(gl_, width, from, to);
        developing_.draw(canvas_->light_texture(), view, width, height);
        check_gl(gl_, "drawing a frame");
    }

    LinearPicture linear(const Camera& camera, const FrameView& view, int width, int height) {
        LIGHTWELL_CHECK_OP(view.coarseness, ==, 1);
        const KeptFramebuffer kept(gl_);
        draw_light(camera, view, width, height, 0, height);
        return mean_of_samples(*canvas_, view.samples, width, height);
    }

    const SurfaceRecords& surfaces() const { return surfaces_; }

  private:
    void fill(const GlObject& texture, const TextureSize& size, const float* pixels) const {
        fill_texture(gl_, texture, GL_RGBA32F, GL_RGBA, GL_FLOAT, size.columns, size.rows, pixels);
    }

    void prepare_canvas(int width, int height) {
        if (canvas_ && canvas_->width() == width && canvas_->height() == height) return;
        canvas_.reset();
        canvas_.emplace(gl_, width, height);
    }

    const GlObject& lighting(Picture picture) {
        const auto found = lighting_.find(picture);
        if (found != lighting_.end()) return found->second;
        return lighting_
            .emplace(picture, make_program(gl_, covering_vertex_shader(),
                                           lighting_shader(picture, surfaces_.has_lobes()).c_str()))
            .first->second;
    }

    /// @param from,to  rows of the picture
    void draw_light(const Camera& camera, const FrameView& view, int width, int height, int from,
                    int to) {
        LIGHTWELL_CHECK_OP(view.samples, >=, 1);
        LIGHTWELL_CHECK_OP(view.samples, <=, 4);
        LIGHTWELL_CHECK_OP(view.coarseness, >=, 1);
        LIGHTWELL_CHECK_OP(std::min(view.samples, view.coarseness), ==, 1);
        const CameraRays rays(camera, width, height);
        const auto samples_along = [&](int pixels) {
            return (view.samples * pixels + view.coarseness - 1) / view.coarseness;
        };
        prepare_canvas(samples_along(width), samples_along(height));
        IndexView seen;
        seen.eye = scale_.scaled(rays.position());
        seen.frame = rays.frame();
        seen.across = 0.5 * width / rays.focal_length();
        seen.up = 0.5 * height / rays.focal_length();
        seen.width = canvas_->width();
        seen.height = canvas_->height();
        // Contour lines look at the row below.
        const int first = from == 0 ? 0 : (from - 1) * view.samples;
        const int last = to == height ? canvas_->height() : to * view.samples;
        const LimitedRows limits(gl_, canvas_->width(), first, last);
        canvas_->bind_seen();
        indices_.clear(canvas_->width(), canvas_->height());
        indices_.draw(seen);

        canvas_->bind_light();
        gl_.disable(GL_DEPTH_TEST);
        gl_.viewport(0, 0, canvas_->width(), canvas_->height());
        ProgramInUse program(gl_, lighting(view.picture));
        program.set_texture("seen", GL_TEXTURE_2D, canvas_->seen_texture());
        program.set_texture("surfaces", GL_TEXTURE_BUFFER, surface_buffer_.texture());
        program.set_texture("lamps", GL_TEXTURE_BUFFER, lamp_buffer_.texture());
        program.set_texture("lamp_maps", GL_TEXTURE_2D_ARRAY, lamp_maps_.texture());
        program.set_texture("emitters", GL_TEXTURE_BUFFER, emitter_buffer_.texture());
        program.set_texture("shafts", GL_TEXTURE_BUFFER, shaft_buffer_.texture());
        program.set_texture("shown", GL_TEXTURE_2D, shown_.name());
        program.set_texture("exact", GL_TEXTURE_2D, exact_.name());
        program.set_texture("lobes", GL_TEXTURE_2D, lobes_.name());
        program.set_texture("emitted_lobes", GL_TEXTURE_2D, emitted_lobes_.name());
        program.set("first_element", surfaces_.first_element);
        program.set("eye", seen.eye);
        program.set("frame", seen.frame);
        program.set("pixel", Eigen::Vector4d(2 * seen.across / seen.width, -seen.across,
                                             2 * seen.up / seen.height, -seen.up));
        program.set("pixel_angle", 2 * seen.up / seen.height);
        program.set("lamp_count", lamp_count_);
        program.set("lamp_side", lamp_maps_.side());
        program.set("lamp_reach", lamp_maps_.reach());
        program.set("emitter_count", emitter_count_);
        program.set("first_list", first_list_);
        program.set("bilinear", view.bilinear ? 1 : 0);
        program.set("difference_range", view.difference_range);
        covering_.draw();
    }

    GlFunctions gl_;
    SceneScale scale_;
    SurfaceRecords surfaces_;
    IndexDrawing indices_;
    std::map<Picture, GlObject> lighting_;  ///< made when first needed
    Covering covering_;
    Developing developing_;
    RecordBuffer surface_buffer_, lamp_buffer_, emitter_buffer_, shaft_buffer_;
    GlObject shown_, exact_, lobes_, emitted_lobes_;
    LampMaps lamp_maps_;
    int lamp_count_ = 0, emitter_count_ = 0, first_list_ = 0;
    std::optional<Canvas> canvas_;
};

FrameRenderer::FrameRenderer(const GlobalTransport& transport, const GlLoader& loader,
                             const FrameRendererOptions& options)
    : drawing_(std::make_unique<Drawing>(transport, loader, options)) {}
FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_lights(const std::vector<Light>& lamps) {
    drawing_->set_lights(lamps);
}
void FrameRenderer::upload(const TextureAtlas& textures) {
    drawing_->upload(textures, false);
}
void FrameRenderer::upload_exact(const TextureAtlas& textures) {
    drawing_->upload(textures, true);
}
void FrameRenderer::upload_lobes(const TextureAtlas& indirect, const TextureAtlas& emitted) {
    drawing_->upload_lobes(indirect, emitted);
}
void FrameRenderer::draw(const Camera& camera, const FrameView& view, int width, int height,
                         const PictureRows& rows) {
    drawing_->draw(camera, view, width, height, rows);
}
LinearPicture FrameRenderer::linear(const Camera& camera, const FrameView& view, int width,
                                    int height) {
    return drawing_->linear(camera, view, width, height);
}
std::uint64_t FrameRenderer::most_coefficients() const {
    return drawing_->surfaces().most_coefficients;
}
int FrameRenderer::deepest_level() const {
    return drawing_->surfaces().deepest_level;
}

}  // namespace lightwell
