#pragma once

#include "radiance4d/operator/global_transport.h"

namespace lightwell {

/// A scene of which nothing is computed yet, to be looked at in direct light alone: one cell on
/// every side that sees something, and operators that carry nothing.
GlobalTransport first_look(const Scene& scene);
/// Whether anything has been computed.
bool is_computed(const GlobalTransport& transport);

}  // namespace lightwell
