#include "hiac/scene/color_source.hpp"

#include <array>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/colormap_preset.hpp"
#include "hiac/scene/transfer_points.hpp"

namespace hiac {
namespace {

using Text = std::optional<std::string>;

/// For smaller tolerances, a table would need unreasonably many points.
constexpr double kSmallestPresetTolerance = 1e-10;

void read_range(const SpecValue& value, ColorSource& color) {
  const std::vector<SpecValue> ends = value.list(2);
  color.range = {ends[0].number(), ends[1].number()};
  if (!((*color.range)[0] < (*color.range)[1]))
    value.fail(fmt::format("low must be below high (found {} and {})", (*color.range)[0],
                           (*color.range)[1]));
}

constexpr SpecKey<ColorSource> kColorKeys[] = {
    {"field", "a field of the mesh; NAME:magnitude, NAME:x ... of vectors", true,
     [](const SpecValue& v, ColorSource& c) { c.transfer.field = v.text(); },
     [](const ColorSource& c) -> Text { return toml_text(c.transfer.field); }},
    {"points", "scalar, red, green, blue; scalars not decreasing, two at one scalar make a step",
     false, [](const SpecValue& v, ColorSource& c) { read_points<3>(v, c.transfer.points); },
     [](const ColorSource& c) -> Text { return points_text<3>(c.transfer.points); }},
    {"preset", "a ParaView colour-map preset file (JSON or XML) instead of points", false,
     [](const SpecValue& v, ColorSource& c) { c.preset = v.text(); }, nullptr},
    {"preset_name", "which map of a file that holds several", false,
     [](const SpecValue& v, ColorSource& c) { c.preset_name = v.text(); }, nullptr},
    {"range", "the scalars [low, high] that the preset is stretched to", false, read_range,
     nullptr},
    {"preset_tolerance", "largest error of a channel of the preset as piecewise-linear RGB", false,
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

ColorTransfer resolve_preset(const SpecValue& table, const ColorSource& source) {
  if (!source.range)
    table.fail_at("range", "is missing (a preset is stretched to range = [low, high])");
  ColormapPreset preset;
  try {
    preset = read_colormap_preset(preset_path(table, *source.preset), source.preset_name);
  } catch (const InputError& error) {
    table.fail_at("preset", error.what());
  }
  const auto [low, high] = *source.range;
  LinearizedPreset linear = linearize(preset, low, high, source.preset_tolerance);
  table.context().notes.push_back(
      fmt::format("{}: colour map {} as {} points of piecewise-linear RGB, error at most {:.2g}",
                  table.path_of("preset"), preset.name.empty() ? *source.preset : preset.name,
                  linear.points.size(), linear.bound));
  return {source.transfer.field, std::move(linear.points)};
}

}  // namespace

std::span<const SpecKey<ColorSource>> color_keys() { return kColorKeys; }

ColorTransfer read_color_transfer(const SpecValue& table) {
  ColorSource source;
  read_keys(table, color_keys(), source);
  const bool has_points = table.has("points");
  if (has_points && source.preset)
    table.fail_at("preset", "one of `points` and `preset` is expected, found both");
  if (!has_points && !source.preset)
    table.fail_at("points", "is missing (one of `points` and `preset` is expected)");
  if (source.preset) return resolve_preset(table, source);
  for (const char* key : {"range", "preset_name", "preset_tolerance"})
    if (table.has(key)) table.fail_at(key, "has no meaning without `preset`");
  return source.transfer;
}

}  // namespace hiac
