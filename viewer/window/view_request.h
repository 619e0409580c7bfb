#pragma once

#include <optional>
#include <string>

#include "runtime/propagation/global_propagation.h"
#include "viewer/commands/arguments.h"
#include "viewer/commands/projection_choice.h"
#include "viewer/window/loading.h"

namespace lightwell {

/// What `lightwell view` was asked for.
struct ViewRequest {
    std::string subject;                ///< a .gto file, or a scene as for precompute
    SceneComputation computation;       ///< of a scene
    std::optional<std::string> lights;  ///< a file of lights, and perhaps a view; the scene's own
    std::optional<std::string> camera;  ///< a file with a camera; the scene's own
    PixelSize size{1280, 800};          ///< of the window's content
    ProjectionWay projection = ProjectionWay::fastest;  ///< of lamps
    std::optional<ValueFormat> rows;    ///< how the operator's rows are held; as fits its error
    std::optional<std::string> replay;  ///< a file of recorded input, see recording.h
    std::optional<std::string> record;  ///< a file to record input to
};

}  // namespace lightwell
