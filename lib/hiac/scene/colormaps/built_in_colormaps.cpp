// Sources of the maps of a few nodes: ParaView's presets of the same names ("Cool to Warm",
// "Black-Body Radiation", "Grayscale", "jet", "Blue to Red Rainbow"; BSD-3-Clause), of which "Cool
// to Warm" is K. Moreland's, "Diverging Color Maps for Scientific Visualization", ISVC 2009.

#include "hiac/scene/colormaps/built_in_colormaps.hpp"

#include <array>
#include <cctype>
#include <charconv>

#include "hiac/scene/colormaps/colormap_tables.hpp"

namespace hiac {
namespace {

using Node = ColormapPreset::Node;

std::vector<ColormapPreset> maps_of_nodes() {
  return {
      {"cool to warm",
       ColorSpace::diverging,
       {{0, {0.231373, 0.298039, 0.752941}},
        {0.5, {0.865003, 0.865003, 0.865003}},
        {1, {0.705882, 0.0156863, 0.14902}}}},
      {"black body",
       ColorSpace::rgb,
       {{0, {0, 0, 0}}, {0.4, {0.901961, 0, 0}}, {0.8, {0.901961, 0.901961, 0}}, {1, {1, 1, 1}}}},
      {"grayscale", ColorSpace::rgb, {{0, {0, 0, 0}}, {1, {1, 1, 1}}}},
      {"jet",
       ColorSpace::rgb,
       {{0, {0, 0, 0.5625}},
        {1.0 / 9, {0, 0, 1}},
        {23.0 / 63, {0, 1, 1}},
        {31.0 / 63, {0.5, 1, 0.5}},
        {39.0 / 63, {1, 1, 0}},
        {55.0 / 63, {1, 0, 0}},
        {1, {0.5, 0, 0}}}},
      {"rainbow", ColorSpace::hsv, {{0, {0, 0, 1}}, {1, {1, 0, 0}}}},
  };
}

ColormapPreset map_of_table(const ColormapTable& table) {
  constexpr std::size_t kDigits = 4, kPerColor = 3 * kDigits;
  ColormapPreset preset{std::string(table.name), ColorSpace::rgb, {}};
  const std::size_t count = table.colors.size() / kPerColor;
  for (std::size_t i = 0; i < count; ++i) {
    Node node{static_cast<double>(i) / static_cast<double>(count - 1), {}};
    for (std::size_t c = 0; c < 3; ++c) {
      const char* digits = table.colors.data() + i * kPerColor + c * kDigits;
      unsigned value = 0;
      std::from_chars(digits, digits + kDigits, value, 16);
      node.rgb[c] = value / 65535.0;
    }
    preset.nodes.push_back(node);
  }
  return preset;
}

/// A name without case, blanks, hyphens and underscores.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name)
    if (c != ' ' && c != '-' && c != '_')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

/// Other names under which users know the maps, plain.
constexpr std::array<std::array<std::string_view, 2>, 5> kOtherNames{
    {{"coolwarm", "cool to warm"},
     {"blackbodyradiation", "black body"},
     {"greyscale", "grayscale"},
     {"gray", "grayscale"},
     {"bluetoredrainbow", "rainbow"}}};

}  // namespace

std::optional<ColormapPreset> built_in_colormap(std::string_view name) {
  std::string wanted = plain_name(name);
  for (const auto& [other, known] : kOtherNames)
    if (wanted == other) wanted = plain_name(known);
  for (const ColormapTable& table : colormap_tables())
    if (wanted == table.name) return map_of_table(table);
  for (ColormapPreset& preset : maps_of_nodes())
    if (wanted == plain_name(preset.name)) return std::move(preset);
  return std::nullopt;
}

std::vector<std::string> built_in_colormap_names() {
  std::vector<std::string> names;
  for (const ColormapTable& table : colormap_tables()) names.emplace_back(table.name);
  for (const ColormapPreset& preset : maps_of_nodes()) names.push_back(preset.name);
  return names;
}

}  // namespace hiac
