#include "viewer/commands/stop_signal.h"

#include <atomic>

#include <signal.h>

namespace lightwell {

namespace {

/// A signal handler can reach nothing but what is static, and may only touch what is lock-free.
std::atomic<bool> stop_asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void ask_to_stop(int) {
    stop_asked.store(true);
}

}  // namespace

void heed_stop_signals() {
    struct sigaction action = {};
    action.sa_handler = ask_to_stop;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    signal(SIGXFSZ, SIG_IGN);
}

bool stop_requested() {
    return stop_asked.load(std::memory_order_relaxed);
}

}  // namespace lightwell
