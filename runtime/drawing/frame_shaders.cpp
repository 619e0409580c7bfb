#include "runtime/drawing/frame_shaders.h"

#include "runtime/drawing/direct_light_shaders.h"

namespace lightwell {

namespace {

constexpr const char* surface_access = R"(
uniform samplerBuffer surfaces;  // SurfaceRecords
uniform int first_element;
const int per_quad = 10, per_element = 3;
// Nearer to a quad's plane than this a point lies in it; lengths are parts of the scene's diagonal.
const float contact = 3e-6;

vec3 vertex_of(int quad, int k) {
    return texelFetch(surfaces, per_quad * quad + (k & 3)).xyz;
}
vec3 normal_of(int quad) {
    return texelFetch(surfaces, per_quad * quad + 4).xyz;
}
int element_on(int quad, bool front) {
    return int(texelFetch(surfaces, per_quad * quad + (front ? 0 : 1)).w);
}
vec3 reflectance_of(int quad, bool front) {  // over pi
    return texelFetch(surfaces, per_quad * quad + (front ? 5 : 7)).rgb;
}
vec3 emission_of(int quad, bool front) {
    return texelFetch(surfaces, per_quad * quad + (front ? 6 : 8)).rgb;
}
vec4 place_of(int element) {
    return texelFetch(surfaces, first_element + per_element * element);
}
vec4 lobe_of(int quad) {
    return texelFetch(surfaces, per_quad * quad + 9);
}
vec4 cells_of(int element) {
    return texelFetch(surfaces, first_element + per_element * element + 1);
}
vec4 lobe_place_of(int element) {
    return texelFetch(surfaces, first_element + per_element * element + 2);
}
)";

// What every pixel sees. Along edges the drawing is right to a fraction of a pixel only, and may
// leave cracks where a quad's vertex lies on another's edge; so where the pixels round about show
// other quads too, the ray is met with all of these and the nearest is taken.
constexpr const char* seen_surface = R"(
uniform isampler2D seen;
uniform vec3 eye;
uniform mat3 frame;
uniform vec4 pixel;  // scale and shift from window coordinates to the ray's X, then Y
uniform float pixel_angle;

float distance_along(vec3 ray, int quad) {
    vec3 normal = normal_of(quad);
    return dot(normal, vertex_of(quad, 0) - eye) / dot(normal, ray);
}
bool is_met(vec3 ray, int quad) {
    float t = distance_along(ray, quad);
    if (!(t > 0.0)) return false;
    vec3 normal = normal_of(quad), at = eye + t * ray;
    vec3 last = vertex_of(quad, 3);
    for (int k = 0; k < 4; ++k) {
        vec3 next = vertex_of(quad, k);
        if (dot(cross(next - last, at - last), normal) < -1e-7 * length(next - last)) return false;
        last = next;
    }
    return true;
}
bool faces(vec3 ray, int quad) {
    return dot(normal_of(quad), ray) < 0.0;
}
int quad_along(vec3 ray) {
    ivec2 at = ivec2(gl_FragCoord.xy), most = textureSize(seen, 0) - 1;
    int quad = texelFetch(seen, at, 0).r;
    ivec4 around = ivec4(texelFetch(seen, max(at - ivec2(1, 0), ivec2(0)), 0).r,
                         texelFetch(seen, min(at + ivec2(1, 0), most), 0).r,
                         texelFetch(seen, max(at - ivec2(0, 1), ivec2(0)), 0).r,
                         texelFetch(seen, min(at + ivec2(0, 1), most), 0).r);
    int met = -1;
    float nearest = 0.0;
    for (int k = 0; k < (all(equal(around, ivec4(quad))) ? 0 : 5); ++k) {
        int other = k == 0 ? quad : around[k - 1];
        if (other < 0 || other == met || !is_met(ray, other)) continue;
        float t = distance_along(ray, other);
        // Where several quads share an edge, one that is seen from the front.
        bool is_tie = met >= 0 && abs(t - nearest) <= 1e-5 * t;
        if (met < 0 || (is_tie ? faces(ray, other) && !faces(ray, met) : t < nearest)) {
            met = other;
            nearest = t;
        }
    }
    if (met >= 0) return met;
    // A crack as narrow as rounding: nothing but surface is round about, so surface belongs here.
    return quad < 0 && all(greaterThanEqual(around, ivec4(0))) ? around.x : quad;
}
)";

constexpr const char* indirect_light = R"(
uniform sampler2D shown;  // TextureAtlas
uniform sampler2D exact;
uniform sampler2D lobes, emitted_lobes;
uniform bool bilinear;

