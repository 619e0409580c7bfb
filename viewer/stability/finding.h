#pragma once

#include <string>
#include <vector>

namespace lightwell::stability {

/// One number that tells how a method fails in a situation where such methods do. Smaller is
/// better.
struct Finding {
    std::string what;
    double reached = 0;
    double wanted = 0;  ///< the criterion: no more than this
    /// Where the criterion is out of reach: what holds instead. 0: the criterion holds.
    double known_limit = 0;

    double bound() const { return known_limit > 0 ? known_limit : wanted; }
    bool meets() const { return reached <= wanted; }
    /// False where something has got worse than is known. Never true of a number that is none.
    bool holds() const { return reached <= bound(); }
};

/// A situation in which finite-element methods for light are known to fail.
struct StabilityRow {
    const char* name;     ///< "F1" to "F23" as in the list of failure modes, "X1" on for our own
    const char* failure;  ///< what goes wrong
    const char* scene;    ///< where it is looked for
    std::vector<Finding> (*measure)();  ///< builds the scene, computes and compares: seconds
};

}  // namespace lightwell::stability
