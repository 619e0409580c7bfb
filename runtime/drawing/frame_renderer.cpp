#include "runtime/drawing/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include "radiance4d/failure.h"
#include "runtime/drawing/camera_rays.h"
#include "runtime/drawing/emitter_shafts.h"
#include "runtime/drawing/frame_shaders.h"
#include "runtime/drawing/gl_objects.h"
#include "runtime/drawing/index_drawing.h"
#include "runtime/drawing/lamp_maps.h"
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

/// Remembers the framebuffer that is bound, and binds it again.
class KeptFramebuffer {
  public:
    explicit KeptFramebuffer(const GlFunctions& gl) : gl_(gl) {
        gl.get_integerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn_);
        gl.get_integerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    }
    ~KeptFramebuffer() {
        gl_.bind_framebuffer(GL_READ_FRAMEBUFFER, static_cast<unsigned>(read_));
        bind_drawn();
    }
    KeptFramebuffer(const KeptFramebuffer&) = delete;
    KeptFramebuffer& operator=(const KeptFramebuffer&) = delete;
    void bind_drawn() const {
        gl_.bind_framebuffer(GL_DRAW_FRAMEBUFFER, static_cast<unsigned>(drawn_));
    }

  private:
    const GlFunctions& gl_;
    int drawn_ = 0, read_ = 0;
};

/// Records that shaders read through a texture.
class RecordBuffer {
  public:
    explicit RecordBuffer(const GlFunctions& gl)
        : gl_(gl), buffer_(make_buffer(gl)), texture_(make_texture(gl)) {}
    void set(const std::vector<Record>& records) {
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
    }
    unsigned texture() const { return texture_.name(); }

  private:
    const GlFunctions& gl_;
    GlObject buffer_, texture_;
};

/// An image that is drawn, and then read by a shader.
class DrawnImage {
  public:
    /// @param format  an OpenGL sized internal format, of integers or floats as `kind` and `type`
    /// say
    DrawnImage(const GlFunctions& gl, unsigned format, unsigned kind, unsigned type, int width,
               int height)
        : texture_(make_texture(gl)) {
        gl.active_texture(GL_TEXTURE0);
        gl.bind_texture(GL_TEXTURE_2D, texture_.name());
        for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            gl.tex_parameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        gl.tex_image_2d(GL_TEXTURE_2D, 0, static_cast<int>(format), width, height, 0, kind, type,
                        nullptr);
        gl.bind_texture(GL_TEXTURE_2D, 0);
    }
    unsigned texture() const { return texture_.name(); }

  private:
    GlObject texture_;
};

/// The images behind a picture of a certain size.
struct Canvas {
    int width, height;  ///< [samples]
    DrawnImage seen, light;
    GlObject depth, seen_framebuffer, light_framebuffer;

    Canvas(const GlFunctions& gl, int canvas_width, int canvas_height)
        : width(canvas_width),
          height(canvas_height),
          seen(gl, GL_R32I, GL_RED_INTEGER, GL_INT, width, height),
          light(gl, GL_RGBA32F, GL_RGBA, GL_FLOAT, width, height),
          depth(make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, width, height)),
          seen_framebuffer(make_framebuffer(gl)),
          light_framebuffer(make_framebuffer(gl)) {
        gl.bind_framebuffer(GL_FRAMEBUFFER, seen_framebuffer.name());
        gl.framebuffer_texture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, seen.texture(), 0);
        gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                    depth.name());
        require_complete(gl);
        gl.bind_framebuffer(GL_FRAMEBUFFER, light_framebuffer.name());
        gl.framebuffer_texture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, light.texture(), 0);
        require_complete(gl);
    }

  private:
    void require_complete(const GlFunctions& gl) const {
        const unsigned status = gl.check_framebuffer_status(GL_FRAMEBUFFER);
        check_gl(gl, "making an image to draw on");
        if (status != GL_FRAMEBUFFER_COMPLETE)
            throw SystemError(
                fmt::format("OpenGL cannot draw {} x {} pixels (framebuffer status 0x{:04x})",
                            width, height, status));
    }
};

/// A program, with its uniforms by name; in use while it lives.
class ProgramInUse {
  public:
    ProgramInUse(const GlFunctions& gl, const GlObject& program)
        : gl_(gl), program_(program.name()) {
        gl.use_program(program_);
    }
    ~ProgramInUse() {
        for (int unit = used_ - 1; unit >= 0; --unit) {
            gl_.active_texture(GL_TEXTURE0 + static_cast<unsigned>(unit));
            for (const unsigned target : {GL_TEXTURE_2D, GL_TEXTURE_BUFFER, GL_TEXTURE_2D_ARRAY})
                gl_.bind_texture(target, 0);
        }
        gl_.use_program(0);
    }
    ProgramInUse(const ProgramInUse&) = delete;
    ProgramInUse& operator=(const ProgramInUse&) = delete;

