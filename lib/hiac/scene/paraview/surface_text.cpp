#include "hiac/scene/paraview/surface_text.hpp"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "hiac/scene/colormaps/color_space.hpp"
#include "hiac/scene/paraview/color_function.hpp"
#include "hiac/scene/paraview/view_text.hpp"
#include "hiac/scene/paraview/volume_text.hpp"
#include "hiac/scene/toml/spec_key.hpp"

namespace hiac::paraview {
namespace {

/// The array that colours a surface, or "" where it has one colour.
std::string color_array(const Proxy& shown) {
  const std::vector<std::string> texts = shown.texts("ColorArrayName");
  return texts.size() == 5 && !shown.references("LookupTable").empty() ? texts[4] : "";
}

/// The keys of a lit surface.
std::string light_text(const Proxy& shown) {
  return fmt::format("opacity = {}\nambient = {}\ndiffuse = {}\nspecular = {}\nshininess = {}\n",
                     toml_text(shown.number("Opacity", 1)), toml_text(shown.number("Ambient", 0)),
                     toml_text(shown.number("Diffuse", 1)), toml_text(shown.number("Specular", 0)),
                     toml_text(shown.number("SpecularPower", 100)));
}

void tell_differences(const std::string& name, const Proxy& shown,
                      std::vector<std::string>& omitted) {
  if (shown.number("Opacity", 1) < 1)
    omitted.push_back(fmt::format(
        "{}: is as opaque from everywhere in ParaView, and more so edge-on here", name));
}

/// The colour of a contour at a value: that of its colour function where the contoured array
/// colours it.
std::string contour_color(const StateDocument& state, const Proxy& shown, const Proxy& contour,
                          double value, std::vector<std::string>& omitted) {
  const std::string array = color_array(shown);
  const std::vector<std::string> contoured = contour.texts("SelectInputScalars");
  if (!array.empty() && contoured.size() == 5 && contoured[4] == array) {
    const std::optional<Proxy> table = state.referred(shown, "LookupTable");
    if (!table) shown.fail("LookupTable", "refers to nothing in the file");
    std::array<double, 3> color = read_color_function(*table, ColorSteps::taken).at(value);
    for (double& channel : color) channel = color_space::gamma_decoded(channel);
    return toml_text(color);
  }
  if (!array.empty())
    omitted.push_back(
        fmt::format("{}: its colours by {} have no equal here, its solid colour is "
                    "drawn",
                    state.name(contour), array));
  return linear_color(shown, "DiffuseColor");
}

}  // namespace

std::string isosurface_text(const StateDocument& state, const Proxy& shown,
                            std::vector<std::string>& omitted) {
  const Proxy contour = *state.referred(shown, "Input");
  const std::string field = field_of(contour, "SelectInputScalars");
  std::string text;
  for (const double value : contour.numbers("ContourValues"))
    text += fmt::format("[[isosurface]]\nfield = {}\nvalue = {}\ncolor = {}\n{}\n",
                        toml_text(field + ":value"), toml_text(value),
                        contour_color(state, shown, contour, value, omitted), light_text(shown));
  tell_differences(state.name(contour), shown, omitted);
  if (shown.text("Representation") == "Surface With Edges")
    omitted.push_back(fmt::format("{}: the edges of its triangles", state.name(contour)));
  return text;
}

std::string skin_text(const StateDocument& state, const Proxy& shown,
                      std::vector<std::string>& notes, std::vector<std::string>& omitted) {
  std::string text = "[skin]\n" + light_text(shown);
  if (color_array(shown).empty())
    text += fmt::format("color = {}\n", linear_color(shown, "DiffuseColor"));
  else
    text += "[skin.color]\n" + color_text(state, shown, ColorSteps::taken, notes);
  tell_differences("the surface", shown, omitted);
  if (shown.text("Representation") != "Surface With Edges") return text;
  return text + fmt::format("[edges]\nshow = \"boundary\"\nwidth = {}\ncolor = {}\n",
                            toml_text(shown.number("LineWidth", 1)),
                            linear_color(shown, "EdgeColor"));
}

}  // namespace hiac::paraview
