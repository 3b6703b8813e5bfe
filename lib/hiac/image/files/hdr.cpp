// Radiance's picture format: red, green and blue with a common exponent, 32 bits per pixel. Based
// on: G. Ward, "Real Pixels", Graphics Gems II, 1991, II.5, and Radiance's "Picture File Format"
// (filefmts). Mantissas are rounded to nearest when written and used unchanged when read. Radiance
// truncates them and adds a half; most programs today do as this one does.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"

namespace hiac::image_files {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// Exponents are stored with this added, and mantissas are 256ths.
constexpr int kExponentBias = 128;
constexpr int kMantissaBits = 8;
/// Scanlines of these widths are run-length encoded component by component.
constexpr std::size_t kMinEncodedWidth = 8, kMaxEncodedWidth = 32767;
constexpr std::size_t kLongestRun = 127, kLongestDump = 128;

// Writing -----------------------------------------------------------------------------------------

/// Negative values and NaN become 0, values above the largest that fits become the largest.
Rgbe to_rgbe(const std::array<double, 3>& color) {
  const double kLargest = std::ldexp(255.0, 127 - kMantissaBits);
  std::array<double, 3> clamped{};
  for (std::size_t c = 0; c < 3; ++c) clamped[c] = color[c] > 0 ? std::min(color[c], kLargest) : 0;
  int exponent = 0;
  const double largest = *std::max_element(clamped.begin(), clamped.end());
  if (std::frexp(largest, &exponent) == 0) return {};
  // rounding may increase the largest mantissa from 255.5 to 256
  if (std::floor(std::ldexp(largest, kMantissaBits - exponent) + 0.5) > 255) ++exponent;
  if (exponent <= -kExponentBias) return {};
  Rgbe pixel{};
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(
        std::floor(std::ldexp(clamped[c], kMantissaBits - exponent) + 0.5));
  pixel[3] = static_cast<std::uint8_t>(exponent + kExponentBias);
  return pixel;
}

/// Appends one component of a scanline: runs of four or more as 128 + count and the byte, other
/// bytes as a count and the bytes.
void append_component(std::vector<std::uint8_t>& bytes, std::span<const Rgbe> row, std::size_t c) {
  constexpr std::size_t kWorthwhileRun = 4;
  const auto run_at = [&](std::size_t x) {
    std::size_t length = 1;
    while (x + length < row.size() && length < kLongestRun && row[x + length][c] == row[x][c])
      ++length;
    return length;
  };
  for (std::size_t x = 0; x < row.size();) {
    if (const std::size_t run = run_at(x); run >= kWorthwhileRun) {
      bytes.push_back(static_cast<std::uint8_t>(128 + run));
      bytes.push_back(row[x][c]);
      x += run;
      continue;
    }
    const std::size_t first = x;
    while (x < row.size() && x - first < kLongestDump && run_at(x) < kWorthwhileRun) ++x;
    bytes.push_back(static_cast<std::uint8_t>(x - first));
    for (std::size_t i = first; i < x; ++i) bytes.push_back(row[i][c]);
  }
}

std::vector<std::uint8_t> encode_row(std::span<const Rgbe> row) {
  std::vector<std::uint8_t> bytes;
  if (row.size() < kMinEncodedWidth || row.size() > kMaxEncodedWidth) {
    for (const Rgbe& pixel : row) bytes.insert(bytes.end(), pixel.begin(), pixel.end());
    return bytes;
  }
  bytes = {2, 2, static_cast<std::uint8_t>(row.size() >> 8),
           static_cast<std::uint8_t>(row.size() & 0xff)};
  for (std::size_t c = 0; c < 4; ++c) append_component(bytes, row, c);
  return bytes;
}

// Reading -----------------------------------------------------------------------------------------

struct HdrHeader {
  double exposure = 1;  ///< numbers were multiplied by this
  std::size_t width = 0;
  std::size_t height = 0;
};

/// Reads the bytes of a file from front to back.
class HdrBytes {
 public:
  HdrBytes(std::span<const std::byte> bytes, const std::string& path) : rest_(bytes), path_(path) {}

