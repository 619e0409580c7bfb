#pragma once

#include <vector>

#include "solver/reference/radiance_tracer.h"

namespace lightwell {

/// A closed room without lamps, with a block on a floor of that lobe.
Scene room_with_floor(const Lobe& lobe);

/// Three eyes that look at the room's floor, and which points of it they see.
std::vector<RadianceProbe> probes_of(const Visibility& visibility);

/// Relative root mean square error with the judge's noise taken off.
double deviation(const std::vector<Rgb>& seen, const LightSurvey& survey);

}  // namespace lightwell
