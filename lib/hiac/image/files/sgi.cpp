// SGI's image format, 8 or 16 bits per sample, run-length encoded.
// Based on: P. Haeberli, "The SGI Image File Format, Version 1.00", Silicon Graphics.

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/files/integer_pixels.hpp"

namespace hiac::image_files {
namespace {

constexpr std::uint16_t kSgiMagic = 474;
constexpr std::size_t kHeaderBytes = 512;
constexpr std::size_t kMostRepeats = 127;
constexpr std::size_t kMaxSgiSide = 65535;
constexpr std::uint64_t kMaxFileBytes = std::numeric_limits<std::int32_t>::max();

// Writing -----------------------------------------------------------------------------------------

template <typename T>
void append(std::vector<std::uint8_t>& bytes, T value) {
  for (std::size_t shift = 8 * sizeof(T); shift > 0; shift -= 8)
    bytes.push_back(static_cast<std::uint8_t>(value >> (shift - 8)));
}

void append_sample(std::vector<std::uint8_t>& bytes, int depth, std::size_t value) {
  if (depth == 16)
    append(bytes, static_cast<std::uint16_t>(value));
  else
    append(bytes, static_cast<std::uint8_t>(value));
}

/// Returns how many samples from `at` on are equal, up to the longest run.
std::size_t run_length(std::span<const std::uint16_t> row, std::size_t at) {
  std::size_t length = 1;
  while (at + length < row.size() && length < kMostRepeats && row[at + length] == row[at]) ++length;
  return length;
}

/// Appends runs of three or more as a count and the sample, other samples as a count with the bit
/// 0x80 and the samples; 0 ends the row.
void append_row(std::vector<std::uint8_t>& bytes, std::span<const std::uint16_t> row, int depth) {
  constexpr std::size_t kWorthwhileRun = 3;
  for (std::size_t at = 0; at < row.size();) {
    if (const std::size_t run = run_length(row, at); run >= kWorthwhileRun) {
      append_sample(bytes, depth, run);
      append_sample(bytes, depth, row[at]);
      at += run;
      continue;
    }
    const std::size_t first = at;
    while (at < row.size() && at - first < kMostRepeats && run_length(row, at) < kWorthwhileRun)
      ++at;
    append_sample(bytes, depth, 0x80 | (at - first));
    for (const std::uint16_t sample : row.subspan(first, at - first))
      append_sample(bytes, depth, sample);
  }
  append_sample(bytes, depth, 0);
}

std::vector<std::uint8_t> header_of(const IntegerPixels& pixels) {
  std::vector<std::uint8_t> header;
  append(header, kSgiMagic);
  header.push_back(1);  // run-length encoded
  header.push_back(pixels.depth == 16 ? 2 : 1);
  append(header, static_cast<std::uint16_t>(pixels.channels == 1 ? 2 : 3));  // axes
  for (const std::size_t side : {pixels.width, pixels.height, pixels.channels})
    append(header, static_cast<std::uint16_t>(side));
  append(header, std::uint32_t{0});  // smallest and largest sample
  append(header, std::uint32_t{pixels.largest()});
  header.resize(kHeaderBytes);  // no name, an ordinary image
  return header;
}

// Reading -----------------------------------------------------------------------------------------

/// The bytes of a file with big-endian numbers; every access is checked.
class SgiBytes {
 public:
  SgiBytes(std::span<const std::byte> bytes, const std::string& path)
      : bytes_(bytes), path_(path) {}

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

  [[nodiscard]] std::uint32_t number(std::uint64_t at, std::size_t length) const {
    if (at + length > bytes_.size())
      throw InputError(path_, fmt::format("the file ends too early (expected more than {} bytes)",
                                          bytes_.size()));
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < length; ++i)
      value = value << 8 | std::to_integer<std::uint32_t>(bytes_[at + i]);
    return value;
  }
  [[nodiscard]] std::uint16_t sample(std::uint64_t at, int depth) const {
    return static_cast<std::uint16_t>(number(at, depth == 16 ? 2 : 1));
  }

