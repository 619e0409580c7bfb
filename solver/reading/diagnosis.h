#pragma once

#include <string>
#include <vector>

#include "radiance4d/scene/scene.h"
#include "solver/reading/reading_report.h"

namespace lightwell {

/// What may be wrong with the quads of a scene.
enum class Defect {
    degenerate,        ///< a quad without area
    bent,              ///< a quad off its mean plane
    duplicate,         ///< a quad with the corners of an earlier one
    overlapping,       ///< two quads of one plane with an area in common
    interpenetrating,  ///< two quads that go through each other
    flipped,           ///< a quad that faces against its neighbours
    t_vertex,          ///< a vertex inside another quad's side
    open_edge          ///< a side, or a part of one, with nothing beside it
};

/// How often a defect was found, where, and what it means for light.
struct Finding {
    Defect defect;
    int count = 0;
    int left_out = 0;  ///< of these, polygons that are no quads of the scene: see with_left_out
    std::vector<int> examples;  ///< the quads of the first few
    bool matters = false;       ///< whether it changes the light in this scene
    std::string meaning;        ///< one line
};

/// The state of a scene's geometry. It is advice: no scene is refused for it.
struct Diagnosis {
    std::vector<Finding> findings;  ///< one of each kind, in the order of Defect
    int surfaces = 0;               ///< pieces that hang together by their sides
    int closed_surfaces = 0;        ///< those of them that are closed
    bool complete = true;           ///< false if the search for contacts was cut short

    const Finding& of(Defect defect) const { return findings[static_cast<std::size_t>(defect)]; }
};

/// When the search is cut short, so that no scene, however tangled, takes more than seconds.
struct DiagnosisRule {
    long long most_tests = 20'000'000;  ///< pairs of quads, or of a vertex and a quad, looked at
};

/// Examines a scene. Lengths below a millionth of its diagonal count as nothing. Time grows with
/// the number of quads and of their contacts, but for a logarithm.
Diagnosis diagnose(const Scene& scene, const DiagnosisRule& rule = {});

/// Counts what reading left out, too: polygons without area, and copies.
Diagnosis with_left_out(Diagnosis diagnosis, const PolygonCounts& counts);

/// "degenerate quads", "T-vertices", ...
std::string name_of(Defect defect);

/// A line for each finding, with the scene's lines of the first few.
std::string to_string(const Diagnosis& diagnosis, const Scene& scene);

}  // namespace lightwell
