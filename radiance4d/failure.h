#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace lightwell {

/// Where in a user's file something stands. Lines and columns count from 1; 0 means "not known".
struct Place {
    std::string file;
    int line = 0;
    int column = 0;

    /// "room.obj:57:3", "room.obj:57", "room.obj", or "" where nothing is known.
    std::string to_string() const;
};

/// The world's failure: a file, an argument, a scene that cannot be used. The program exits with
/// status 1. what() reads "place: message" and carries the offending value.
class InputError : public std::runtime_error {
  public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    InputError(const Place& place, const std::string& message);
};

/// The system's failure: disk, memory, GL. The program exits with status 2.
class SystemError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The user asked to stop (Ctrl-C). The program exits with status 3.
class Interrupted : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Our own mistake: a broken precondition or invariant. Never caught to go on.
class BrokenInvariant : public std::logic_error {
  public:
    using std::logic_error::logic_error;
};

namespace detail {
[[noreturn]] void check_failed(const char* expression, const char* file, int line,
                               const std::string& values);
template <typename A, typename B>
std::string both_values(const A& a, const B& b) {
    std::ostringstream text;
    text.precision(17);
    text << a << " against " << b;
    return text.str();
}
}  // namespace detail

}  // namespace lightwell

/// For our own mistakes only: throws BrokenInvariant with the expression and its place.
#define LIGHTWELL_CHECK(condition)                                                               \
    do {                                                                                         \
        if (!(condition)) ::lightwell::detail::check_failed(#condition, __FILE__, __LINE__, ""); \
    } while (false)

/// As LIGHTWELL_CHECK for a comparison; the message carries both values.
#define LIGHTWELL_CHECK_OP(a, op, b)                                                       \
    do {                                                                                   \
        if (!((a)op(b)))                                                                   \
            ::lightwell::detail::check_failed(#a " " #op " " #b, __FILE__, __LINE__,       \
                                              ::lightwell::detail::both_values((a), (b))); \
    } while (false)
