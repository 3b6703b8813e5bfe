#include "tools/common/render/render_options.hpp"

namespace hiac::tools {

void add_render_options(CLI::App& app, RenderOptions& options) {
  add_picture_command(app, options, "hiac-render");
  add_series_options(app, options.series);
  app.add_option("--fps", options.rate,
                 "With -o FILE.mp4, a film of the pictures of --steps or --frames, which the "
                 "program ffmpeg makes: pictures per second (default: 25)")
      ->check(CLI::Range(0.01, 1000.0))
      ->type_name("N");
  add_picture_options(app, options.picture);
  app.add_option("--under", options.under,
                 "Put this picture behind the new one instead of the background: linear values, "
                 "premultiplied by alpha")
      ->type_name("IMAGE");
  app.add_option(
         "--colorbar", options.color_bar,
         "Draw the colour map, and the opacity of a length of the medium, as a second picture, or "
         "without -o alone; [annotation.colorbar] draws one into the picture")
      ->type_name("IMAGE");
  app.add_option("--colorbar-length", options.color_bar_length,
                 "Length for --colorbar in world units; default: a round number near a tenth of "
                 "the diagonal")
      ->check(CLI::PositiveNumber)
      ->type_name("L");
  app.add_option(
         "--engine", options.engine,
         "accurate (the default), or preview: OpenGL, by hiac-preview, whose options it has "
         "then (hiac-preview --help)")
      ->check(CLI::IsMember({"accurate", "preview"}))
      ->type_name("ENGINE");
  app.add_option("--method", options.method, "For --engine preview: exact, or M0 to M3")
      ->type_name("METHOD");
  auto* pixel =
      app.add_option("--pixel", options.pixel,
                     "Explain the pixel in column X and row Y instead of making a picture: a table "
                     "of all cells on its ray, or with --json the same for programs")
          ->type_name("X,Y");
  for (const char* of_pictures :
       {"--output", "--format", "--channels", "--crop", "--samples", "--filter", "--under",
        "--frames", "--colorbar", "--colorbar-length", "--depth", "--linear", "--strict", "--fps",
        "--steps", "FURTHER"})
    pixel->excludes(app.get_option(of_pictures));
}

}  // namespace hiac::tools
