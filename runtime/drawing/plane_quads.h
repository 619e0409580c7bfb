#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/quad.h"
#include "runtime/drawing/gl_functions.h"
#include "runtime/drawing/gl_objects.h"

namespace lightwell {

/// A shader for quads whose depth is taken from their planes themselves and not interpolated: in
/// floating point it keeps the same relative precision from the eye to the horizon. Before `body`
/// stand the version and
///
///     uniform float nearest;                      // nothing nearer along the axis is drawn
///     vec4 drawn_at(vec2 place, float forward)    // gl_Position
///     float depth_of(vec3 plane, vec2 ray)        // gl_FragDepth: nearest / distance along it
///
/// where the plane n.x = d, in coordinates right, up and forward, is given as n / d, and the ray
/// is (X, Y, 1).
std::string plane_shader(const char* body);

/// Quads with their planes on the graphics processor.
class PlaneQuads {
  public:
    /// Attributes of a vertex: 0 the corner, 1 and 2 the normal and a point of the plane.
    /// @param planes  the quad whose plane each one lies in: the same bits for all parts of one
    PlaneQuads(const GlFunctions& gl, const std::vector<Quad>& quads,
               const std::vector<Quad>& planes);

    /// What draw() needs, until another vertex array is bound.
    void bind(const GlFunctions& gl) const { gl.bind_vertex_array(vertex_array_.name()); }
    /// Draws quads; what is bound is this.
    static void draw(const GlFunctions& gl, std::size_t first, std::size_t count);

  private:
    GlObject vertex_array_, vertices_, elements_;
};

}  // namespace lightwell
