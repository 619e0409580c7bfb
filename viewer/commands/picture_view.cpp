#include "viewer/commands/picture_view.h"

#include <utility>

#include "radiance4d/failure.h"
#include "solver/reading/input_file.h"

namespace lightwell {

View view_argument(const std::string& option, const std::string& text) {
    const std::pair<const char*, View> views[] = {
        {"total", View::total}, {"direct", View::direct}, {"indirect", View::indirect},
        {"lux", View::lux},     {"level", View::level},   {"coefficients", View::coefficients}};
    for (const auto& [name, view] : views)
        if (text == name) return view;
    throw InputError(Place{option}, in_quotes(text) +
                                        " is not a view: total, direct, indirect, lux, level or "
                                        "coefficients");
}

OffscreenGl opengl_argument(const std::string& option, const std::string& text) {
    if (text == "osmesa") return OffscreenGl::osmesa;
    if (text == "egl") return OffscreenGl::egl;
    throw InputError(Place{option}, in_quotes(text) + " is not osmesa or egl");
}

}  // namespace lightwell
