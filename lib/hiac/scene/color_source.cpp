#include "hiac/scene/color_source.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormaps/built_in_colormaps.hpp"
#include "hiac/scene/transfer_points.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

/// For smaller tolerances, a table would need unreasonably many points.
constexpr double kSmallestPresetTolerance = 1e-10;

constexpr std::pair<std::string_view, ColorEncoding> kEncodings[] = {
    {"linear", ColorEncoding::linear}, {"srgb", ColorEncoding::srgb}};

constexpr SpecKey<ColorSource> kColorKeys[] = {
    {"field",
     "a field of the mesh; NAME:magnitude, NAME:x ... of vectors, NAME:von_mises ... of tensors",
     true, [](const SpecValue& v, ColorSource& c) { c.transfer.field = v.text(); },
     [](const ColorSource& c) -> Text { return toml_text(c.transfer.field); }},
    {"points", "scalar, red, green, blue; scalars not decreasing, two at one scalar make a step",
     false, [](const SpecValue& v, ColorSource& c) { read_points<3>(v, c.transfer.points); },
     [](const ColorSource& c) -> Text {
       if (c.preset) return std::nullopt;
       return points_text<3>(c.transfer.points);
     }},
    {"preset", "a colour map by name (\"viridis\"), or a ParaView preset file, instead of points",
     false, [](const SpecValue& v, ColorSource& c) { c.preset = v.text(); },
     [](const ColorSource& c) -> Text {
       if (!c.preset) return std::nullopt;
       return toml_text(*c.preset);
     }},
    {"preset_name", "which map of a file that holds several", false,
     [](const SpecValue& v, ColorSource& c) { c.preset_name = v.text(); }, nullptr},
    {"range",
     "[low, high], \"auto\" or \"percentile:1,99\": what the preset, or points on 0 to 1, span",
     false, [](const SpecValue& v, ColorSource& c) { read_range(v, c.range); },
     [](const ColorSource& c) -> Text {
       if (!c.range.fixed) return std::nullopt;
       return toml_text(*c.range.fixed);
     }},
    {"scale", "\"linear\" or \"log\": in what the function is linear between points", false,
     [](const SpecValue& v, ColorSource& c) { read_scale(v, c.range); }, nullptr},
    {"color_space", "\"srgb\" or \"linear\": what the numbers are; presets srgb, points linear",
     false,
     [](const SpecValue& v, ColorSource& c) { c.encoding = v.name_of<ColorEncoding>(kEncodings); },
     nullptr},
    {"preset_tolerance",
     "largest error of a channel as piecewise-linear RGB; srgb 1e-3, linear 1e-4", false,
     [](const SpecValue& v, ColorSource& c) {
       c.preset_tolerance = v.inside(kSmallestPresetTolerance, 1);
     },
     nullptr},
};

/// Returns the path of a preset: relative to the specification or, for an override, to the working
/// folder.
std::string preset_path(const SpecValue& table, const std::string& name) {
  const SpecContext& context = table.context();
  if (context.override_of(table.path_of("preset")) != nullptr) return name;
  return (std::filesystem::path(context.folder) / name).string();
}

ColormapPreset read_preset(const SpecValue& table, const ColorSource& source) {
  if (std::optional<ColormapPreset> known = built_in_colormap(*source.preset)) {
    if (source.preset_name) table.fail_at("preset_name", "has no meaning without a preset file");
    return *std::move(known);
  }
  const std::string path = preset_path(table, *source.preset);
  std::error_code error;
  if (!std::filesystem::path(path).has_extension() && !std::filesystem::exists(path, error))
    table.fail_at("preset",
                  fmt::format("no colour map of this name (expected a file, or one of "
                              "{}; found \"{}\")",
                              fmt::join(built_in_colormap_names(), ", "), *source.preset));
  try {
    return read_colormap_preset(path, source.preset_name);
  } catch (const InputError& failure) {
    table.fail_at("preset", failure.what());
  }
}

