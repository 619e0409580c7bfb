#include "viewer/stability/stability_rows.h"

#include "viewer/stability/direct_rows.h"
#include "viewer/stability/energy_rows.h"
#include "viewer/stability/leak_rows.h"
#include "viewer/stability/motion_rows.h"
#include "viewer/stability/shadow_rows.h"
#include "viewer/stability/shape_rows.h"
#include "viewer/stability/symmetry_rows.h"

namespace lightwell::stability {

const std::vector<StabilityRow>& stability_rows() {
    static const std::vector<StabilityRow> rows = {
        {"F1", "corner singularities", "cube of 4 m, office", corner_singularity},
        {"F2", "light leaks", "two rooms, one floor", light_leak},
        {"F3", "shadow leaks", "slab sunk into a wall", shadow_leak},
        {"F4", "small occluders", "table leg of 5 cm", small_occluder},
        {"F5", "discontinuities", "rectangle under a lamp", shadow_edge},
        {"F6", "penumbrae", "square under a square light", penumbra},
        {"F7", "blocks", "office", blocks},
        {"F8", "albedo near 1", "cube of 3 m, .95 to .99", bright_room},
        {"F9", "energy lost by truncation", "furnace with blocks", truncated_energy},
        {"F10", "truncated series", "furnaces, .9 to .99", truncated_series},
        {"F11", "grazing receivers", "lamp 1 mm to 1 m over a floor", grazing_receiver},
        {"F12", "rim of the directional map", "hemisphere", direction_map_rim},
        {"F13", "T-vertices", "office in 6 to 15 quads", t_vertices},
        {"F14", "coplanar and crossing quads", "furnace at three scales", crossing_quads},
        {"F15", "aliasing of occlusion", "window behind strips", occlusion_aliasing},
        {"F16", "flicker", "lamp at 1 cm a frame", flicker},
        {"F17", "ghosting", "lamp there and back, 1,000 edits", ghosting},
        {"F18", "ringing", "dark corridor with a screen", ringing},
        {"F19", "reciprocity", "office with a block", reciprocity},
        {"F20", "bias of the frame", "office turned and moved", turned_frame},
        {"F21", "linearity", "two coloured lamps", linearity},
        {"F22", "spot edges", "cones of 15 to 75 degrees", spot_cone_edge},
        {"F23", "opening edges", "CIE 171, 5.6, point A", opening_edge},
        {"X1", "rays along edges", "lamps in the planes of a block", rays_along_edges},
        {"X2", "needle quads", "furnace with 1:10,000", needle_quads},
        {"X3", "scale", "rooms of 1 mm, 1 m and 1 km", any_scale},
        {"X4", "lamp on a surface", "room of 4 x 4 x 3 m", lamp_on_a_surface},
        {"X5", "lamp outside", "room of 4 x 4 x 3 m", lamp_outside},
        {"X6", "nothing to see", "no quad, one, two", nothing_to_see},
        {"X7", "black and white", "room of 4 x 3 x 2.5 m", black_and_white},
        {"X8", "no lamp and 1,000", "office", many_lamps},
    };
    return rows;
}

}  // namespace lightwell::stability
