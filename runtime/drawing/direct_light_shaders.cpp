#include "runtime/drawing/direct_light_shaders.h"

namespace lightwell {

namespace {

// Of the quads between a point and a lamp those are looked at that the lamp's map shows.
//
// Here and below, work that few pixels need stands in loops that run no times for the others:
// processors that draw (llvmpipe) skip those, and go through both branches of an if.
constexpr const char* lamp_light = R"(
uniform samplerBuffer lamps;  // LampRecords
uniform int lamp_count;
uniform isampler2DArray lamp_maps;
uniform int lamp_side;
uniform float lamp_reach;

// Window coordinates in a map with faces of `side` pixels, of what lies `away` from its lamp.
vec2 map_place(vec3 away, float side, float reach, out ivec2 corner) {
    vec3 size = abs(away);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int face = 2 * axis + (away[axis] < 0.0 ? 1 : 0);
    vec2 at = vec2(away[(axis + 1) % 3], away[(axis + 2) % 3]) / (size[axis] * reach);
    corner = ivec2(face % 3, face / 3) * int(side);
    return (0.5 * at + 0.5) * side;
}

// The share that a quad hides of a lamp, seen from a point in `direction` from the lamp: all or
// nothing but for a band `width` [radians] wide along its edges. Where the point is nearer to the
// quad than `footprint` the band is narrower, or light would leak under walls. x if the lamp is
// before the quad's front, y if behind it.
vec2 hidden_by(int quad, vec3 lamp, vec3 point, vec3 direction, float width, float footprint) {
    vec3 normal = normal_of(quad), base = vertex_of(quad, 0);
    float before = dot(normal, lamp - base), behind = dot(normal, point - base);
    if (before * behind >= 0.0 || abs(behind) <= contact) return vec2(0.0);
    float inwards = before > 0.0 ? -1.0 : 1.0, inside = 4.0;
    vec3 last = vertex_of(quad, 3) - lamp;
    for (int k = 0; k < 4; ++k) {
        vec3 next = vertex_of(quad, k) - lamp, edge = cross(last, next);
        float size = length(edge);
        if (size > 0.0) inside = min(inside, inwards * dot(edge, direction) / size);
        last = next;
    }
    float band = width * clamp(abs(behind) / footprint, 1e-3, 1.0);
    float share = clamp(0.5 + inside / band, 0.0, 1.0);
    return before > 0.0 ? vec2(share, 0.0) : vec2(0.0, share);
}

int quad_seen(ivec2 texel, ivec2 corner, int layer) {
    return texelFetch(lamp_maps,
                      ivec3(corner + clamp(texel, ivec2(0), ivec2(lamp_side - 1)), layer), 0).r;
}

// Neighbouring quads hide side by side, so what they hide adds up. Of a solid the faces towards the
// lamp hide what those away from it hide, so the two sums do not.
float hidden_share(int layer, vec3 lamp, vec3 point, int own, float footprint) {
    vec3 away = point - lamp, direction = normalize(away);
    ivec2 corner;
    ivec2 at = ivec2(floor(map_place(away, float(lamp_side), lamp_reach, corner)));
    float width = clamp(footprint / length(away), 1e-6, 1.5 / float(lamp_side));
    int others = 0;
    for (int k = 0; k < 9; ++k) {
        int quad = quad_seen(at + ivec2(k % 3, k / 3) - 1, corner, layer);
        if (quad >= 0 && quad != own) ++others;
    }
    vec2 hidden = vec2(0.0);
    ivec4 met = ivec4(-1), met_before = ivec4(-1);
    for (int k = 0; k < (others > 0 ? 9 : 0); ++k) {
        int quad = quad_seen(at + ivec2(k % 3, k / 3) - 1, corner, layer);
        if (quad < 0 || quad == own || any(equal(met, ivec4(quad))) ||
            any(equal(met_before, ivec4(quad))))
            continue;
        met_before = ivec4(met.w, met_before.xyz);
        met = ivec4(quad, met.xyz);
        hidden += hidden_by(quad, lamp, point, direction, width, footprint);
    }
    return min(1.0, max(hidden.x, hidden.y));
}

float falloff(float cosine, float inner, float outer) {
    if (cosine >= inner) return 1.0;
    if (cosine <= outer) return 0.0;
    float t = (cosine - outer) / (inner - outer);
    return t * t * (3.0 - 2.0 * t);
}

// UnitPhong::value and UnitGgx::value.
float lobe_value(float shape, vec3 normal, vec3 from, vec3 to) {
    if (shape >= 0.0) {
        float cosine = dot(2.0 * dot(normal, from) * normal - from, to);
        return cosine > 0.0 ? (shape + 2.0) / 6.283185307179586 * pow(cosine, shape) : 0.0;
    }
    float square = shape * shape, in_cosine = dot(normal, from), out_cosine = dot(normal, to);
    if (!(in_cosine > 0.0 && out_cosine > 0.0)) return 0.0;
    vec2 cosines = vec2(in_cosine, out_cosine), squares = cosines * cosines;
    vec2 hidden = 0.5 * (sqrt(squares + square * (1.0 - squares)) - cosines);
    vec3 middle = normalize(from + to);
    float along = dot(middle, normal);
    vec3 across = middle - along * normal;
    float spread = dot(across, across) + square * along * along;
    return square / (3.141592653589793 * spread * spread) /
           (4.0 * (in_cosine * out_cosine + out_cosine * hidden.x + in_cosine * hidden.y));
}

// Irradiance; `highlight` is what a lobe of reflectance 1 makes of it in the direction `towards`.
vec3 light_of_lamps(vec3 point, vec3 normal, int own, float footprint, vec3 towards, vec4 lobe,
                    out vec3 highlight) {
    highlight = vec3(0.0);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < lamp_count; ++k) {
        vec3 lamp = texelFetch(lamps, 3 * k).xyz;
        vec4 intensity = texelFetch(lamps, 3 * k + 1);
        vec4 axis = texelFetch(lamps, 3 * k + 2);
        vec3 way = lamp - point;
        float square = dot(way, way), cosine = dot(normal, way) * inversesqrt(square);
        if (!(cosine > 0.0)) continue;
        float share = falloff(-dot(axis.xyz, way) * inversesqrt(square), intensity.w, axis.w);
        if (share > 0.0) share *= 1.0 - hidden_share(k, lamp, point, own, footprint);
        vec3 light = intensity.rgb * (share * cosine / square);
        sum += light;
        for (int g = 0; g < (glossy && lobe.rgb != vec3(0.0) ? 1 : 0); ++g)
            highlight += light * lobe_value(lobe.w, normal, way * inversesqrt(square), towards);
    }
    return sum;
}
)";

