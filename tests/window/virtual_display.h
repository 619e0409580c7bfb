#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace lightwell {

/// A display in memory (Xvfb) that programs started from now on open their windows on; it goes with
/// its owner.
class VirtualDisplay {
  public:
    VirtualDisplay();
    ~VirtualDisplay();
    VirtualDisplay(const VirtualDisplay&) = delete;
    VirtualDisplay& operator=(const VirtualDisplay&) = delete;

    /// Whether there is one: Xvfb is installed and has started.
    bool is_there() const { return !name_.empty(); }

  private:
    pid_t server_ = -1;
    std::string name_;
};

/// Whether a program of that name can be started.
bool is_installed(const std::string& program);

/// Runs xdotool: real key and mouse events, of the kind that a person makes. @return what it prints
std::string xdotool(const std::string& words);

}  // namespace lightwell