// (u,v) of a point in the plane of a quad, by Newton's method on the bilinear map.
vec2 parameters(int quad, vec3 point) {
    vec3 v0 = vertex_of(quad, 0), v1 = vertex_of(quad, 1);
    vec3 v2 = vertex_of(quad, 2), v3 = vertex_of(quad, 3);
    vec2 uv = vec2(0.5);
    for (int step = 0; step < 8; ++step) {
        vec3 rest = point - mix(mix(v0, v1, uv.x), mix(v3, v2, uv.x), uv.y);
        vec3 a = mix(v1 - v0, v2 - v3, uv.y), b = mix(v3 - v0, v2 - v1, uv.x);
        float aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
        float determinant = aa * bb - ab * ab;
        if (!(determinant > 0.0)) break;
        float ra = dot(a, rest), rb = dot(b, rest);
        vec2 change = vec2(bb * ra - ab * rb, aa * rb - ab * ra) / determinant;
        uv += change;
        if (dot(change, change) < 1e-12) break;
    }
    return clamp(uv, 0.0, 1.0);
}

vec3 textured(sampler2D atlas, vec4 place, vec2 uv) {
    ivec2 corner = ivec2(place.xy);
    vec2 size = place.zw;
    if (!bilinear)
        return texelFetch(atlas, corner + ivec2(min(uv * size, size - 1.0)), 0).rgb;
    vec2 at = uv * size - 0.5, low = floor(at), part = at - low;
    ivec2 texel = corner + ivec2(low);
    return mix(mix(texelFetch(atlas, texel, 0).rgb,
                   texelFetch(atlas, texel + ivec2(1, 0), 0).rgb, part.x),
               mix(texelFetch(atlas, texel + ivec2(0, 1), 0).rgb,
                   texelFetch(atlas, texel + ivec2(1, 1), 0).rgb, part.x),
               part.y);
}
)";

// The ramp is false_colour.h's: lightness rises evenly (Oklab, Ottosson 2020).
constexpr const char* colour_ramp = R"(
vec3 from_oklab(float lightness, vec2 ab) {
    vec3 lms = lightness + vec3(dot(vec2(0.3963377774, 0.2158037573), ab),
                           dot(vec2(-0.1055613458, -0.0638541728), ab),
                           dot(vec2(-0.0894841775, -1.2914855480), ab));
    lms = lms * lms * lms;
    return clamp(vec3(dot(vec3(4.0767416621, -3.3077115913, 0.2309699292), lms),
                      dot(vec3(-1.2684380046, 2.6097574011, -0.3413193965), lms),
                      dot(vec3(-0.0041960863, -0.7034186147, 1.7076147010), lms)),
                 0.0, 1.0);
}
vec3 ramp_colour(float t) {
    float x = clamp(t, 0.0, 1.0), from_middle = 2.0 * x - 1.0;
    float chroma = 0.095 + 0.075 * from_middle * from_middle, hue = radians(300.0 - 195.0 * x);
    return from_oklab(0.28 + 0.65 * x, chroma * vec2(cos(hue), sin(hue)));
}
float luminance(vec3 light) {
    return dot(light, vec3(0.2126, 0.7152, 0.0722));
}
)";

constexpr const char* pictures = R"(
uniform float difference_range;
layout(location = 0) out vec4 light;

// The wavelet mesh: cells with dark borders a pixel and a half wide, fainter where cells are hardly
// wider.
vec3 mesh_colour(int quad, bool front, int element, vec2 uv, vec3 ray, float cosine,
                 float footprint) {
    vec4 cells = cells_of(element);
    if (!front) cells.xy = cells.yx;  // u and v change places behind
    vec3 v0 = vertex_of(quad, 0), v1 = vertex_of(quad, 1);
    vec3 v2 = vertex_of(quad, 2), v3 = vertex_of(quad, 3);
    vec3 along_u = mix(v1 - v0, v2 - v3, uv.y), along_v = mix(v3 - v0, v2 - v1, uv.x);
    // Across the lines of equal u, and of equal v, as they are seen: an area over a length.
    vec2 seen = cosine * length(cross(along_u, along_v)) /
                max(vec2(length(cross(along_v, ray)), length(cross(along_u, ray))), 1e-12);
    vec2 cell = seen / cells.xy / footprint;  // [pixels]
    vec2 at = uv * cells.xy, to_border = abs(at - round(at)) * cell;
    vec2 border = vec2(lessThan(to_border, vec2(0.75))) * smoothstep(2.0, 5.0, cell);
    vec3 colour = ramp_colour(cells.z) * (0.4 + 0.6 * cosine);
    return mix(1.0, 0.15, max(border.x, border.y)) * colour;
}

// Blue where there is too little light, red where there is too much, grey where it is right.
vec3 difference_colour(float difference) {
    float t = clamp(difference / difference_range, -1.0, 1.0);
    return mix(vec3(0.22), t < 0.0 ? vec3(0.0, 0.12, 0.8) : vec3(0.8, 0.04, 0.0), abs(t));
}

