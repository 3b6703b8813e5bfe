// TIFF through libtiff: integers of 8 or 16 bits with straight alpha, float32 with premultiplied.

#include <algorithm>
#include <cstdarg>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <tiffio.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_description.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/files/integer_pixels.hpp"

namespace hiac::image_files {
namespace {

// libtiff's access to files, and its messages ---------------------------------------------------

/// The first error that libtiff reports, on one line.
struct TiffComplaint {
  std::array<char, 256> text{};
};

int complain(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& text = static_cast<TiffComplaint*>(user)->text;
  if (text.front() != '\0') return 1;
  std::vsnprintf(text.data(), text.size(), format, arguments);
  std::ranges::replace(text, '\n', ' ');
  return 1;
}
int ignore_warning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

std::FILE* file_of(thandle_t handle) { return static_cast<std::FILE*>(handle); }

tmsize_t read_bytes(thandle_t handle, void* into, tmsize_t count) {
  return static_cast<tmsize_t>(
      std::fread(into, 1, static_cast<std::size_t>(count), file_of(handle)));
}
tmsize_t write_bytes(thandle_t handle, void* bytes, tmsize_t count) {
  return static_cast<tmsize_t>(
      std::fwrite(bytes, 1, static_cast<std::size_t>(count), file_of(handle)));
}
toff_t seek(thandle_t handle, toff_t offset, int from) {
  if (std::fseek(file_of(handle), static_cast<long>(offset), from) != 0)
    return static_cast<toff_t>(-1);
  return static_cast<toff_t>(std::ftell(file_of(handle)));
}
int leave_open(thandle_t) { return 0; }
toff_t size_of(thandle_t handle) {
  const long here = std::ftell(file_of(handle));
  std::fseek(file_of(handle), 0, SEEK_END);
  const long size = std::ftell(file_of(handle));
  std::fseek(file_of(handle), here, SEEK_SET);
  return static_cast<toff_t>(size);
}

/// An open TIFF; its owner closes the file.
class Tiff {
 public:
  Tiff(std::FILE* file, const std::string& path, const char* mode, std::uint64_t largest_memory) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(
        TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(largest_memory));
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), complain, &complaint_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, nullptr);
    tiff_.reset(TIFFClientOpenExt(path.c_str(), mode, file, read_bytes, write_bytes, seek,
                                  leave_open, size_of, nullptr, nullptr, options.get()));
  }

  [[nodiscard]] bool is_open() const { return tiff_ != nullptr; }
  [[nodiscard]] TIFF* get() const { return tiff_.get(); }
  [[nodiscard]] const char* complaint() const { return complaint_.text.data(); }

  /// Returns the value of a 16-bit tag, or its default if the file lacks it.
  [[nodiscard]] std::uint16_t tag(std::uint32_t tag) const {
    std::uint16_t value = 0;
    TIFFGetFieldDefaulted(get(), tag, &value);
    return value;
  }

 private:
  TiffComplaint complaint_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_{nullptr, TIFFClose};
};

/// The properties that determine how samples are stored.
struct Layout {
  std::size_t width = 0;
  std::size_t height = 0;
  std::size_t channels = 0;  ///< 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
  int depth = 8;             ///< 8 or 16: integers; 32: float32
  bool premultiplied = false;

  [[nodiscard]] std::size_t row_bytes() const {
    return width * channels * static_cast<std::size_t>(depth) / 8;
  }
  [[nodiscard]] bool has_alpha() const { return channels % 2 == 0; }
};

// Writing -----------------------------------------------------------------------------------------

constexpr std::string_view kSoftware = "Software";

/// Files larger than this before compression become BigTIFF.
constexpr std::uint64_t kMaxClassicBytes = std::uint64_t{1} << 31;

/// The attribute "Software" has a tag of its own, the others are in ImageDescription.
void set_texts(TIFF* tiff, const Attributes& attributes) {
  Attributes described;
  std::string software = "hiac";
  for (const auto& [name, text] : attributes) {
    if (name == kSoftware)
      software = text;
    else
      described.emplace_back(name, text);
  }
  TIFFSetField(tiff, TIFFTAG_SOFTWARE, software.c_str());
  if (const std::string text = to_description(described); !text.empty())
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, text.c_str());
}

void set_tags(TIFF* tiff, const Layout& layout) {
  const bool is_float = layout.depth == 32;
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(layout.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(layout.height));
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, layout.depth);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(layout.channels));
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
               layout.channels >= 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_PREDICTOR, is_float ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff, 0));
  if (!layout.has_alpha()) return;
  const std::uint16_t alpha =
      layout.premultiplied ? EXTRASAMPLE_ASSOCALPHA : EXTRASAMPLE_UNASSALPHA;
  TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
}

