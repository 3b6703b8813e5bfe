#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "hiac/scene/scene.hpp"
#include "hiac/scene/spec_key.hpp"

namespace hiac {

/// The table [volume.color] before a preset is resolved.
struct ColorSource {
  ColorTransfer transfer;  ///< the field, and the points if any are given
  std::optional<std::string> preset;
  std::optional<std::string> preset_name;
  std::optional<std::array<double, 2>> range;
  double preset_tolerance = 1e-4;
};

std::span<const SpecKey<ColorSource>> color_keys();

/// Reads the table: its points, or its preset converted to points, with a note of the error bound.
ColorTransfer read_color_transfer(const SpecValue& table);

}  // namespace hiac
