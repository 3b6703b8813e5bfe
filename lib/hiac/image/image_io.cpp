#include "hiac/image/image_io.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_formats.hpp"

namespace hiac {
namespace {

using namespace image_files;

using Writer = void (*)(const std::string&, const Image&, const WriteOptions&);
using Reader = ImageFile (*)(const std::string&, std::size_t width);

struct Format {
  const char* extension;
  Writer write;
  Reader read;
};

constexpr Format kFormats[] = {
    {".exr", write_exr, [](const std::string& path, std::size_t) { return read_exr(path); }},
    {".npy",
     [](const std::string& path, const Image& image, const WriteOptions&) {
       write_npy(path, image);
     },
     [](const std::string& path, std::size_t) {
       return ImageFile{read_npy(path), {}};
     }},
    {".f32",
     [](const std::string& path, const Image& image, const WriteOptions&) {
       write_f32(path, image);
     },
     [](const std::string& path, std::size_t width) {
       return ImageFile{read_f32(path, width), {}};
     }},
    {".png", write_png, [](const std::string& path, std::size_t) { return read_png(path); }},
};

/// The format that the name's extension tells, or null.
const Format* find_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const format =
      std::find_if(std::begin(kFormats), std::end(kFormats),
                   [&](const Format& known) { return extension == known.extension; });
  return format == std::end(kFormats) ? nullptr : format;
}

const Format& format_of(const std::string& path) {
  if (const Format* format = find_format(path)) return *format;
  std::string known;
  for (const Format& format : kFormats)
    known += fmt::format("{}{}", known.empty() ? "" : " ", format.extension);
  const std::string extension = std::filesystem::path(path).extension().string();
  throw UsageError(
      fmt::format("{}: not an image format that is known (expected one of {}, found {})", path,
                  known, extension.empty() ? "no extension" : extension));
}

}  // namespace

void write_image(const std::string& path, const Image& image, const WriteOptions& options) {
  const Format& format = format_of(path);
  if (image.values().empty()) throw UsageError(path + ": an image without pixels");
  format.write(path, image, options);
}

void require_known_image_extension(const std::string& path) { format_of(path); }

bool has_image_extension(const std::string& path) { return find_format(path) != nullptr; }

ImageFile read_image(const std::string& path, std::size_t width) {
  return format_of(path).read(path, width);
}

}  // namespace hiac
