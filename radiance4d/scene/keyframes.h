#pragma once

#include <vector>

#include "radiance4d/scene/scene.h"

namespace lightwell {

/// A camera at a time.
struct CameraKey {
    double time = 0;  ///< [s]
    Camera camera;
};

/// A light at a time.
struct LightKey {
    double time = 0;  ///< [s]
    Light light;
};

/// How a camera and lights move: what they are at some times, and smoothly in between.
///
/// Every number goes through its keys by a piecewise cubic with a continuous slope that nowhere
/// leaves the range of the two keys round about (Fritsch and Butland 1984), so that what rests
/// between two keys rests, and no intensity turns negative. Before the first key and after the last
/// all is as it is there.
struct Keyframes {
    double frames_per_second = 25;              ///< positive
    std::vector<CameraKey> camera;              ///< times ascend; may be empty
    std::vector<std::vector<LightKey>> lights;  ///< of each light: not empty, times ascend

    double begin() const;  ///< time of the first key of all [s]; 0 where there is none
    double end() const;    ///< time of the last key of all [s]
    /// Pictures from the begin to the end, both included.
    int frames() const;
    /// The time of a picture, counted from 0 [s].
    double time_of(int frame) const { return begin() + frame / frames_per_second; }

    /// There must be a camera.
    Camera camera_at(double time) const;
    /// `others`, with the lights that move in the place of those of the same name, or added.
    std::vector<Light> lights_at(double time, std::vector<Light> others) const;
};

}  // namespace lightwell
