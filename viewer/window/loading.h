#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "radiance4d/progress.h"
#include "solver/precompute.h"
#include "solver/reading/bare_geometry.h"
#include "solver/reading/scene_reader.h"
#include "viewer/commands/opened_operator.h"

namespace lightwell {

/// What a failure says to people.
std::string message_of(const std::exception_ptr& failure);

/// An operator on its way into the window.
using SharedOperator = std::shared_ptr<const OpenedOperator>;

/// Where loading stands.
struct LoadingState {
    std::string doing;              ///< for people: "reading box.gto", "5 %: links"
    double share = 0;               ///< of the work now under way, in [0,1]
    bool is_over = false;           ///< nothing more will come
    std::vector<std::string> said;  ///< what people should know of what is loaded
    std::exception_ptr failure;     ///< why it ended early; null if it did not
};

/// Work on a thread of its own that brings operators into the window, one or, each better than the
/// one before, several. Stops and waits for its thread at the end.
class Loading {
  public:
    /// What the work may do while it goes on; to be called from its thread.
    class Desk {
      public:
        explicit Desk(Loading& loading) : loading_(loading) {}
        /// Names the work now under way; its share starts at 0.
        void begin(const std::string& doing);
        /// Reports to the window; its stages are those of precompute.
        Progress progress();
        /// Tells people something, once it is over.
        void say(std::string message);
        /// Hands an operator over.
        void deliver(OpenedOperator opened);

      private:
        Loading& loading_;
    };
    using Work = std::function<void(Desk&)>;

    /// Starts at once. Whatever the work throws ends it and becomes LoadingState::failure.
    explicit Loading(Work work);
    ~Loading();
    Loading(const Loading&) = delete;
    Loading& operator=(const Loading&) = delete;

    LoadingState state() const;
    /// The latest operator delivered since the last call, null if there is none.
    SharedOperator take();

  private:
    void run(const Work& work);

    mutable std::mutex mutex_;
    LoadingState state_;
    SharedOperator delivered_;
    std::atomic<bool> stops_{false};
    std::thread thread_;
};

/// Reads a .gto file.
Loading::Work reading_of(const std::string& path);
/// How a scene is computed in the window; each field as in PrecomputeRequest and its options.
struct SceneComputation {
    BareGeometry bare;
    AlbedoAboveOne above_one = AlbedoAboveOne::refuse;
    double error = PrecomputeOptions().error;
    std::uint64_t max_memory = PrecomputeOptions().max_memory;  ///< [bytes]
};
/// Precomputes a scene: shows it in direct light at once, then with all light, first coarsely and
/// soon, then to the error asked for.
Loading::Work precomputation_of(const std::string& scene, const SceneComputation& how);

/// The errors on the way to `error`, coarse to fine, the last being `error` itself.
std::vector<double> errors_on_the_way(double error);

}  // namespace lightwell