/// Calls `fill(y, row)` to store the bytes of row y, from the top.
template <typename Fill>
void write_rows(const std::string& path, const Layout& layout, const Attributes& attributes,
                const Fill& fill) {
  FileWriter writer(path);
  {
    const std::uint64_t bytes = std::uint64_t{layout.row_bytes()} * layout.height;
    const Tiff tiff(writer.handle(), path, bytes > kMaxClassicBytes ? "w8" : "w", 0);
    bool fine = tiff.is_open();
    if (fine) {
      set_tags(tiff.get(), layout);
      set_texts(tiff.get(), attributes);
    }
    std::vector<std::byte> row(layout.row_bytes());
    for (std::size_t y = 0; fine && y < layout.height; ++y) {
      fill(y, std::span(row));
      fine = TIFFWriteScanline(tiff.get(), row.data(), static_cast<std::uint32_t>(y), 0) == 1;
    }
    if (!fine || TIFFFlush(tiff.get()) != 1) writer.fail(tiff.complaint());
  }
  writer.close();
  writer.commit();
}

void write_floats(const std::string& path, const Image& image, const Attributes& attributes) {
  const auto picked = picked_channels(path, "TIFF", image, true);
  const Layout layout{image.width(), image.height(), picked.size(), 32, true};
  write_rows(path, layout, attributes, [&](std::size_t y, std::span<std::byte> row) {
    for (std::size_t x = 0; x < image.width(); ++x)
      for (std::size_t c = 0; c < picked.size(); ++c) {
        const auto value = static_cast<float>(image.at(x, y, picked[c]));
        std::memcpy(&row[(x * picked.size() + c) * sizeof value], &value, sizeof value);
      }
  });
}

// Reading -----------------------------------------------------------------------------------------

/// LZW's longest codes represent this many times their own size.
constexpr std::uint64_t kLargestRatio = 4096;

/// Returns whether a compression's decoder needs no more memory than a strip; other compressions
/// are rarely used for pictures that are data.
bool is_known_compression(std::uint16_t compression) {
  return compression == COMPRESSION_NONE || compression == COMPRESSION_LZW ||
         compression == COMPRESSION_PACKBITS || compression == COMPRESSION_DEFLATE ||
         compression == COMPRESSION_ADOBE_DEFLATE;
}

void require_known_kind(const Tiff& tiff, const std::string& path) {
  const auto require = [&](bool fine, const char* what, const char* expected, int found) {
    if (!fine)
      throw InputError(path, fmt::format("a TIFF file with {} that is not read (expected {}, "
                                         "found {})",
                                         what, expected, found));
  };
  const std::uint16_t compression = tiff.tag(TIFFTAG_COMPRESSION);
  require(is_known_compression(compression), "a compression", "none, LZW, PackBits or Deflate",
          compression);
  require(TIFFIsTiled(tiff.get()) == 0, "tiles", "strips", 1);
  const std::uint16_t photometric = tiff.tag(TIFFTAG_PHOTOMETRIC);
  require(photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_RGB,
          "a photometric interpretation", "black is zero (1) or RGB (2)", photometric);
  const std::uint16_t orientation = tiff.tag(TIFFTAG_ORIENTATION);
  require(orientation == ORIENTATION_TOPLEFT, "an orientation", "1, from the top left",
          orientation);
  const std::uint16_t channels = tiff.tag(TIFFTAG_SAMPLESPERPIXEL);
  const int colors = photometric == PHOTOMETRIC_RGB ? 3 : 1;
  require(channels == colors || channels == colors + 1, "channels", "grey or RGB, and alpha",
          channels);
  const std::uint16_t depth = tiff.tag(TIFFTAG_BITSPERSAMPLE);
  const std::uint16_t format = tiff.tag(TIFFTAG_SAMPLEFORMAT);
  require(format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_IEEEFP, "a sample format",
          "1, unsigned, or 3, floating-point", format);
  require(format == SAMPLEFORMAT_IEEEFP ? depth == 32 : depth == 8 || depth == 16, "a depth",
          "8 or 16 bits, or float32", depth);
}

Layout read_layout(const Tiff& tiff, const std::string& path) {
  require_known_kind(tiff, path);
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  Layout layout{width, height, tiff.tag(TIFFTAG_SAMPLESPERPIXEL), tiff.tag(TIFFTAG_BITSPERSAMPLE),
                false};
  require_sane_size(width, height, layout.channels, path);
  layout.premultiplied = layout.depth == 32;  // if the file does not say: as this file writes it
  std::uint16_t count = 0;
  const std::uint16_t* kinds = nullptr;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
  if (count > 0 && kinds[0] != EXTRASAMPLE_UNSPECIFIED)
    layout.premultiplied = kinds[0] == EXTRASAMPLE_ASSOCALPHA;
  return layout;
}

