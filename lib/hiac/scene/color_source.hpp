#pragma once

#include <optional>
#include <span>
#include <string>

#include "hiac/scene/colormaps/colormap_preset.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_key.hpp"
#include "hiac/scene/transfer_range.hpp"

namespace hiac {

/// Largest errors of a channel where a specification names none: a quarter of a step of 8-bit
/// display values; of linear values.
inline constexpr double kDisplayTolerance = 1e-3, kLinearTolerance = 1e-4;

/// The table [volume.color] or [skin.color] before its preset and its range are resolved.
struct ColorSource {
  ColorTransfer transfer;  ///< the field, and the points if any are given
  std::optional<std::string> preset;
  std::optional<std::string> preset_name;
  TransferRange range;
  std::optional<ColorEncoding> encoding;  ///< none: sRGB for presets, linear for points
  /// None: kDisplayTolerance for sRGB numbers, kLinearTolerance else.
  std::optional<double> preset_tolerance;
};

std::span<const SpecKey<ColorSource>> color_keys();

/// Reads the table: its points, or its preset converted to points, with a note of the error bound.
/// Points that have to wait for the field's values go into `unscaled`; `is_logarithmic` says
/// whether the scale is.
ColorTransfer read_color_transfer(const SpecValue& table,
                                  std::optional<UnscaledPoints<3>>& unscaled, bool& is_logarithmic);

}  // namespace hiac
