#include "hiac/image/image_io.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/files/isolated_image.hpp"

namespace hiac {
namespace {

using namespace image_files;

using Writer = void (*)(const std::string&, const Image&, const WriteOptions&);
using Reader = ImageFile (*)(const std::string&, const ReadOptions&);

struct Format {
  const char* extension;
  std::array<int, 3> depths;  ///< bits per sample that write_image accepts, then zeros
  Writer write;
  Reader read;
  int integer_depth;    ///< largest depth of integer samples; 0: all are floating-point
  const char* library;  ///< that reads it, in a process of its own; null: our own code reads it
};

// Adapters for formats without options, and for formats without texts.
template <void (*write)(const std::string&, const Image&)>
void write_plain(const std::string& path, const Image& image, const WriteOptions&) {
  write(path, image);
}
template <Image (*read)(const std::string&)>
ImageFile read_plain(const std::string& path, const ReadOptions&) {
  return {read(path), {}};
}
template <Image (*read)(const std::string&, bool)>
ImageFile read_integers(const std::string& path, const ReadOptions& options) {
  return {read(path, options.linear), {}};
}
ImageFile read_tiff_file(const std::string& path, const ReadOptions& options) {
  return read_tiff(path, options.linear);
}
template <ImageFile (*read)(const std::string&)>
ImageFile read_with_texts(const std::string& path, const ReadOptions&) {
  return read(path);
}

ImageFile read_raw(const std::string& path, const ReadOptions& options) {
  return {read_f32(path, options.width), {}};
}

constexpr Format kFormats[] = {
    {".exr", {32}, write_exr, read_with_texts<read_exr>, 0, "OpenEXR"},
    {".npy", {64}, write_plain<write_npy>, read_plain<read_npy>, 0, nullptr},
    {".f32", {32}, write_plain<write_f32>, read_raw, 0, nullptr},
    {".png", {8, 16}, write_png, read_with_texts<read_png>, 16, "libpng"},
    {".tiff", {8, 16, 32}, write_tiff, read_tiff_file, 16, "libtiff"},
    {".tif", {8, 16, 32}, write_tiff, read_tiff_file, 16, "libtiff"},
    {".sgi", {8, 16}, write_sgi, read_integers<read_sgi>, 16, nullptr},
    {".rgba", {8, 16}, write_sgi, read_integers<read_sgi>, 16, nullptr},
    {".pfm", {32}, write_plain<write_pfm>, read_plain<read_pfm>, 0, nullptr},
    {".hdr", {8}, write_plain<write_hdr>, read_plain<read_hdr>, 0, nullptr},
};

/// The format that the name's extension tells, or null; an extension alone (".png") is a name too.
const Format* find_format(const std::string& path) {
  const bool alone = path.starts_with('.') && path.find_first_of("./", 1) == std::string::npos;
  std::string extension = alone ? path : std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const format =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const Format& known) { return extension == known.extension; });
  return format == std::end(kFormats) ? nullptr : format;
}

const Format& format_of(const std::string& path) {
  if (const Format* format = find_format(path)) return *format;
  const std::string extension = std::filesystem::path(path).extension().string();
  throw UsageError(
      fmt::format("{}: not an image format that is known (expected one of {}, found {})", path,
                  image_extensions(), extension.empty() ? "no extension" : extension));
}

/// Returns the requested depth, or the format's first.
int depth_of(const Format& format, const std::string& path, int depth) {
  if (depth == 0) return format.depths.front();
  std::string known;
  for (const int candidate : format.depths) {
    if (candidate == depth) return depth;
    if (candidate != 0) known += fmt::format("{}{}", known.empty() ? "" : ", ", candidate);
  }
  throw UsageError(fmt::format("{}: {} bits a sample (a {} image has {})", path, depth,
                               format.extension, known));
}

}  // namespace

void write_image(const std::string& path, const Image& image, const WriteOptions& options) {
  const Format& format = format_of(options.format.empty() ? path : options.format);
  if (image.values().empty()) throw UsageError(path + ": an image without pixels");
  WriteOptions with_depth = options;
  with_depth.depth = depth_of(format, path, options.depth);
  format.write(path, image, with_depth);
}

void require_known_image_extension(const std::string& path, int depth) {
  depth_of(format_of(path), path, depth);
}

bool has_integer_samples(const std::string& path, int depth) {
  const Format& format = format_of(path);
  return depth_of(format, path, depth) <= format.integer_depth;
}

std::vector<std::string> files_of_image(const std::string& path,
                                        const std::vector<std::string>& further_channels) {
  if (format_of(path).write != write_plain<write_f32>) return {path};
  std::vector<std::string> channels = rgba_channels();
  channels.insert(channels.end(), further_channels.begin(), further_channels.end());
  std::vector<std::string> files;
  for (const std::string& channel : channels) files.push_back(f32_channel_path(path, channel));
  return files;
}

bool has_image_extension(const std::string& path) { return find_format(path) != nullptr; }

std::string image_extensions() {
  std::string known;
  for (const Format& format : kFormats)
    known += fmt::format("{}{}", known.empty() ? "" : " ", format.extension);
  return known;
}

ImageFile read_image(const std::string& path, const ReadOptions& options) {
  const Format& format = format_of(path);
  if (format.library == nullptr) return format.read(path, options);
  return read_isolated_image(path, format.library, [&] { return format.read(path, options); });
}

}  // namespace hiac
