#pragma once

namespace lightwell {

// Parts of the lighting shader; they read surfaces through vertex_of, normal_of and emission_of.

/// vec3 light_of_lamps(point, normal, own quad, footprint): illuminance [lx] of lamps past what
/// their maps show (LampMaps). `footprint` is the width over which edges of shadows are smoothed.
const char* lamp_light_functions();

/// vec3 light_of_emitters(point, normal, own quad, front, uv): illuminance of emitting quads [lx],
/// past what may stand between (EmitterShafts).
const char* emitter_light_functions();

}  // namespace lightwell