  [[nodiscard]] std::size_t size() const { return rest_.size(); }

  std::uint8_t next() {
    if (rest_.empty()) throw InputError(path_, "the file ends too early (within its pixels)");
    const auto byte = std::to_integer<std::uint8_t>(rest_.front());
    rest_ = rest_.subspan(1);
    return byte;
  }
  Rgbe next_pixel() {
    Rgbe pixel{};
    for (std::uint8_t& byte : pixel) byte = next();
    return pixel;
  }
  /// Returns the text up to the next end of line.
  std::string_view next_line() {
    const std::string_view text(reinterpret_cast<const char*>(rest_.data()), rest_.size());
    const std::size_t length = text.find('\n');
    if (length == std::string_view::npos)
      throw InputError(path_, "not a Radiance picture (its header has no end)");
    rest_ = rest_.subspan(length + 1);
    return text.substr(0, length);
  }

 private:
  std::span<const std::byte> rest_;
  const std::string& path_;
};

/// Reads "-Y HEIGHT +X WIDTH": rows from the top, pixels from the left.
void read_resolution(std::string_view line, HdrHeader& header, const std::string& path) {
  const auto number_after = [&](std::string_view key, std::size_t& number) {
    const std::size_t at = line.find(key);
    if (at == std::string_view::npos) return false;
    const char* const first = line.data() + at + key.size();
    return std::from_chars(first, line.data() + line.size(), number).ec == std::errc{};
  };
  if (!line.starts_with("-Y ") || !number_after("-Y ", header.height) ||
      !number_after(" +X ", header.width))
    throw InputError(path,
                     "a Radiance picture of another orientation (expected -Y height +X "
                     "width)");
  require_sane_size(header.width, header.height, 3, path);
}

HdrHeader read_header(HdrBytes& bytes, const std::string& path) {
  if (!bytes.next_line().starts_with("#?"))
    throw InputError(path, "not a Radiance picture (expected #? first)");
  HdrHeader header;
  constexpr std::string_view kFormat = "FORMAT=", kExposure = "EXPOSURE=";
  for (std::string_view line = bytes.next_line(); !line.empty(); line = bytes.next_line()) {
    if (line.starts_with(kFormat) && !line.substr(kFormat.size()).starts_with("32-bit_rle_rgbe"))
      throw InputError(path, "a Radiance picture of another format (expected 32-bit_rle_rgbe)");
    if (!line.starts_with(kExposure)) continue;
    line.remove_prefix(std::min(line.find_first_not_of(' ', kExposure.size()), line.size()));
    double exposure = 0;
    std::from_chars(line.data(), line.data() + line.size(), exposure);
    if (!(exposure > 0) || !std::isfinite(exposure))
      throw InputError(path, "malformed Radiance header (expected a positive exposure)");
    header.exposure *= exposure;
    if (!(header.exposure > 0) || !std::isfinite(header.exposure))
      throw InputError(path,
                       "malformed Radiance header (the product of its exposures is 0 or infinite)");
  }
  read_resolution(bytes.next_line(), header, path);
  return header;
}

void read_component(HdrBytes& bytes, std::span<Rgbe> row, std::size_t c, const std::string& path) {
  for (std::size_t x = 0; x < row.size();) {
    const std::uint8_t control = bytes.next();
    const bool is_run = control > kLongestDump;
    const std::size_t count = is_run ? control - kLongestDump : control;
    if (count == 0 || count > row.size() - x)
      throw InputError(path, fmt::format("malformed Radiance picture (a scanline with {} pixels "
                                         "left goes on by {})",
                                         row.size() - x, count));
    std::uint8_t byte = is_run ? bytes.next() : std::uint8_t{0};
    for (const std::size_t end = x + count; x < end; ++x) {
      if (!is_run) byte = bytes.next();
      row[x][c] = byte;
    }
  }
}

/// Reads a scanline of single pixels; 1 1 1 n repeats the previous one n times, and consecutive
/// such pixels are the digits of n in base 256.
void read_old_row(HdrBytes& bytes, const Rgbe& first, std::span<Rgbe> row,
                  const std::string& path) {
  Rgbe pixel = first;
  std::size_t digit = 1;
  for (std::size_t x = 0;;) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const std::size_t count = pixel[3] * digit;
      if (x == 0 || count > row.size() - x)
        throw InputError(path,
                         "malformed Radiance picture (a repetition of no pixel, or beyond "
                         "its scanline)");
      std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
      x += count;
      digit = std::min<std::size_t>(digit * 256, kMaxEncodedWidth * 256);
    } else {
      row[x++] = pixel;
      digit = 1;
    }
    if (x == row.size()) return;
    pixel = bytes.next_pixel();
  }
}

