#include "hiac/scene/paraview/color_function.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "hiac/scene/colormaps/colormap_preset.hpp"
#include "hiac/scene/paraview/ciede2000_path.hpp"

namespace hiac::paraview {
namespace {

using Node = ColormapPreset::Node;
using Points = std::vector<PiecewiseLinear<3>::Point>;

/// The colour spaces by ParaView's numbers.
struct Space {
  std::string_view name;
  ColorSpace space;
};
constexpr std::array<Space, 6> kSpaces{{{"RGB", ColorSpace::rgb},
                                        {"HSV", ColorSpace::hsv},
                                        {"Lab", ColorSpace::lab},
                                        {"Diverging", ColorSpace::diverging},
                                        {"Lab/CIEDE2000", ColorSpace::lab},
                                        {"Step", ColorSpace::step}}};
constexpr std::size_t kHsv = 1, kCiede2000 = 4;

/// ParaView's own table has at most as many colours as it has numbers for.
constexpr double kMostColors = 65536;

std::size_t space_of(const Proxy& table) {
  const double number = table.number("ColorSpace", 0);
  for (std::size_t k = 0; k < kSpaces.size(); ++k)
    if (number == static_cast<double>(k)) return k;
  table.fail("ColorSpace", fmt::format("expected 0 to {}, found {}", kSpaces.size() - 1, number));
}

std::vector<Node> nodes_of(const Proxy& table) {
  const std::vector<double> numbers = table.numbers("RGBPoints");
  if (numbers.empty() || numbers.size() % 4 != 0)
    table.fail("RGBPoints", fmt::format("expected scalar, red, green and blue for every point, "
                                        "found {} numbers",
                                        numbers.size()));
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < numbers.size(); i += 4) {
    for (std::size_t c = 1; c < 4; ++c)
      if (!(numbers[i + c] >= 0 && numbers[i + c] <= 1))
        table.fail("RGBPoints", fmt::format("a colour is 0 to 1, found {}", numbers[i + c]));
    nodes.push_back({numbers[i], {numbers[i + 1], numbers[i + 2], numbers[i + 3]}});
  }
  std::ranges::stable_sort(nodes, {}, &Node::scalar);
  if (!std::isfinite(nodes.back().scalar - nodes.front().scalar))
    table.fail("RGBPoints", "the scalars' range is not finite");
  return nodes;
}

/// Lets no rounded scalar fall below the one before it.
template <typename Point>
void sort_rounded(std::vector<Point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i)
    points[i].scalar = std::max(points[i].scalar, points[i - 1].scalar);
}

/// The nodes of the shortest paths between the nodes, which begin and end at the nearest colours of
/// ParaView's grid.
std::vector<Node> with_paths(const std::vector<Node>& nodes) {
  std::vector<Node> found;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const Node &a = nodes[i], &b = nodes[i + 1];
    if (!(a.scalar < b.scalar)) continue;
    for (const PathColor& color : ciede2000_path(a.rgb, b.rgb))
      found.push_back({(1 - color.position) * a.scalar + color.position * b.scalar, color.rgb});
    // a path of one colour holds up to the next node
    found.push_back({b.scalar, found.back().rgb});
  }
  sort_rounded(found);
  return found;
}

/// The nodes with the first and the last colour outside them as they are: ParaView does not convert
/// these to the space and back, which changes colours by up to 1e-4.
std::vector<Node> with_outer_nodes(std::vector<Node> nodes, const Node& first, const Node& last) {
  nodes.insert(nodes.begin(), first);
  nodes.push_back(last);
  return nodes;
}

/// Display colours of [0, 1] as rounding leaves them.
std::array<double, 3> clamped(std::array<double, 3> rgb) {
  for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
  return rgb;
}

/// The steps of a table of equal parts of the range, whose colours are those of the function from
/// end to end.
Points steps_of(const ColormapPreset& preset, const Node& first, const Proxy& table) {
  const double count = table.number("NumberOfTableValues", 256);
  if (!(count >= 1 && count <= kMostColors))
    table.fail("NumberOfTableValues",
               fmt::format("expected 1 to {}, found {}", kMostColors, count));
  const auto parts = static_cast<std::size_t>(count);
  const double low = preset.nodes.front().scalar, high = preset.nodes.back().scalar;
  const auto between = [&](double share) { return (1 - share) * low + share * high; };
  Points points;
  for (std::size_t k = 0; k < parts; ++k) {
    const auto step = static_cast<double>(k), all = static_cast<double>(parts);
    const double at = parts > 1 ? between(step / (all - 1)) : between(0.5);
    // at the range's beginning, ParaView takes the node's colour as it is, not converted and back
    const std::array<double, 3> color = at == low ? first.rgb : clamped(preset_color(preset, at));
    points.push_back({between(step / all), color});
    points.push_back({between((step + 1) / all), color});
  }
  return points;
}

/// Adds the colours that hold below and above the range.
void add_outer_colors(const Proxy& table, Points& points) {
  if (table.flag("UseBelowRangeColor"))
    points.insert(points.begin(),
                  {points.front().scalar, clamped(table.numbers<3>("BelowRangeColor"))});
  if (table.flag("UseAboveRangeColor"))
    points.push_back({points.back().scalar, clamped(table.numbers<3>("AboveRangeColor"))});
}

}  // namespace

std::array<double, 3> ColorFunction::at(double scalar) const {
  return PiecewiseLinear<3>(points)(axis.position(scalar));
}

ColorFunction read_color_function(const Proxy& table, ColorSteps steps) {
  if (table.flag("IndexedLookup"))
    table.fail("IndexedLookup", "colours of categories have no equal here");
  if (table.flag("Use2DTransferFunction"))
    table.fail("Use2DTransferFunction", "a transfer function of two scalars has no equal here");
  const std::size_t space = space_of(table);
  ColormapPreset preset{"", kSpaces[space].space, nodes_of(table)};
  const ScalarAxis axis = axis_of(table, preset.nodes.front().scalar, preset.nodes.back().scalar);
  for (Node& node : preset.nodes) node.scalar = axis.position(node.scalar);
  ColorFunction function{axis, {}, 0, std::string(kSpaces[space].name)};
  if (space == kHsv && table.flag("HSVWrap")) {
    preset.space = ColorSpace::hsv_wrapped;
    function.description += " the short way round";
  }
  const Node first = preset.nodes.front(), last = preset.nodes.back();
  if (!(first.scalar < last.scalar)) {
    function.points = {{last.scalar, last.rgb}};
    add_outer_colors(table, function.points);
    return function;
  }
  if (space == kCiede2000) preset.nodes = with_paths(preset.nodes);
  if (table.flag("Discretize") && steps == ColorSteps::taken) {
    function.points = steps_of(preset, first, table);
    function.description += fmt::format(" in {} steps", function.points.size() / 2);
  } else {
    preset.nodes = with_outer_nodes(std::move(preset.nodes), first, last);
    LinearizedPreset linear = linearize(preset, first.scalar, last.scalar, kColorTolerance);
    function.points = std::move(linear.points);
    function.bound = linear.bound;
    for (auto& point : function.points) point.value = clamped(point.value);
  }
  if (axis.log_range) function.description += ", logarithmic";
  sort_rounded(function.points);
  add_outer_colors(table, function.points);
  return function;
}

}  // namespace hiac::paraview
