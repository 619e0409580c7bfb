#pragma once

#include <string>

#include "radiance4d/scene/keyframes.h"

namespace lightwell {

/// Reads a path of keyframes:
///
///     frames_per_second = 25       # default
///
///     [[camera]]                   # as [camera] of a scene file, and
///     time = 0                     # [s], ascending
///
///     [[light]]                    # as [[light]] of a scene file, and
///     name = "lamp"                # must be there: keys of one name are one light, of one type
///     time = 0                     # [s], ascending among those
///
/// @param up the direction that is up unless a camera says
/// @throws InputError with file, line and column for whatever is wrong with it, unknown keys and
/// wrong types included, if it holds no key, or if it is longer than 100,000 pictures
Keyframes read_path(const std::string& path, const Vec3& up = Vec3::UnitZ());

}  // namespace lightwell
