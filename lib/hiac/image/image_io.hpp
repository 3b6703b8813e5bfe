#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac {

/// An image and the texts that its file carries (`.exr` and `.png`; no other format has room).
struct ImageFile {
  Image image;
  /// Name and text: "hiac:specification", "hiac:mesh", "Software" ...
  std::vector<std::pair<std::string, std::string>> attributes;
};

struct WriteOptions {
  /// 8-bit formats: store linear values instead of sRGB-encoded ones.
  bool linear = false;
  /// R G B already hold what lies behind, with A still 1 - transparency: formats of straight alpha
  /// are then written opaque, from R G B as they are.
  bool background_included = false;
  /// Texts for the header, where the format has room for them.
  std::vector<std::pair<std::string, std::string>> attributes;
};

/// Writes an image in the format that the name's extension tells:
///
///     .npy  float64, H x W x C, every value to the last bit
///     .f32  a base name: BASE.r.f32 BASE.g.f32 BASE.b.f32 BASE.a.f32, and BASE.NAME.f32 for each
///           further channel: raw little-endian float32, top row first
///     .exr  32-bit float channels, ZIP-compressed without loss; attributes in the header
///     .png  8 bits, straight alpha, sRGB unless options.linear; R G B, and A where there is one,
///     or
///           Y; further channels are left out. What 8 bits of straight alpha cannot hold, values
///           outside [0, 1] and colours without alpha, is clamped; NaN becomes 0.
///
/// The file is whole or untouched: a temporary name beside it, then a rename.
/// Throws UsageError for an extension that is not known or channels that the format cannot hold,
/// InputError when the file cannot be written.
void write_image(const std::string& path, const Image& image, const WriteOptions& options = {});

/// Throws UsageError when write_image would refuse the name: to be asked before a long computation.
void require_known_image_extension(const std::string& path);

/// Whether the name's extension is one that write_image knows.
bool has_image_extension(const std::string& path);

/// Reads an image that write_image wrote, and those that other programs write in these formats
/// (numpy: two or three axes of floating-point or integer numbers; PNG: grey or colour, 8 or 16
/// bits, back to premultiplied linear values; OpenEXR: flat images of any compression). A `.f32`
/// image is named by its base; its R G B A are read, as many as there are, and since no file holds
/// its size, `width` must be given and divide the number of pixels (UsageError when it is 0).
/// Throws InputError naming the file; memory grows with what is there, not with what is announced.
ImageFile read_image(const std::string& path, std::size_t width = 0);

}  // namespace hiac