 private:
  std::span<const std::byte> bytes_;
  const std::string& path_;
};

struct SgiHeader {
  bool is_run_length_encoded = false;
  IntegerPixels pixels;  ///< without samples
};

SgiHeader read_header(const SgiBytes& bytes, const std::string& path) {
  if (bytes.size() < kHeaderBytes || bytes.number(0, 2) != kSgiMagic)
    throw InputError(path, "not an SGI image (wrong magic number, or shorter than its header)");
  const std::uint32_t storage = bytes.number(2, 1), sample_bytes = bytes.number(3, 1);
  const std::uint32_t axes = bytes.number(4, 2), color_map = bytes.number(104, 4);
  if (storage > 1 || sample_bytes < 1 || sample_bytes > 2 || axes < 1 || axes > 3 || color_map != 0)
    throw InputError(path, fmt::format("not an ordinary SGI image (expected storage 0 or 1, 1 or 2 "
                                       "bytes a sample, 1 to 3 axes and colour map 0, found {}, "
                                       "{}, {} and {})",
                                       storage, sample_bytes, axes, color_map));
  SgiHeader header;
  header.is_run_length_encoded = storage == 1;
  header.pixels.depth = static_cast<int>(8 * sample_bytes);
  header.pixels.width = bytes.number(6, 2);
  header.pixels.height = axes >= 2 ? bytes.number(8, 2) : 1;
  header.pixels.channels = axes == 3 ? bytes.number(10, 2) : 1;
  require_sane_size(header.pixels.width, header.pixels.height, header.pixels.channels, path);
  if (header.pixels.channels > 4)
    throw InputError(
        path, fmt::format("an SGI image of {} channels (expected 1 to 4)", header.pixels.channels));
  return header;
}

/// Reads one row of one channel at its position in the file.
void read_row(const SgiBytes& bytes, std::uint64_t at, int depth, std::span<std::uint16_t> row,
              const std::string& path) {
  const std::size_t step = depth == 16 ? 2 : 1;
  std::size_t x = 0;
  while (true) {
    const std::uint16_t control = bytes.sample(at, depth);
    at += step;
    const std::size_t count = control & 0x7f;
    if (count == 0) break;
    if (count > row.size() - x)
      throw InputError(
          path, fmt::format("malformed SGI image (a row longer than {} samples)", row.size()));
    const bool is_run = (control & 0x80) == 0;
    for (const std::size_t end = x + count; x < end; ++x) {
      row[x] = bytes.sample(at, depth);
      if (!is_run) at += step;
    }
    if (is_run) at += step;
  }
  if (x != row.size())
    throw InputError(
        path, fmt::format("malformed SGI image (a row of {} samples, expected {})", x, row.size()));
}

void read_samples(const SgiBytes& bytes, SgiHeader& header, const std::string& path) {
  IntegerPixels& pixels = header.pixels;
  const std::size_t rows = pixels.height * pixels.channels;
  const std::size_t step = pixels.depth == 16 ? 2 : 1;
  // a run of 127 samples takes two units of the file. Rows might share their bytes, but such an
  // image is not worth the memory that a malformed file could demand
  require_possible_size(pixels.width * step, rows,
                        header.is_run_length_encoded ? (kMostRepeats + 1) / 2 : 1,
                        bytes.size() - kHeaderBytes, path);
  pixels.samples.resize(pixels.width * rows);
  std::vector<std::uint16_t> row(pixels.width);
  for (std::size_t c = 0; c < pixels.channels; ++c)
    for (std::size_t y = 0; y < pixels.height; ++y) {
      const std::size_t index = c * pixels.height + y;  // from the bottom row up
      if (header.is_run_length_encoded) {
        read_row(bytes, bytes.number(kHeaderBytes + 4 * index, 4), pixels.depth, row, path);
      } else {
        for (std::size_t x = 0; x < pixels.width; ++x)
          row[x] = bytes.sample(kHeaderBytes + (index * pixels.width + x) * step, pixels.depth);
      }
      const std::size_t top_y = pixels.height - 1 - y;
      for (std::size_t x = 0; x < pixels.width; ++x)
        pixels.samples[(top_y * pixels.width + x) * pixels.channels + c] = row[x];
    }
}

}  // namespace

void write_sgi(const std::string& path, const Image& image, const WriteOptions& options) {
  const IntegerPixels pixels = encode_integers(path, "SGI", image, options);
  if (pixels.width > kMaxSgiSide || pixels.height > kMaxSgiSide)
    throw UsageError(fmt::format("{}: an SGI image has at most {} pixels a side (found {} x {})",
                                 path, kMaxSgiSide, pixels.width, pixels.height));
  const std::size_t rows = pixels.height * pixels.channels;
  std::vector<std::uint8_t> offsets, lengths, packed;
  std::vector<std::uint16_t> row(pixels.width);
  for (std::size_t index = 0; index < rows; ++index) {
    const std::size_t c = index / pixels.height, y = pixels.height - 1 - index % pixels.height;
    for (std::size_t x = 0; x < pixels.width; ++x)
      row[x] = pixels.samples[(y * pixels.width + x) * pixels.channels + c];
    const std::size_t before = packed.size();
    append_row(packed, row, pixels.depth);
    append(offsets, static_cast<std::uint32_t>(kHeaderBytes + 8 * rows + before));
    append(lengths, static_cast<std::uint32_t>(packed.size() - before));
    if (kHeaderBytes + 8 * rows + packed.size() > kMaxFileBytes)
      throw UsageError(
          fmt::format("{}: larger than an SGI image can be ({} bytes)", path, kMaxFileBytes));
  }
  FileWriter file(path);
  for (const auto& part : {header_of(pixels), offsets, lengths, packed})
    file.write(std::as_bytes(std::span(part)));
  file.close();
  file.commit();
}

Image read_sgi(const std::string& path, bool linear) {
  const std::vector<std::byte> content = read_whole(path);
  const SgiBytes bytes(content, path);
  SgiHeader header = read_header(bytes, path);
  header.pixels.gamma = linear ? 1 : 0;
  read_samples(bytes, header, path);
  return decode_integers(header.pixels);
}

}  // namespace hiac::image_files