// Emitting quads: Lambert's formula, and where something stands between, cell by cell with the
// share of each cell that is hidden.
constexpr const char* emitter_light = R"(
uniform samplerBuffer emitters;  // indices of the quads
uniform int emitter_count;
uniform samplerBuffer shafts;  // EmitterShafts
uniform int first_list;
const int most_hiding = 24, emitter_cells = 3;

vec3 on_quad(vec3 v[4], vec2 uv) {
    return mix(mix(v[0], v[1], uv.x), mix(v[3], v[2], uv.x), uv.y);
}

// The angle between two vectors times the component along `normal` of their common normal.
float edge_term(vec3 a, vec3 b, vec3 normal) {
    vec3 across = cross(a, b);
    float size = length(across);
    return size > 0.0 ? atan(size, dot(a, b)) * dot(across, normal) / size : 0.0;
}

// The share of the cosine-weighted hemisphere that a quad covers (Lambert 1760; Baum et al. 1989,
// equation 5), cut off at the horizon.
float form_factor(vec3 point, vec3 normal, vec3 v[4]) {
    float sum = 0.0;
    vec3 leaving = vec3(0.0), coming = vec3(0.0);
    vec3 a = v[3] - point;
    float height = dot(a, normal);
    for (int k = 0; k < 4; ++k) {
        vec3 b = v[k] - point;
        float next = dot(b, normal);
        if (height > 0.0 || next > 0.0) {
            vec3 from = a, to = b;
            if (height <= 0.0) from = coming = mix(a, b, height / (height - next));
            if (next <= 0.0) to = leaving = mix(a, b, height / (height - next));
            sum += edge_term(from, to, normal);
        }
        a = b;
        height = next;
    }
    sum += edge_term(leaving, coming, normal);
    return abs(sum) / 6.283185307179586;
}

