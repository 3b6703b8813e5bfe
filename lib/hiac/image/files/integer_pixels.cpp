#include "hiac/image/files/integer_pixels.hpp"

#include <algorithm>
#include <cmath>

#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac::image_files {
namespace {

std::uint16_t to_integer(double value, double largest, bool linear) {
  if (!(value > 0)) return 0;
  const double clamped = std::min(value, 1.0);
  return static_cast<std::uint16_t>(
      std::floor((linear ? clamped : srgb_encode(clamped)) * largest + 0.5));
}

/// Converts a sample into a linear value.
double decode(double sample, double gamma) {
  return gamma == 0 ? srgb_decode(sample) : std::pow(sample, 1 / gamma);
}

}  // namespace

IntegerPixels encode_integers(const std::string& path, const char* format, const Image& image,
                              const WriteOptions& options) {
  const auto picked = picked_channels(path, format, image, !options.background_included);
  IntegerPixels pixels;
  pixels.width = image.width();
  pixels.height = image.height();
  pixels.channels = picked.size();
  pixels.depth = options.depth;
  pixels.gamma = options.linear ? 1 : 0;
  pixels.samples.reserve(image.width() * image.height() * picked.size());
  const double largest = pixels.largest();
  const std::size_t colors = picked.size() - (pixels.has_alpha() ? 1 : 0);
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      const auto pixel = image.pixel(x, y);
      const double alpha = pixels.has_alpha() ? pixel[picked.back()] : 1;
      for (std::size_t c = 0; c < colors; ++c)
        pixels.samples.push_back(to_integer(pixel[picked[c]] / alpha, largest, options.linear));
      if (pixels.has_alpha()) pixels.samples.push_back(to_integer(alpha, largest, true));
    }
  }
  return pixels;
}

Image decode_integers(const IntegerPixels& pixels) {
  Image image(pixels.width, pixels.height, default_channel_names(pixels.channels));
  const double largest = pixels.largest();
  const std::size_t colors = pixels.channels - (pixels.has_alpha() ? 1 : 0);
  for (std::size_t i = 0; i < pixels.samples.size(); i += pixels.channels) {
    const auto pixel = image.values().subspan(i, pixels.channels);
    for (std::size_t c = 0; c < pixels.channels; ++c) pixel[c] = pixels.samples[i + c] / largest;
    const double alpha = pixels.has_alpha() ? pixel.back() : 1;
    for (std::size_t c = 0; c < colors; ++c) {
      if (pixels.premultiplied && alpha > 0) pixel[c] = std::min(pixel[c] / alpha, 1.0);
      pixel[c] = decode(pixel[c], pixels.gamma) * alpha;
    }
  }
  return image;
}

}  // namespace hiac::image_files
