// numpy's .npy format, versions 1.0 to 3.0.
// Based on: "NEP 1 - A Simple File Format for NumPy Arrays" (numpy.lib.format).

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"

namespace hiac::image_files {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;
constexpr std::size_t kMaxHeaderBytes = 65536;

/// The content of the header's dictionary.
struct NpyHeader {
  std::string descriptor;  ///< "<f8"
  bool column_major = false;
  std::vector<std::uint64_t> shape;
};

/// Returns the text of the value of 'key' in the dictionary, up to the comma or brace that ends it.
std::string_view value_of(std::string_view dictionary, std::string_view key,
                          const std::string& path) {
  const std::size_t at = dictionary.find(fmt::format("'{}'", key));
  const std::size_t colon = at == std::string_view::npos ? at : dictionary.find(':', at);
  if (colon == std::string_view::npos)
    throw InputError(path, fmt::format("malformed numpy header (expected the key '{}')", key));
  std::string_view rest = dictionary.substr(colon + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return rest.substr(0, rest.starts_with('(') ? rest.find(')') : rest.find_first_of(",}"));
}

std::vector<std::uint64_t> parse_shape(std::string_view text, const std::string& path) {
  std::vector<std::uint64_t> shape;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (true) {
    while (at != end && (*at == '(' || *at == ' ' || *at == ',')) ++at;
    if (at == end) return shape;
    const auto [next, error] = std::from_chars(at, end, shape.emplace_back());
    if (error != std::errc{} || shape.size() > 3)
      throw InputError(path, "malformed numpy header (expected a shape of two or three axes)");
    at = next;
  }
}

NpyHeader read_header(std::FILE* file, const std::string& path) {
  std::array<char, 8> start{};
  read_exactly(file, std::as_writable_bytes(std::span(start)), path);
  if (std::string_view(start.data(), kMagic.size()) != kMagic)
    throw InputError(path, "not a numpy file (the magic bytes are missing)");
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3)
    throw InputError(path, fmt::format("numpy format version {} (expected 1 to 3)", version));
  std::array<std::uint8_t, 4> length{};
  read_exactly(file, std::as_writable_bytes(std::span(length).first(version == 1 ? 2 : 4)), path);
  const std::size_t bytes = length[0] + std::size_t{256} * length[1] +
                            std::size_t{65536} * length[2] + std::size_t{16777216} * length[3];
  if (bytes > kMaxHeaderBytes)
    throw InputError(path, fmt::format("malformed numpy header ({} bytes)", bytes));
  std::string text(bytes, '\0');
  read_exactly(file, std::as_writable_bytes(std::span(text)), path);

  NpyHeader header;
  const std::string_view descriptor = value_of(text, "descr", path);
  if (descriptor.size() >= 2) header.descriptor = descriptor.substr(1, descriptor.size() - 2);
  header.column_major = value_of(text, "fortran_order", path).starts_with("True");
  header.shape = parse_shape(value_of(text, "shape", path), path);
  return header;
}

template <typename T>
double from_bytes(const std::byte* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

using Decode = double (*)(const std::byte*);

/// Returns the function that reads a number of a type, which is given without its byte order: "f8".
Decode decoder_of(std::string_view type) {
  constexpr std::pair<std::string_view, Decode> kDecoders[] = {
      {"f8", from_bytes<double>},        {"f4", from_bytes<float>},
      {"u1", from_bytes<std::uint8_t>},  {"i1", from_bytes<std::int8_t>},
      {"u2", from_bytes<std::uint16_t>}, {"i2", from_bytes<std::int16_t>},
      {"u4", from_bytes<std::uint32_t>}, {"i4", from_bytes<std::int32_t>},
      {"u8", from_bytes<std::uint64_t>}, {"i8", from_bytes<std::int64_t>}};
  for (const auto& [name, decode] : kDecoders)
    if (name == type) return decode;
  return nullptr;
}

/// Returns the numbers of the file in the file's order.
std::vector<double> read_numbers(std::FILE* file, const std::string& descriptor, std::size_t count,
                                 const std::string& path) {
  const Decode decode = descriptor.size() == 3 ? decoder_of(descriptor.substr(1)) : nullptr;
  if (decode == nullptr || std::strchr("<>|=", descriptor[0]) == nullptr)
    throw InputError(path, fmt::format("numbers of type '{}' (expected floats of 4 or 8 bytes or "
                                       "integers)",
                                       descriptor));
  const auto size = static_cast<std::size_t>(descriptor[2] - '0');
  const std::uint64_t there = remaining_bytes(file, path);
  if (there != count * size)
    throw InputError(path, fmt::format("wrong length (expected {} bytes of numbers, found {})",
                                       count * size, there));
  std::vector<double> numbers(count);
  std::vector<std::byte> block(std::min<std::size_t>(count, 65536) * size);
  for (std::size_t done = 0; done < count;) {
    const std::size_t now = std::min(count - done, block.size() / size);
    read_exactly(file, std::span(block).first(now * size), path);
    for (std::size_t i = 0; i < now; ++i) {
      std::byte* number = &block[i * size];
      if (descriptor[0] == '>') std::reverse(number, number + size);
      numbers[done + i] = decode(number);
    }
    done += now;
  }
  return numbers;
}

}  // namespace

void write_npy(const std::string& path, const Image& image) {
  std::string header =
      fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}, {}), }}",
                  image.height(), image.width(), image.channel_count());
  const std::size_t before = kMagic.size() + 4;
  const std::size_t total = (before + header.size() + 1 + kAlignment - 1) / kAlignment * kAlignment;
  header.resize(total - before - 1, ' ');
  header += '\n';
  std::string start(kMagic);
  start +=
      {'\1', '\0', static_cast<char>(header.size() % 256), static_cast<char>(header.size() / 256)};

  FileWriter file(path);
  file.write(std::as_bytes(std::span(start)));
  file.write(std::as_bytes(std::span(header)));
  file.write(std::as_bytes(image.values()));
  file.close();
  file.commit();
}

Image read_npy(const std::string& path) {
  const FileHandle file = open_image_file(path);
  NpyHeader header = read_header(file.get(), path);
  if (header.shape.size() == 2) header.shape.push_back(1);
  if (header.shape.size() != 3)
    throw InputError(path, fmt::format("an array of {} axes (expected 2 or 3: height, width and "
                                       "channels)",
                                       header.shape.size()));
  const auto [height, width, channels] =
      std::array{header.shape[0], header.shape[1], header.shape[2]};
  require_sane_size(width, height, channels, path);
  std::vector<double> numbers =
      read_numbers(file.get(), header.descriptor, width * height * channels, path);
  if (!header.column_major)
    return {width, height, default_channel_names(channels), std::move(numbers)};
  Image image(width, height, default_channel_names(channels));
  for (std::size_t c = 0, i = 0; c < channels; ++c)
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t y = 0; y < height; ++y) image.at(x, y, c) = numbers[i++];
  return image;
}

}  // namespace hiac::image_files