/// Returns the file's rows in order, channels interleaved; memory grows as they are decoded.
std::vector<std::byte> read_rows(const Tiff& tiff, const Layout& layout, const std::string& path) {
  const bool is_planar = tiff.tag(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  const auto sample_bytes = static_cast<std::size_t>(layout.depth) / 8;
  const std::size_t pixel_bytes = layout.channels * sample_bytes;
  const std::size_t planes = is_planar ? layout.channels : 1;
  const std::size_t step = is_planar ? sample_bytes : pixel_bytes;
  std::vector<std::byte> row(layout.row_bytes() / planes);
  if (TIFFScanlineSize(tiff.get()) != static_cast<tmsize_t>(row.size()))
    throw InputError(path, "not a readable TIFF file (rows of another length than their pixels)");
  std::vector<std::byte> bytes;
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (std::size_t y = 0; y < layout.height; ++y) {
      if (TIFFReadScanline(tiff.get(), row.data(), static_cast<std::uint32_t>(y),
                           static_cast<std::uint16_t>(plane)) != 1)
        throw InputError(path, fmt::format("not a readable TIFF file ({})", tiff.complaint()));
      if (plane == 0) bytes.resize(bytes.size() + layout.row_bytes());
      std::byte* const start = bytes.data() + y * layout.row_bytes() + plane * sample_bytes;
      for (std::size_t x = 0; x < layout.width; ++x)
        std::copy_n(row.data() + x * step, step, start + x * pixel_bytes);
    }
  return bytes;
}

Attributes read_texts(const Tiff& tiff) {
  Attributes attributes;
  const char* text = nullptr;
  if (TIFFGetField(tiff.get(), TIFFTAG_SOFTWARE, &text) == 1)
    attributes.emplace_back(kSoftware, text);
  if (TIFFGetField(tiff.get(), TIFFTAG_IMAGEDESCRIPTION, &text) == 1)
    for (auto& attribute : from_description(text)) attributes.push_back(std::move(attribute));
  return attributes;
}

template <typename Sample>
Sample sample_at(std::span<const std::byte> bytes, std::size_t index) {
  Sample sample;
  std::memcpy(&sample, &bytes[index * sizeof sample], sizeof sample);
  return sample;
}

Image floats_to_image(const Layout& layout, std::span<const std::byte> bytes) {
  Image image(layout.width, layout.height, default_channel_names(layout.channels));
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = static_cast<double>(sample_at<float>(bytes, i));
  if (layout.premultiplied || !layout.has_alpha()) return image;
  for (std::size_t i = 0; i < image.values().size(); i += layout.channels)
    for (std::size_t c = 0; c + 1 < layout.channels; ++c)
      image.values()[i + c] *= image.values()[i + layout.channels - 1];
  return image;
}

Image integers_to_image(const Layout& layout, std::span<const std::byte> bytes, bool linear) {
  IntegerPixels pixels{layout.width,
                       layout.height,
                       layout.channels,
                       layout.depth,
                       linear ? 1.0 : 0.0,
                       layout.premultiplied,
                       {}};
  pixels.samples.resize(layout.width * layout.height * layout.channels);
  for (std::size_t i = 0; i < pixels.samples.size(); ++i)
    pixels.samples[i] =
        layout.depth == 16 ? sample_at<std::uint16_t>(bytes, i) : sample_at<std::uint8_t>(bytes, i);
  return decode_integers(pixels);
}

}  // namespace

void write_tiff(const std::string& path, const Image& image, const WriteOptions& options) {
  if (options.depth == 32) {
    write_floats(path, image, options.attributes);
    return;
  }
  const IntegerPixels pixels = encode_integers(path, "TIFF", image, options);
  const Layout layout{pixels.width, pixels.height, pixels.channels, pixels.depth, false};
  const std::size_t row_samples = pixels.width * pixels.channels;
  write_rows(path, layout, options.attributes, [&](std::size_t y, std::span<std::byte> row) {
    const auto samples = std::span(pixels.samples).subspan(y * row_samples, row_samples);
    if (pixels.depth == 16) {
      std::memcpy(row.data(), samples.data(), row.size());
      return;
    }
    std::transform(samples.begin(), samples.end(), row.begin(),
                   [](std::uint16_t sample) { return static_cast<std::byte>(sample); });
  });
}

ImageFile read_tiff(const std::string& path, bool linear) {
  const FileHandle file = open_image_file(path);
  const std::uint64_t file_bytes = remaining_bytes(file.get(), path);
  const Tiff tiff(file.get(), path, "rm", kHarmlessBytes + 2 * file_bytes);
  if (!tiff.is_open())
    throw InputError(path, fmt::format("not a readable TIFF file ({})", tiff.complaint()));
  const Layout layout = read_layout(tiff, path);
  require_possible_size(layout.row_bytes(), layout.height, kLargestRatio, file_bytes, path);
  const std::vector<std::byte> bytes = read_rows(tiff, layout, path);
  return {layout.depth == 32 ? floats_to_image(layout, bytes)
                             : integers_to_image(layout, bytes, linear),
          read_texts(tiff)};
}

}  // namespace hiac::image_files