void main() {
    light = vec4(0.0, 0.0, 0.0, 1.0);
    vec3 ray = vec3(gl_FragCoord.xy * pixel.xz + pixel.yw, 1.0) * frame;
    int quad = quad_along(ray);
    if (quad < 0) return;
    float t = distance_along(ray, quad);
    vec3 point = eye + t * ray, normal = normal_of(quad);
    bool front = dot(normal, ray) < 0.0;
    if (!front) normal = -normal;
    float cosine = abs(dot(normal, normalize(ray))), footprint = t * length(ray) * pixel_angle;
    int element = element_on(quad, front);
    vec2 uv = parameters(quad, point);

    if (picture == 4 || picture == 5) {
        if (element < 0) light.rgb = vec3(0.02);
        else if (picture == 4)
            light.rgb = mesh_colour(quad, front, element, uv, normalize(ray), cosine,
                                    footprint);
        else
            light.rgb = ramp_colour(cells_of(element).w) * (0.4 + 0.6 * cosine);
        return;
    }
    vec3 direct = vec3(0.0), indirect = vec3(0.0), highlight = vec3(0.0);
    vec4 lobe = glossy ? lobe_of(quad) : vec4(0.0);
    if (picture != 2)
        direct = light_of_lamps(point, normal, quad, footprint / max(cosine, 0.1),
                                -normalize(ray), lobe, highlight) +
                 light_of_emitters(point, normal, quad, front, uv);
    vec2 side = front ? uv : uv.yx;  // a side's own u and v
    if (picture != 1 && element >= 0) indirect = textured(shown, place_of(element), side);
    if (picture == 6) {
        vec3 right = direct + (element >= 0 ? textured(exact, place_of(element), side) : vec3(0.0));
        float reference = luminance(right);
        float error = luminance(direct + indirect) - reference;
        light.rgb = difference_colour(reference > 0.0 ? error / reference : 0.0);
        return;
    }
    light.rgb = direct + indirect;
    if (picture == 3) return;
    light.rgb *= reflectance_of(quad, front);
    if (picture != 2) light.rgb += emission_of(quad, front) + lobe.rgb * highlight;
    vec4 place = glossy && element >= 0 ? lobe_place_of(element) : vec4(0.0);
    for (int k = 0; k < (place.z > 0.0 ? 1 : 0); ++k) {
        if (picture != 1) light.rgb += textured(lobes, place, side);
        if (picture != 2) light.rgb += textured(emitted_lobes, place, side);
    }
}
)";

// Filmic curve: Narkowicz 2016, a fit to the reference rendering of the Academy Color Encoding
// System. sRGB: IEC 61966-2-1.
constexpr const char* development = R"(
uniform sampler2D picture_light;
uniform int samples, width, height, mode;  // mode 0: tone, 1: false colours, 2: as it is
uniform float factor, maximum, divisions;
uniform bool filmic, contours;
layout(location = 0) out vec4 colour;

vec3 mean_at(ivec2 at) {
    // Where there are fewer samples than pixels, the one that the pixel lies in.
    ivec2 first = at * textureSize(picture_light, 0) / ivec2(width, height);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < samples * samples; ++k)
        sum += texelFetch(picture_light, first + ivec2(k % samples, k / samples), 0).rgb;
    return sum / float(samples * samples);
}
vec3 toned(vec3 light) {
    vec3 x = clamp(factor * light, 0.0, 1e6);
    if (!filmic) return min(x, 1.0);
    return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}
float part_of(vec3 light) {
    return floor(clamp(luminance(light) / maximum, 0.0, 1.0) * divisions);
}
vec3 false_coloured(ivec2 at, vec3 light) {
    if (contours && at.x + 1 < width && at.y > 0 &&
        (part_of(mean_at(at + ivec2(1, 0))) != part_of(light) ||
         part_of(mean_at(at - ivec2(0, 1))) != part_of(light)))
        return vec3(0.0);
    return ramp_colour(luminance(light) / maximum);
}
vec3 srgb_encoded(vec3 x) {
    return mix(1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, 12.92 * x,
               lessThanEqual(x, vec3(0.0031308)));
}
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 light = mean_at(at);
    vec3 shown = mode == 0 ? toned(light) : mode == 1 ? false_coloured(at, light) : light;
    colour = vec4(srgb_encoded(clamp(shown, 0.0, 1.0)), 1.0);
}
)";

}  // namespace

const char* covering_vertex_shader() {
    return R"(#version 330 core
void main() {
    gl_Position = vec4(vec2(gl_VertexID % 2, gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0);
}
)";
}

std::string lighting_shader(Picture picture, bool glossy) {
    return "#version 330 core\nconst int picture = " + std::to_string(static_cast<int>(picture)) +
           ";\nconst bool glossy = " + (glossy ? "true" : "false") + ";\n" + surface_access +
           seen_surface + lamp_light_functions() + emitter_light_functions() + indirect_light +
           colour_ramp + pictures;
}

std::string developing_shader() {
    return std::string("#version 330 core\n") + colour_ramp + development;
}

}  // namespace lightwell
