#include "hiac/scene/paraview/volume_text.hpp"

#include <array>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "hiac/scene/paraview/opacity_function.hpp"
#include "hiac/scene/transfer_points.hpp"

namespace hiac::paraview {
namespace {

constexpr std::string_view kProjectedTetra = "Projected tetra";

constexpr double kMagnitude = 0, kComponent = 1;  // VectorMode

/// The keys that put a function's points on its scalars.
std::string axis_text(const ScalarAxis& axis) {
  if (!axis.log_range) return "";
  return fmt::format("scale = \"log\"\nrange = {}\n", toml_text(*axis.log_range));
}

Proxy required(const StateDocument& state, const Proxy& shown, const char* property) {
  const std::optional<Proxy> found = state.referred(shown, property);
  if (!found) shown.fail(property, "refers to nothing in the file");
  return *found;
}

/// The scalar of an array that a colour function looks up: a component, or its value.
std::string scalar_text(const Proxy& shown, const Proxy& table) {
  const std::string field = field_of(shown, "ColorArrayName");
  const double mode = table.number("VectorMode", kMagnitude);
  if (mode == kMagnitude) return field + ":value";
  if (mode != kComponent) table.fail("VectorMode", "colours that are the data have no equal here");
  return fmt::format("{}:{:g}", field, table.number("VectorComponent", 0));
}

/// What a mapper takes opacities for.
ExtinctionLaw law_of(const Proxy& shown, const std::string& mapper) {
  constexpr std::array<std::string_view, 3> kProportional{kProjectedTetra, "Z sweep",
                                                          "Bunyk ray cast"};
  for (const std::string_view name : kProportional)
    if (mapper == name) return ExtinctionLaw::proportional;
  // representations of regular grids have no choice of mappers
  if (mapper.empty() || mapper == "Resample To Image") return ExtinctionLaw::exponential;
  shown.fail("SelectMapper",
             fmt::format("not known what opacity means to the mapper \"{}\"", mapper));
}

std::string law_text(const OpacityFunction& function, const std::string& mapper, double unit,
                     ExtinctionLaw law) {
  const bool proportional = law == ExtinctionLaw::proportional;
  std::string text = fmt::format(
      "extinction: {} / {:g}, the unit distance, as ParaView's mapper {} takes it; error at most "
      "{:.2g} of {} points",
      proportional ? "opacity" : "-ln(1 - opacity)", unit,
      mapper.empty() ? "of regular grids" : mapper, function.bound, function.points.size());
  if (function.is_opaque && !proportional)
    text += fmt::format("; at opacity 1 it is infinite, and {:.3g} here", extinction(1, unit, law));
  return text;
}

std::string extinction_text(const StateDocument& state, const Proxy& shown,
                            std::vector<std::string>& notes) {
  const double unit = shown.number("ScalarOpacityUnitDistance", 1);
  if (!(unit > 0)) shown.fail("ScalarOpacityUnitDistance", "expected a positive number");
  const std::string mapper = shown.text("SelectMapper");
  const ExtinctionLaw law = law_of(shown, mapper);
  const OpacityFunction function =
      read_opacity_function(required(state, shown, "ScalarOpacityFunction"), unit, law);
  std::string field = scalar_text(shown, required(state, shown, "LookupTable"));
  if (shown.flag("UseSeparateOpacityArray"))
    field = fmt::format("{}:{:g}", field_of(shown, "OpacityArrayName"),
                        shown.number("OpacityComponent", 0));
  notes.push_back(law_text(function, mapper, unit, law));
  return fmt::format("[volume.extinction]\nfield = {}\n{}points = {}\n", toml_text(field),
                     axis_text(function.axis), points_text<1>(function.points));
}

}  // namespace

std::string field_of(const Proxy& proxy, const char* property) {
  const std::vector<std::string> texts = proxy.texts(property);
  if (texts.size() != 5 || texts[4].empty()) proxy.fail(property, "names no array");
  if (texts[3] != "0" && texts[3] != "1")
    proxy.fail(property, fmt::format("an array of points (0) or cells (1) is expected, found "
                                     "one of {:.20}",
                                     texts[3]));
  return texts[4] + (texts[3] == "0" ? "@node" : "@cell");
}

std::string color_text(const StateDocument& state, const Proxy& shown, ColorSteps steps,
                       std::vector<std::string>& notes) {
  if (shown.number("MapScalars", 1) == 0)
    shown.fail("MapScalars", "colours that are the data have no equal here");
  const Proxy table = required(state, shown, "LookupTable");
  const ColorFunction function = read_color_function(table, steps);
  const std::string field = scalar_text(shown, table);
  notes.push_back(
      fmt::format("colours: {} by {}, error of display values at most {:.2g} of {} "
                  "points",
                  field, function.description, function.bound, function.points.size()));
  return fmt::format("field = {}\ncolor_space = \"srgb\"\n{}points = {}\n", toml_text(field),
                     axis_text(function.axis), points_text<3>(function.points));
}

std::string volume_text(const StateDocument& state, const Proxy& shown,
                        std::vector<std::string>& notes) {
  if (shown.flag("MultiComponentsMapping"))
    shown.fail("MultiComponentsMapping", "opacity of a second component has no equal here");
  // measured (docs/paraview.md): the other mappers draw the function behind a discretized one
  const bool has_steps = shown.text("SelectMapper") == kProjectedTetra;
  const ColorSteps steps = has_steps ? ColorSteps::taken : ColorSteps::ignored;
  return "[volume.color]\n" + color_text(state, shown, steps, notes) + "\n" +
         extinction_text(state, shown, notes);
}

}  // namespace hiac::paraview
