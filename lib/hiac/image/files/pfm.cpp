// Portable float map: "PF" (colour) or "Pf" (grey), width, height, and a scale whose sign tells the
// byte order (negative: little-endian); then rows of float32 from the bottom up.
// Based on: P. Debevec, "PFM Portable FloatMap Image Format", and Netpbm's pfm(5).

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"

namespace hiac::image_files {
namespace {

struct PfmHeader {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t channels = 0;
  double scale = 0;        ///< negative: little-endian; numbers are multiplied by its magnitude
  std::size_t length = 0;  ///< bytes
};

PfmHeader parse_header(std::string_view bytes, const std::string& path) {
  const auto malformed = [&](const char* what) {
    return InputError(path, fmt::format("not a portable float map (expected {})", what));
  };
  PfmHeader header;
  if (bytes.size() < 3 || bytes[0] != 'P' || (bytes[1] != 'F' && bytes[1] != 'f'))
    throw malformed("PF or Pf first");
  header.channels = bytes[1] == 'F' ? 3 : 1;
  const char* at = bytes.data() + 2;
  const char* const end = bytes.data() + bytes.size();
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  const auto next = [&](auto& number) {
    const char* const before = at;
    while (at != end && is_space(*at)) ++at;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (at == before || error != std::errc{}) throw malformed("width, height and scale");
    at = stop;
  };
  next(header.width);
  next(header.height);
  next(header.scale);
  if (at == end || !is_space(*at)) throw malformed("one white space after the scale");
  if (header.scale == 0 || !std::isfinite(header.scale)) throw malformed("a scale other than 0");
  header.length = static_cast<std::size_t>(at - bytes.data()) + 1;
  return header;
}

}  // namespace

void write_pfm(const std::string& path, const Image& image) {
  const auto picked = picked_channels(path, "PFM", image, false);
  FileWriter file(path);
  const std::string header = fmt::format("P{}\n{} {}\n-1.0\n", picked.size() == 3 ? 'F' : 'f',
                                         image.width(), image.height());
  file.write(std::as_bytes(std::span(header)));
  std::vector<float> row;
  for (std::size_t y = image.height(); y-- > 0;) {
    row.clear();
    for (std::size_t x = 0; x < image.width(); ++x)
      for (const std::size_t c : picked) row.push_back(static_cast<float>(image.at(x, y, c)));
    file.write(std::as_bytes(std::span(row)));
  }
  file.close();
  file.commit();
}

Image read_pfm(const std::string& path) {
  const std::vector<std::byte> bytes = read_whole(path);
  const PfmHeader header =
      parse_header({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
  require_sane_size(header.width, header.height, header.channels, path);
  const std::size_t row_values = header.width * header.channels;
  const std::size_t expected = row_values * header.height * sizeof(float);
  if (bytes.size() - header.length != expected)
    throw InputError(path, fmt::format("wrong length (expected {} bytes of numbers, found {})",
                                       expected, bytes.size() - header.length));
  Image image(header.width, header.height, default_channel_names(header.channels));
  const std::byte* at = bytes.data() + header.length;
  for (std::size_t y = header.height; y-- > 0;)
    for (double& value : image.values().subspan(y * row_values, row_values)) {
      std::array<std::byte, sizeof(float)> number{};
      std::copy_n(at, number.size(), number.begin());
      at += number.size();
      if (header.scale > 0) std::reverse(number.begin(), number.end());
      value = static_cast<double>(std::bit_cast<float>(number)) * std::fabs(header.scale);
    }
  return image;
}

}  // namespace hiac::image_files