void read_row(HdrBytes& bytes, std::span<Rgbe> row, const std::string& path) {
  const Rgbe first = bytes.next_pixel();
  const bool is_encoded = first[0] == 2 && first[1] == 2 && first[2] < 128 &&
                          row.size() >= kMinEncodedWidth && row.size() <= kMaxEncodedWidth;
  if (!is_encoded) {
    read_old_row(bytes, first, row, path);
    return;
  }
  const std::size_t length = std::size_t{256} * first[2] + first[3];
  if (length != row.size())
    throw InputError(path, fmt::format("malformed Radiance picture (a scanline of {} pixels, "
                                       "expected {})",
                                       length, row.size()));
  for (std::size_t c = 0; c < 4; ++c) read_component(bytes, row, c, path);
}

/// Throws unless the file holds all rows.
void require_rows(HdrBytes bytes, const HdrHeader& header, const std::string& path) {
  std::vector<Rgbe> row(header.width);
  for (std::size_t y = 0; y < header.height; ++y) read_row(bytes, row, path);
}

}  // namespace

void write_hdr(const std::string& path, const Image& image) {
  const auto picked = picked_channels(path, "Radiance HDR", image, false);
  FileWriter file(path);
  const std::string header = fmt::format(
      "#?RADIANCE\nSOFTWARE=hiac\nFORMAT=32-bit_rle_rgbe\n\n-Y "
      "{} +X {}\n",
      image.height(), image.width());
  file.write(std::as_bytes(std::span(header)));
  std::vector<Rgbe> row(image.width());
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x)
      row[x] = to_rgbe({image.at(x, y, picked.front()), image.at(x, y, picked[picked.size() / 2]),
                        image.at(x, y, picked.back())});
    const std::vector<std::uint8_t> bytes = encode_row(row);
    file.write(std::as_bytes(std::span(bytes)));
  }
  file.close();
  file.commit();
}

Image read_hdr(const std::string& path) {
  const std::vector<std::byte> content = read_whole(path);
  HdrBytes bytes(content, path);
  const HdrHeader header = read_header(bytes, path);
  // a run of 127 bytes takes two; only repetitions of the old kind say more with fewer bytes, and a
  // file of these is looked through before its image takes memory
  constexpr std::size_t kMostUsual = (kLongestRun + 1) / 2;
  if (4 * header.width * header.height / kMostUsual > bytes.size())
    require_rows(bytes, header, path);
  Image image(header.width, header.height, {"R", "G", "B"});
  std::vector<Rgbe> row(header.width);
  for (std::size_t y = 0; y < header.height; ++y) {
    read_row(bytes, row, path);
    for (std::size_t x = 0; x < header.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        image.at(x, y, c) = row[x][3] == 0
                                ? 0
                                : std::ldexp(row[x][c], row[x][3] - kExponentBias - kMantissaBits) /
                                      header.exposure;
  }
  return image;
}

}  // namespace hiac::image_files