/// The preset over 0 to 1.
TransferPoints<3> preset_points(const SpecValue& table, const ColorSource& source) {
  const ColormapPreset preset = read_preset(table, source);
  const ColorEncoding encoding = source.encoding.value_or(ColorEncoding::srgb);
  const double tolerance = source.preset_tolerance.value_or(
      encoding == ColorEncoding::srgb ? kDisplayTolerance : kLinearTolerance);
  LinearizedPreset linear = linearize(preset, 0, 1, tolerance, encoding);
  table.context().notes.push_back(
      fmt::format("{}: colour map {} as {} points of piecewise-linear RGB, error at most {:.2g}",
                  table.path_of("preset"), preset.name.empty() ? *source.preset : preset.name,
                  linear.points.size(), linear.bound));
  return std::move(linear.points);
}

/// The scalar of a logarithm between those of the points' scalars: a point's own, where it is that.
double scalar_of(double logarithm, const TransferPoints<3>& points) {
  const auto logarithm_of = [](const auto& point) { return std::log(point.scalar); };
  const auto next = std::ranges::lower_bound(points, logarithm, {}, logarithm_of);
  if (logarithm_of(*next) == logarithm) return next->scalar;
  return std::clamp(std::exp(logarithm), std::prev(next)->scalar, next->scalar);
}

/// Points whose colours are display values become points whose colours are linear. Display values
/// are even in the scalar or, on a logarithmic scale, in its logarithm: with a range the points lie
/// evenly already, without one their logarithms do.
TransferPoints<3> decoded_points(const SpecValue& table, const ColorSource& source) {
  const TransferPoints<3>& points = source.transfer.points;
  const bool by_logarithm = source.range.scale == TransferScale::log && !source.range.is_given();
  ColormapPreset display;
  for (const auto& point : points) {
    for (const double channel : point.value)
      if (channel > 1)
        table.fail_at("points", fmt::format("a display value is at most 1 (found {})", channel));
    display.nodes.push_back({by_logarithm ? std::log(point.scalar) : point.scalar, point.value});
  }
  const double first = display.nodes.front().scalar, last = display.nodes.back().scalar;
  if (first < last) {
    TransferPoints<3> linear =
        linearize(display, first, last, source.preset_tolerance.value_or(kDisplayTolerance),
                  ColorEncoding::srgb)
            .points;
    if (by_logarithm)
      for (auto& point : linear) point.scalar = scalar_of(point.scalar, points);
    return linear;
  }
  TransferPoints<3> linear = points;
  for (auto& point : linear)
    point.value = preset_color({"", {}, {{0, point.value}}}, 0, ColorEncoding::srgb);
  return linear;
}

}  // namespace

std::span<const SpecKey<ColorSource>> color_keys() { return kColorKeys; }

ColorTransfer read_color_transfer(const SpecValue& table,
                                  std::optional<UnscaledPoints<3>>& unscaled,
                                  bool& is_logarithmic) {
  ColorSource source;
  read_keys(table, color_keys(), source);
  const bool has_points = table.has("points");
  if (has_points && source.preset)
    table.fail_at("preset", "one of `points` and `preset` is expected, found both");
  if (!has_points && !source.preset)
    table.fail_at("points", "is missing (one of `points` and `preset` is expected)");
  const bool decodes = source.encoding == ColorEncoding::srgb;
  if (!source.preset && table.has("preset_name"))
    table.fail_at("preset_name", "has no meaning without `preset`");
  if (!source.preset && !decodes && source.range.scale == TransferScale::linear &&
      table.has("preset_tolerance"))
    table.fail_at("preset_tolerance", "has no meaning for points that are piecewise-linear RGB");
  if (source.preset && !source.range.is_given()) source.range.percents = {0, 100};
  if (!source.preset) check_points<3>(table, source.transfer.points, source.range);
  TransferPoints<3> points = source.preset ? preset_points(table, source)
                             : decodes     ? decoded_points(table, source)
                                           : source.transfer.points;
  if (source.preset) check_points<3>(table, points, source.range);
  source.transfer.points.clear();
  is_logarithmic = source.range.scale == TransferScale::log;
  unscaled =
      place_points<3>(std::move(points), source.range,
                      source.preset_tolerance.value_or(kLinearTolerance), source.transfer.points);
  return source.transfer;
}

}  // namespace hiac
