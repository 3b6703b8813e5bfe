#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hiac/image/image.hpp"
#include "hiac/image/image_io.hpp"

namespace hiac::image_files {

/// Pixels as integer formats store them: samples of 8 or 16 bits, grey or colour, then alpha if
/// there is any. Colours are straight (not multiplied by alpha) and encoded; alpha is not encoded.
struct IntegerPixels {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t channels = 0;  ///< 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
  int depth = 8;             ///< bits per sample: 8 or 16
  double gamma = 0;          ///< linear = encoded^(1 / gamma); 0: sRGB
  /// Whether colours were multiplied by alpha after encoding (as in some TIFF files).
  bool premultiplied = false;
  /// Sample c of pixel (x, y) is samples[(y * width + x) * channels + c], row 0 the top row.
  std::vector<std::uint16_t> samples;

  [[nodiscard]] std::uint16_t largest() const { return depth == 16 ? 65535 : 255; }
  [[nodiscard]] bool has_alpha() const { return channels % 2 == 0; }
};

/// Converts an image for an integer format: R G B or Y, and A if the image has it and the
/// background is not included; options.depth bits, sRGB unless options.linear, rounded to nearest.
/// Values outside [0, 1] and colours without alpha are clamped; NaN becomes 0. Throws UsageError,
/// with the path and the format, for other channels.
IntegerPixels encode_integers(const std::string& path, const char* format, const Image& image,
                              const WriteOptions& options);

/// Converts back into linear values, premultiplied by alpha.
Image decode_integers(const IntegerPixels& pixels);

}  // namespace hiac::image_files