    void set(const char* name, int value) const { gl_.uniform1i(at(name), value); }
    void set(const char* name, double value) const {
        gl_.uniform1f(at(name), static_cast<float>(value));
    }
    void set(const char* name, const Vec3& v) const {
        gl_.uniform3f(at(name), static_cast<float>(v[0]), static_cast<float>(v[1]),
                      static_cast<float>(v[2]));
    }
    int at(const char* name) const { return gl_.get_uniform_location(program_, name); }
    void set_texture(const char* name, unsigned target, unsigned texture) {
        gl_.active_texture(GL_TEXTURE0 + static_cast<unsigned>(used_));
        gl_.bind_texture(target, texture);
        gl_.uniform1i(at(name), used_++);
    }

  private:
    const GlFunctions& gl_;
    unsigned program_;
    int used_ = 0;  ///< texture units
};

Record record(const Eigen::Array3d& three, double fourth) {
    return {static_cast<float>(three[0]), static_cast<float>(three[1]),
            static_cast<float>(three[2]), static_cast<float>(fourth)};
}

/// Position (scaled), intensity over the square of the scene's extent, axis; with the intensity and
/// the axis the cosines within and without which a spot has all or none of its intensity.
void append_records(const Light& light, const SceneScale& scale, std::vector<Record>& records) {
    const double square = scale.extent * scale.extent;
    records.push_back(record(scale.scaled(position_of(light)), 0));
    if (const auto* spot = std::get_if<SpotLight>(&light)) {
        const double radian = M_PI / 180;
        records.push_back(record(spot->intensity / square, std::cos(spot->inner_angle * radian)));
        records.push_back(record(spot->direction, std::cos(spot->outer_angle * radian)));
    } else {
        records.push_back(record(std::get<PointLight>(light).intensity / square, -2));
        records.push_back(record(Vec3::UnitZ(), -3));
    }
}

}  // namespace

