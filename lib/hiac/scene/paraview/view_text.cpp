#include "hiac/scene/paraview/view_text.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "hiac/scene/colormaps/color_space.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac::paraview {
namespace {

/// ParaView's background before anybody chooses one.
constexpr std::array<double, 3> kDefaultBackground{0.32, 0.34, 0.43};

constexpr double kInteraction2d = 1;

std::string linear_text(const std::array<double, 3>& display) {
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = color_space::gamma_decoded(display[c]);
  return toml_text(color);
}

std::string vector_line(const char* key, const Proxy& view, const char* property) {
  return fmt::format("{} = {}\n", key, toml_text(view.numbers<3>(property)));
}

/// BackgroundColorMode: one colour, or from that at the bottom to a second one at the top.
constexpr double kSingle = 0, kGradient = 1;

/// The mode of a view or of a palette; states before ParaView 5.10 had a switch.
double mode_of(const Proxy& proxy) {
  return proxy.number("BackgroundColorMode",
                      proxy.flag("UseGradientBackground") ? kGradient : kSingle);
}

}  // namespace

std::string linear_color(const Proxy& proxy, const char* property) {
  const std::array<double, 3> display = proxy.numbers<3>(property);
  for (const double channel : display)
    if (!(channel >= 0 && channel <= 1))
      proxy.fail(property, fmt::format("a colour is 0 to 1, found {}", channel));
  return linear_text(display);
}

std::string camera_text(const Proxy& view) {
  const bool is_parallel =
      view.flag("CameraParallelProjection") || view.number("InteractionMode", 0) == kInteraction2d;
  std::string text =
      fmt::format("[camera]\nprojection = \"{}\"\n", is_parallel ? "orthographic" : "perspective");
  text += vector_line("eye", view, "CameraPosition");
  text += vector_line("look_at", view, "CameraFocalPoint");
  text += vector_line("up", view, "CameraViewUp");
  if (!is_parallel)
    return text + fmt::format("fov = {}\n", toml_text(view.number("CameraViewAngle", 30)));
  const double scale = view.number("CameraParallelScale", 0);
  if (!(scale > 0)) view.fail("CameraParallelScale", "expected a positive number");
  return text + fmt::format("height = {}\n", toml_text(2 * scale));
}

std::string image_text(const Proxy& view) {
  const std::array<double, 2> size = view.numbers<2>("ViewSize");
  for (const double side : size)
    if (!(side >= 1 && side <= kMaxImageSide && side == std::floor(side)))
      view.fail("ViewSize", fmt::format("expected 1 to {} pixels, found {}", kMaxImageSide, side));
  return fmt::format("[image]\nwidth = {}\nheight = {}\n", static_cast<std::uint32_t>(size[0]),
                     static_cast<std::uint32_t>(size[1]));
}

std::string background_text(const StateDocument& state, const Proxy& view,
                            std::vector<std::string>& omitted) {
  const std::vector<Proxy> palettes = state.all("settings", "ColorPalette");
  const bool by_palette = view.number("UseColorPaletteForBackground", 0) != 0;
  if (by_palette && palettes.empty())
    return "[background]\ncolor = " + linear_text(kDefaultBackground) + "\n";
  const Proxy from = by_palette ? palettes.front() : view;
  const char* first = by_palette ? "BackgroundColor" : "Background";
  const char* second = by_palette ? "BackgroundColor2" : "Background2";
  const double mode = mode_of(from);
  if (mode == kGradient) {
    omitted.emplace_back(
        "the background's gradient: is even in display values in ParaView, in light here");
    return fmt::format("[background]\npattern = \"gradient\"\ncolor = {}\ncolor2 = {}\n",
                       linear_color(from, second), linear_color(from, first));
  }
  if (mode != kSingle)
    omitted.emplace_back("the background's picture: has no equal here, its colour is drawn");
  return "[background]\ncolor = " + linear_color(from, first) + "\n";
}

}  // namespace hiac::paraview