// The share of a cell, given by its middle and two sides, that a quad hides from a point. x and y as
// in hidden_by.
vec2 hidden_of_cell(int quad, vec3 point, vec3 middle, vec3 across, vec3 up) {
    vec3 normal = normal_of(quad), base = vertex_of(quad, 0);
    float height = dot(normal, point - base);
    if (abs(height) <= contact) return vec2(0.0);
    float away = height > 0.0 ? 1.0 : -1.0;
    float width = abs(dot(normal, across)) + abs(dot(normal, up));
    float behind = -away * dot(normal, middle - base) - contact;
    behind = clamp(0.5 + behind / max(width, contact), 0.0, 1.0);
    if (behind <= 0.0) return vec2(0.0);
    float within[4];
    vec3 last = vertex_of(quad, 3) - point;
    for (int k = 0; k < 4; ++k) {
        vec3 next = vertex_of(quad, k) - point, edge = cross(last, next);
        float span = abs(dot(edge, across)) + abs(dot(edge, up));
        float inside = -away * dot(edge, middle - point);
        within[k] = span > 0.0 ? clamp(0.5 + inside / span, 0.0, 1.0) : 1.0;
        last = next;
    }
    float share = behind * max(0.0, within[0] + within[2] - 1.0) *
                  max(0.0, within[1] + within[3] - 1.0);
    return away > 0.0 ? vec2(0.0, share) : vec2(share, 0.0);
}

// What hides some of an emitter from a point.
int collect_hiding(vec3 v[4], vec3 point, int first, int number, out int hiding[most_hiding]) {
    vec3 middle = 0.25 * (v[0] + v[1] + v[2] + v[3]);
    vec3 across = 0.5 * (v[1] + v[2] - v[0] - v[3]), up = 0.5 * (v[2] + v[3] - v[0] - v[1]);
    int count = 0;
    for (int k = first; k < first + number && count < most_hiding; ++k) {
        int quad = int(texelFetch(shafts, first_list + k / 4)[k % 4]);
        if (hidden_of_cell(quad, point, middle, across, up) != vec2(0.0)) hiding[count++] = quad;
    }
    return count;
}

float light_of_emitter(int emitter, int first, int number, vec3 point, vec3 normal) {
    vec3 v[4];
    for (int k = 0; k < 4; ++k)
        v[k] = vertex_of(emitter, k);
    int hiding[most_hiding];
    int count = collect_hiding(v, point, first, number, hiding);
    float sum = count == 0 ? form_factor(point, normal, v) : 0.0;
    for (int k = 0; k < (count == 0 ? 0 : emitter_cells * emitter_cells); ++k) {
        vec2 low = vec2(k % emitter_cells, k / emitter_cells) / float(emitter_cells);
        vec2 high = low + 1.0 / float(emitter_cells);
        vec3 cell[4];
        cell[0] = on_quad(v, low);
        cell[1] = on_quad(v, vec2(high.x, low.y));
        cell[2] = on_quad(v, high);
        cell[3] = on_quad(v, vec2(low.x, high.y));
        vec3 middle = 0.25 * (cell[0] + cell[1] + cell[2] + cell[3]);
        vec3 across = 0.5 * (cell[1] + cell[2] - cell[0] - cell[3]);
        vec3 up = 0.5 * (cell[2] + cell[3] - cell[0] - cell[1]);
        vec2 hidden = vec2(0.0);
        for (int m = 0; m < count; ++m)
            hidden += hidden_of_cell(hiding[m], point, middle, across, up);
        float visible = 1.0 - min(1.0, max(hidden.x, hidden.y));
        if (visible > 0.0) sum += visible * form_factor(point, normal, cell);
    }
    return sum;
}

// `uv` are the parameters of the quad's front.
vec3 light_of_emitters(vec3 point, vec3 normal, int own, bool front, vec2 uv) {
    vec3 sum = vec3(0.0);
    if (emitter_count == 0) return sum;
    vec4 side = texelFetch(shafts, 2 * own + (front ? 0 : 1));
    ivec2 part = ivec2(min(uv * side.xy, side.xy - 1.0));
    int shaft = int(side.z) + (part.y * int(side.x) + part.x) * emitter_count;
    for (int k = 0; k < emitter_count; ++k) {
        vec2 list = texelFetch(shafts, shaft + k).xy;
        if (list.y < 0.0) continue;
        int quad = int(texelFetch(emitters, k).x);
        float height = dot(normal_of(quad), point - vertex_of(quad, 0));
        if (abs(height) <= contact) continue;
        vec3 emission = emission_of(quad, height > 0.0);
        if (emission == vec3(0.0)) continue;
        sum += 3.141592653589793 * emission *
               light_of_emitter(quad, int(list.x), int(list.y), point, normal);
    }
    return sum;
}
)";

}  // namespace

const char* lamp_light_functions() {
    return lamp_light;
}

const char* emitter_light_functions() {
    return emitter_light;
}

}  // namespace lightwell