class FrameRenderer::Drawing {
  public:
    Drawing(const GlobalTransport& transport, const GlLoader& loader,
            const FrameRendererOptions& options)
        : gl_(loader),
          scale_(transport.scene),
          quads_(transport.scene.quads.size()),
          surfaces_(transport, scale_),
          indices_(gl_, scaled_quads(transport.scene, scale_)),
          lighting_(make_program(gl_, covering_vertex_shader(), lighting_shader().c_str())),
          developing_(make_program(gl_, covering_vertex_shader(), developing_shader().c_str())),
          covering_(make_vertex_array(gl_)),
          surface_buffer_(gl_),
          lamp_buffer_(gl_),
          emitter_buffer_(gl_),
          shaft_buffer_(gl_),
          shown_(make_texture(gl_)),
          exact_(make_texture(gl_)),
          lamp_maps_(gl_, indices_, options.lamp_side) {
        for (std::size_t q = 0; q < quads_.size(); ++q)
            quads_[q] = transport.scene.quads[q].quad;
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
        for (const GlObject* texture : {&shown_, &exact_})
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

    void draw(const Camera& camera, const FrameView& view, int width, int height) {
        const KeptFramebuffer kept(gl_);
        draw_light(camera, view, width, height);
        kept.bind_drawn();
        develop(view, width, height);
        check_gl(gl_, "drawing a frame");
    }

    LinearPicture linear(const Camera& camera, const FrameView& view, int width, int height) {
        const KeptFramebuffer kept(gl_);
        draw_light(camera, view, width, height);
        const int samples = view.samples;
        const std::vector<float> drawn = read_light();
        LinearPicture picture{width, height, {}};
        picture.rgb.reserve(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int channel = 0; channel < 3; ++channel) {
                    float sum = 0;
                    for (int k = 0; k < samples * samples; ++k) {
                        const int row = samples * (height - 1 - y) + k / samples;
                        const int column = samples * x + k % samples;
                        sum += drawn[4 * (static_cast<std::size_t>(row) *
                                              static_cast<std::size_t>(canvas_->width) +
                                          static_cast<std::size_t>(column)) +
                                     static_cast<std::size_t>(channel)];
                    }
                    picture.rgb.push_back(sum / static_cast<float>(samples * samples));
                }
        return picture;
    }

    std::optional<SeenSurface> seen_at(int x, int y) const {
        if (!rays_ || x < 0 || y < 0 || x >= rays_->width() || y >= rays_->height())
            return std::nullopt;
        const KeptFramebuffer kept(gl_);
        const int samples = canvas_->width / rays_->width();
        int quad = -1;
        gl_.bind_framebuffer(GL_FRAMEBUFFER, canvas_->seen_framebuffer.name());
        prepare_reading();
        gl_.read_pixels(samples * x + samples / 2,
                        samples * (rays_->height() - 1 - y) + samples / 2, 1, 1, GL_RED_INTEGER,
                        GL_INT, &quad);
        check_gl(gl_, "reading what a pixel sees");
        if (quad < 0) return std::nullopt;
        const Quad& seen = quads_[static_cast<std::size_t>(quad)];
        const Vec3 direction = rays_->direction(x + 0.5, y + 0.5), normal = seen.normal();
        const double along = normal.dot(direction);
        const double t = normal.dot(seen.vertex[0] - rays_->position()) / along;
        if (!std::isfinite(t)) return std::nullopt;
        return SeenSurface{quad, along < 0, rays_->position() + t * direction};
    }

    const SurfaceRecords& surfaces() const { return surfaces_; }

  private:
    void fill(const GlObject& texture, const TextureSize& size, const float* pixels) const {
        gl_.bind_buffer(GL_PIXEL_UNPACK_BUFFER, 0);
        gl_.active_texture(GL_TEXTURE0);
        gl_.bind_texture(GL_TEXTURE_2D, texture.name());
        for (const unsigned filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            gl_.tex_parameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
        gl_.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
        for (const unsigned parameter : {GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS,
                                         GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SWAP_BYTES})
            gl_.pixel_storei(parameter, 0);
        gl_.pixel_storei(GL_UNPACK_ALIGNMENT, 4);
        gl_.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA32F, size.columns, size.rows, 0, GL_RGBA,
                         GL_FLOAT, pixels);
        gl_.bind_texture(GL_TEXTURE_2D, 0);
    }

    void prepare_reading() const {
        gl_.bind_buffer(GL_PIXEL_PACK_BUFFER, 0);
        for (const unsigned parameter :
             {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SWAP_BYTES})
            gl_.pixel_storei(parameter, 0);
        gl_.pixel_storei(GL_PACK_ALIGNMENT, 4);
    }

    std::vector<float> read_light() const {
        std::vector<float> rgba(4 * static_cast<std::size_t>(canvas_->width) *
                                static_cast<std::size_t>(canvas_->height));
        gl_.bind_framebuffer(GL_FRAMEBUFFER, canvas_->light_framebuffer.name());
        prepare_reading();
        gl_.read_pixels(0, 0, canvas_->width, canvas_->height, GL_RGBA, GL_FLOAT, rgba.data());
        check_gl(gl_, "reading a picture");
        return rgba;
    }

    void prepare_canvas(int width, int height) {
        int longest = 0;
        gl_.get_integerv(GL_MAX_TEXTURE_SIZE, &longest);
        if (std::max(width, height) > longest)
            throw SystemError(fmt::format("OpenGL cannot draw {} x {} pixels, {} a side at most",
                                          width, height, longest));
        if (canvas_ && canvas_->width == width && canvas_->height == height) return;
        canvas_.reset();
        canvas_.emplace(gl_, width, height);
    }

    void draw_light(const Camera& camera, const FrameView& view, int width, int height) {
        LIGHTWELL_CHECK_OP(view.samples, >=, 1);
        LIGHTWELL_CHECK_OP(view.samples, <=, 4);
        rays_.emplace(camera, width, height);
        prepare_canvas(view.samples * width, view.samples * height);
        IndexView seen;
        seen.eye = scale_.scaled(rays_->position());
        seen.frame = rays_->frame();
        seen.across = 0.5 * width / rays_->focal_length();
        seen.up = 0.5 * height / rays_->focal_length();
        seen.width = canvas_->width;
        seen.height = canvas_->height;
        gl_.bind_framebuffer(GL_FRAMEBUFFER, canvas_->seen_framebuffer.name());
        indices_.clear(canvas_->width, canvas_->height);
        indices_.draw(seen);

        gl_.bind_framebuffer(GL_FRAMEBUFFER, canvas_->light_framebuffer.name());
        gl_.disable(GL_DEPTH_TEST);
        gl_.viewport(0, 0, canvas_->width, canvas_->height);
        ProgramInUse program(gl_, lighting_);
        program.set_texture("seen", GL_TEXTURE_2D, canvas_->seen.texture());
        program.set_texture("surfaces", GL_TEXTURE_BUFFER, surface_buffer_.texture());
        program.set_texture("lamps", GL_TEXTURE_BUFFER, lamp_buffer_.texture());
        program.set_texture("lamp_maps", GL_TEXTURE_2D_ARRAY, lamp_maps_.texture());
        program.set_texture("emitters", GL_TEXTURE_BUFFER, emitter_buffer_.texture());
        program.set_texture("shafts", GL_TEXTURE_BUFFER, shaft_buffer_.texture());
        program.set_texture("shown", GL_TEXTURE_2D, shown_.name());
        program.set_texture("exact", GL_TEXTURE_2D, exact_.name());
        program.set("first_element", surfaces_.first_element);
        program.set("eye", seen.eye);
        const Eigen::Matrix3f frame = seen.frame.cast<float>();
        gl_.uniform_matrix3fv(program.at("frame"), 1, GL_FALSE, frame.data());
        gl_.uniform4f(program.at("pixel"), static_cast<float>(2 * seen.across / seen.width),
                      static_cast<float>(-seen.across),
                      static_cast<float>(2 * seen.up / seen.height), static_cast<float>(-seen.up));
        program.set("pixel_angle", 2 * seen.up / seen.height);
        program.set("lamp_count", lamp_count_);
        program.set("lamp_side", lamp_maps_.side());
        program.set("lamp_reach", lamp_maps_.reach());
        program.set("emitter_count", emitter_count_);
        program.set("first_list", first_list_);
        program.set("bilinear", view.bilinear ? 1 : 0);
        program.set("picture", static_cast<int>(view.picture));
        program.set("difference_range", view.difference_range);
        cover();
    }

    void develop(const FrameView& view, int width, int height) const {
        LIGHTWELL_CHECK_OP(view.lux_maximum, >, 0);
        LIGHTWELL_CHECK_OP(view.lux_divisions, >=, 1);
        gl_.disable(GL_FRAMEBUFFER_SRGB);
        gl_.viewport(0, 0, width, height);
        ProgramInUse program(gl_, developing_);
        program.set_texture("picture_light", GL_TEXTURE_2D, canvas_->light.texture());
        program.set("samples", view.samples);
        const bool is_luminance = view.picture == Picture::total ||
                                  view.picture == Picture::direct ||
                                  view.picture == Picture::indirect;
        program.set("mode", is_luminance ? 0 : view.picture == Picture::lux ? 1 : 2);
        program.set("factor", std::exp2(view.exposure));
        program.set("maximum", view.lux_maximum);
        program.set("divisions", 1.0 * view.lux_divisions);
        program.set("filmic", view.tone_curve ? 1 : 0);
        program.set("contours", view.contours ? 1 : 0);
        cover();
    }

    void cover() const {
        gl_.bind_vertex_array(covering_.name());
        gl_.draw_arrays(GL_TRIANGLES, 0, 3);
        gl_.bind_vertex_array(0);
    }

    GlFunctions gl_;
    SceneScale scale_;
    std::vector<Quad> quads_;
    SurfaceRecords surfaces_;
    IndexDrawing indices_;
    GlObject lighting_, developing_, covering_;
    RecordBuffer surface_buffer_, lamp_buffer_, emitter_buffer_, shaft_buffer_;
    GlObject shown_, exact_;
    LampMaps lamp_maps_;
    int lamp_count_ = 0, emitter_count_ = 0, first_list_ = 0;
    std::optional<Canvas> canvas_;
    std::optional<CameraRays> rays_;
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
void FrameRenderer::draw(const Camera& camera, const FrameView& view, int width, int height) {
    drawing_->draw(camera, view, width, height);
}
LinearPicture FrameRenderer::linear(const Camera& camera, const FrameView& view, int width,
                                    int height) {
    return drawing_->linear(camera, view, width, height);
}
std::optional<SeenSurface> FrameRenderer::seen_at(int x, int y) const {
    return drawing_->seen_at(x, y);
}
std::uint64_t FrameRenderer::most_coefficients() const {
    return drawing_->surfaces().most_coefficients;
}
int FrameRenderer::deepest_level() const {
    return drawing_->surfaces().deepest_level;
}

}  // namespace lightwell
