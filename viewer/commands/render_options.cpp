#include <CLI/CLI.hpp>

#include "viewer/commands/arguments.h"
#include "viewer/commands/command_options.h"

namespace lightwell {

CLI::App* add_render(CLI::App& app, RenderRequest& request, std::optional<int>& threads) {
    CLI::App* command = app.add_subcommand("render", "draw a picture, without a display");
    command->add_option("FILE", request.operator_file, "the .gto file")->type_name("")->required();
    command->add_option("-o,--output", request.output, "picture to write")
        ->type_name("P.png|P.exr")
        ->required();
    add_lights(*command, request.lights);
    add_value(*command, "--camera", "C.toml", "file with a [camera]; the scene's own by default",
              [&request](const std::string& text) { request.camera = text; });
    add_value(
        *command, "--size", "WxH", "pixels; 960x720 by default",
        [&request](const std::string& text) { request.size = size_argument("--size", text); });
    add_value(*command, "--exposure", "EV",
              "stops brighter (or darker, if negative) than the automatic exposure of a PNG",
              [&request](const std::string& text) {
                  request.exposure = number_argument("--exposure", text);
              });
    add_value(
        *command, "--view", "VIEW",
        "total (default), direct, indirect, lux (false colour), level (the wavelet mesh), "
        "coefficients (of the operator, by quad)",
        [&request](const std::string& text) { request.view = view_argument("--view", text); });
    CLI::Option* no_gather = command->add_flag_callback(
        "--no-gather", [&request] { request.indirect = IndirectLight::smooth; },
        "show indirect light as the basis holds it, without gathering it once more at every cell: "
        "faster, less even");
    command
        ->add_flag_callback(
            "--textures", [&request] { request.indirect = IndirectLight::textures; },
            "show indirect light as a moving lamp does, from one texture per quad: fastest, with "
            "the whole error of the stored operator")
        ->excludes(no_gather);
    command->add_flag("--live", request.live,
                      "draw as a window does, in tenths of a second: what --textures "
                      "shows, with shadows smoothed over a pixel");
    add_value(*command, "--path", "PATH.toml",
              "[[camera]] and [[light]] keyframes: draws numbered pictures along them, as --live",
              [&request](const std::string& text) { request.path = text; });
    add_value(*command, "--opengl", "NAME",
              "what draws: osmesa (default), the processor, or egl, graphics hardware if there is",
              [&request](const std::string& text) {
                  request.opengl = opengl_argument("--opengl", text);
              });
    add_value(*command, "--projection", "WAY",
              "of lamps, in live pictures: rays (default), queries (occlusion queries), or fastest "
              "of the two here",
              [&request](const std::string& text) {
                  request.projection = projection_argument("--projection", text);
              });
    command->add_flag("--contours", request.contours, "contour lines in --view lux");
    add_value(*command, "--samples", "N", "samples a side in every pixel; 2 by default",
              [&request](const std::string& text) {
                  request.samples = whole_argument("--samples", text, 1, 16);
              });
    add_threads(*command, threads);
    return command;
}

}  // namespace lightwell
