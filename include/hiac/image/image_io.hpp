#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hiac/image/image.hpp"

namespace hiac {

/// An image and the texts in its file (`.exr`, `.png` and `.tiff`; other formats hold no texts).
struct ImageFile {
  Image image;
  /// Name and text: "hiac:specification", "hiac:mesh", "Software" ...
  std::vector<std::pair<std::string, std::string>> attributes;
};

struct WriteOptions {
  /// Integer formats: store linear values instead of sRGB-encoded ones.
  bool linear = false;
  /// R G B already contain the background, while A is still 1 - transparency: formats with straight
  /// alpha then store R G B unchanged and opaque.
  bool background_included = false;
  /// Texts for the header, if the format supports them.
  std::vector<std::pair<std::string, std::string>> attributes{};
  /// Bits per sample, if the format offers a choice; 0: its first.
  int depth = 0;
  /// The format's extension, with the dot, for a name that does not tell it; empty: the name's.
  std::string format{};
};

struct ReadOptions {
  /// Pixels per row of a `.f32` image, which its files do not store.
  std::size_t width = 0;
  /// Integer samples are linear, not sRGB-encoded, if the file does not specify their encoding.
  bool linear = false;
};

/// Writes an image in the format of the name's extension:
///
///     .npy   float64, H x W x C, every value to the last bit
///     .f32   a base name: BASE.r.f32 BASE.g.f32 BASE.b.f32 BASE.a.f32, and BASE.NAME.f32 for each
///            further channel: raw little-endian float32, top row first
///     .exr   32-bit float channels, ZIP-compressed without loss; attributes in the header
///     .png   8 or 16 bits; attributes in the header
///     .tiff  (.tif) 8 or 16 bits, or float32: premultiplied, linear; attributes in the header:
///            Software in its tag, the others as a JSON object in ImageDescription
///     .sgi   (.rgba) SGI's format, 8 or 16 bits
///     .pfm   float32, no alpha
///     .hdr   Radiance's format: 8 bits a colour with a common exponent, no alpha
///
/// The last five store R G B or Y (.hdr: grey as equal R G B) and, if the image has it and the
/// format supports it, A; other channels are omitted. Integer samples have straight alpha and are
/// sRGB-encoded unless options.linear; values outside [0, 1] and colours without alpha, which they
/// cannot represent, are clamped; NaN becomes 0. Formats without alpha get R G B unchanged.
///
/// The file is complete or unchanged: it is written under a temporary name, then renamed; a device
/// or a pipe is written to (see OutputFile). Throws UsageError for an extension that is not known,
/// a depth that the format does not have, or channels that it cannot hold, InputError when the file
/// cannot be written.
void write_image(const std::string& path, const Image& image, const WriteOptions& options = {});

/// Throws UsageError if write_image would reject the name or the depth; call it before a long
/// computation.
void require_known_image_extension(const std::string& path, int depth = 0);

/// Whether write_image would store numbers from 0 to 2^depth - 1 under this name and depth, not
/// floating-point ones. Throws as require_known_image_extension.
bool has_integer_samples(const std::string& path, int depth = 0);

/// The files that write_image makes of a name: the name itself, or for a `.f32` image the files of
/// R G B A and of the further channels.
std::vector<std::string> files_of_image(const std::string& path,
                                        const std::vector<std::string>& further_channels = {});

/// Whether the name's extension is one that write_image knows.
bool has_image_extension(const std::string& path);

/// Returns the extensions that write_image knows, separated by spaces.
std::string image_extensions();

/// Reads an image that write_image wrote, and those that other programs write in these formats:
/// numpy: two or three axes of floating-point or integer numbers; PNG and SGI: grey or colour, 8 or
/// 16 bits; TIFF: the same or float32, in strips, plain or compressed by PackBits, LZW or Deflate;
/// OpenEXR: flat images of any compression; PFM and Radiance HDR: the usual orientation. All become
/// premultiplied linear values. A `.f32` image is named by its base; its R G B A are read, as many
/// as exist, and since no file stores its size, options.width must be given and divide the number
/// of pixels (UsageError if it is 0). Throws InputError with the file's name; memory grows with the
/// data present, not with announced sizes.
ImageFile read_image(const std::string& path, const ReadOptions& options = {});

}  // namespace hiac
