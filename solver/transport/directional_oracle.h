#pragma once

#include <vector>

#include "radiance4d/basis/angular_reflection.h"
#include "solver/transport/link.h"

namespace lightwell {

/// How much finer directions matter on a side: by angular level l, the norm of what the material
/// makes of a function that tells apart the cells of a level below l, relative to what it makes of
/// the angular mean; 0 at the finest level. It does not grow with l.
using AngularDetail = std::vector<double>;

/// The detail of a material in its wavelet representation (WRT section 4.3.2).
///
/// @param diffuse, specular  reflectances of both parts
AngularDetail angular_detail(const AngularReflection& lobe, double diffuse, double specular);

/// One end of a link between sides of which at least one has angular cells.
struct DirectedEnd {
    const Element* element = nullptr;
    const AngularDetail* detail = nullptr;
    Cell space;
    Quad outline;      ///< of the spatial cell
    double reach = 0;  ///< largest distance of its vertices from its centre [m]
};

/// A link between two spatial cells, all directions together.
struct DirectedCandidate {
    DirectedEnd receiver;
    DirectedEnd sender;
    double exchange = 0;  ///< area, visibility included [m2]
    double distance = 0;  ///< between the centres [m]
};

/// What is to become of it.
struct DirectedVerdict {
    unsigned sub_domains = 0;  ///< which SubDomains to refine: one of 16 combinations
    int receiver_angle = 0;    ///< angular level to which the receiver's directions are told apart
    int sender_angle = 0;
};

struct DirectionalOracleOptions {
    /// Largest share that one link may be wrong by, of the rms field over the scene, for directions
    /// that it does not tell apart: the exchange over sqrt(A_r A_s), times sqrt(max(A_r,A_s) /
    /// scene area), times the detail. > 0; 0 refines everything.
    double tolerance = 5e-5;
};

/// Decides how finely a link tells directions apart, knowing that they depend on place: seen from
/// one cell, the other fills a certain part of the directions. Angular cells much wider than that
/// are refined, since all but one of their children would carry nothing. Narrower ones are linked
/// to smaller cells in space: a narrow lobe is not linked to a wide receiver. Both go on only as
/// far as the error matters that stopping would make.
class DirectionalOracle {
  public:
    /// @param scene_area  of all elements [m2]
    DirectionalOracle(const DirectionalOracleOptions& options, double scene_area)
        : options_(options), scene_area_(scene_area) {}

    DirectedVerdict judge(const DirectedCandidate& link) const;

  private:
    int angular_level(const DirectedEnd& end, double spread, double importance) const;
    bool matters(const DirectedEnd& end, double spread, double importance) const;

    DirectionalOracleOptions options_;
    double scene_area_;
};

}  // namespace lightwell
