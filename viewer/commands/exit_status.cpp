#include "viewer/commands/exit_status.h"

#include <new>
#include <string>
#include <system_error>

#include "radiance4d/failure.h"
#include "viewer/commands/output.h"

namespace lightwell {

int exit_status_of(const std::function<void()>& work) {
    constexpr int success = 0, input_error = 1, system_error = 2, interrupted = 3;
    try {
        work();
        return success;
    } catch (const InputError& error) {
        print_message(error.what());
        return input_error;
    } catch (const Interrupted& error) {
        print_message(error.what());
        return interrupted;
    } catch (const SystemError& error) {
        print_message(error.what());
    } catch (const std::system_error& error) {
        print_message(error.what());
    } catch (const std::bad_alloc&) {
        print_message("the memory of this machine does not suffice");
    } catch (const std::exception& error) {
        print_message(std::string("this is a mistake of the program itself: ") + error.what());
    }
    return system_error;
}

}  // namespace lightwell
