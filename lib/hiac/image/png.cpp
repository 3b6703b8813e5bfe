#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "hiac/base/error.hpp"
#include "hiac/image/image_formats.hpp"
#include "hiac/image/srgb.hpp"

namespace hiac::image_files {
namespace {

// libpng reports errors by longjmp. Every function here that calls it holds nothing that a jump
// would have to destroy; messages travel in this buffer.
struct Complaint {
  std::array<char, 256> text{};
};

void complain(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<Complaint*>(png_get_error_ptr(png));
  std::strncpy(complaint->text.data(), message, complaint->text.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// Pixels as the file holds them: straight alpha, encoded, top row first, samples big-endian.
struct PngPixels {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bit_depth = 8;  ///< 8 or 16
  int color_type = PNG_COLOR_TYPE_RGB;
  double gamma = 0;  ///< the exponent that the file names; 0: sRGB
  std::vector<png_byte> bytes;

  [[nodiscard]] std::size_t channels() const {
    return static_cast<std::size_t>((color_type & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1) +
           ((color_type & PNG_COLOR_MASK_ALPHA) != 0 ? 1 : 0);
  }
  [[nodiscard]] std::size_t row_bytes() const {
    return width * channels() * (bit_depth == 16 ? 2 : 1);
  }
};

// Writing -----------------------------------------------------------------------------------------

png_byte to_byte(double value, bool linear) {
  if (!(value > 0)) return 0;
  const double clamped = std::min(value, 1.0);
  return static_cast<png_byte>(std::floor((linear ? clamped : srgb_encode(clamped)) * 255 + 0.5));
}

/// The image's channels that the file will hold: colour or grey first, then alpha if it is there.
std::vector<std::size_t> picked_channels(const std::string& path, const Image& image,
                                         const WriteOptions& options) {
  std::vector<std::size_t> picked;
  for (const char* name : {"R", "G", "B"})
    if (const auto index = image.channel_index(name)) picked.push_back(*index);
  if (picked.empty())
    if (const auto index = image.channel_index("Y")) picked.push_back(*index);
  if (picked.size() != 1 && picked.size() != 3)
    throw UsageError(fmt::format("{}: PNG needs the channels R G B or Y (found {})", path,
                                 fmt::join(image.channels(), " ")));
  if (const auto alpha = image.channel_index("A"); alpha && !options.background_included)
    picked.push_back(*alpha);
  return picked;
}

PngPixels encode(const Image& image, std::span<const std::size_t> picked, bool linear) {
  const bool has_alpha = picked.size() % 2 == 0;
  PngPixels pixels;
  pixels.width = static_cast<png_uint_32>(image.width());
  pixels.height = static_cast<png_uint_32>(image.height());
  pixels.color_type =
      (picked.size() >= 3 ? PNG_COLOR_MASK_COLOR : 0) | (has_alpha ? PNG_COLOR_MASK_ALPHA : 0);
  pixels.gamma = linear ? 1 : 0;
  pixels.bytes.reserve(pixels.row_bytes() * image.height());
  const std::size_t colors = picked.size() - (has_alpha ? 1 : 0);
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      const auto pixel = image.pixel(x, y);
      const double alpha = has_alpha ? pixel[picked.back()] : 1;
      for (std::size_t c = 0; c < colors; ++c)
        pixels.bytes.push_back(to_byte(pixel[picked[c]] / alpha, linear));
      if (has_alpha) pixels.bytes.push_back(to_byte(alpha, true));
    }
  }
  return pixels;
}

std::vector<png_text> texts_of(const WriteOptions& options) {
  std::vector<png_text> texts;
  for (const auto& [name, value] : options.attributes) {
    png_text& text = texts.emplace_back();
    text = {};
    text.compression = PNG_ITXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(name.c_str());  // libpng copies them
    text.text = const_cast<char*>(value.c_str());
    text.itxt_length = value.size();
  }
  return texts;
}

bool write_pixels(png_structp png, png_infop info, std::FILE* file, const PngPixels& pixels,
                  std::span<const png_text> texts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_IHDR(png, info, pixels.width, pixels.height, pixels.bit_depth, pixels.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (pixels.gamma == 0)
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  else
    png_set_gAMA(png, info, pixels.gamma);
  if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < pixels.height; ++y)
    png_write_row(png, pixels.bytes.data() + y * pixels.row_bytes());
  png_write_end(png, nullptr);
  return true;
}

// Reading -----------------------------------------------------------------------------------------

/// Reads up to the pixels, has them expanded to grey or colour of 8 or 16 bits.
bool read_info(png_structp png, png_infop info, std::FILE* file, PngPixels& pixels) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_user_limits(png, 65536, 65536);
  png_read_info(png, info);
  png_set_expand(png);
  pixels.width = png_get_image_width(png, info);
  pixels.height = png_get_image_height(png, info);
  int intent = 0;
  const bool says_srgb = png_get_sRGB(png, info, &intent) != 0;
  double gamma = 0;
  constexpr double kSrgbGamma = 0.45455;  // how files that are sRGB name it in their gAMA chunk
  if (!says_srgb && png_get_gAMA(png, info, &gamma) != 0 && std::fabs(gamma - kSrgbGamma) > 1e-4)
    pixels.gamma = gamma;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  pixels.bit_depth = png_get_bit_depth(png, info);
  pixels.color_type = png_get_color_type(png, info);
  return true;
}

bool read_rows(png_structp png, png_infop info, PngPixels& pixels, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (png_uint_32 y = 0; y < pixels.height; ++y)
    rows[y] = pixels.bytes.data() + y * pixels.row_bytes();
  png_read_image(png, rows);
  png_read_end(png, info);
  return true;
}

/// Sample to linear value.
double decode(double sample, double gamma) {
  return gamma == 0 ? srgb_decode(sample) : std::pow(sample, 1 / gamma);
}

Image to_image(const PngPixels& pixels) {
  const std::size_t channels = pixels.channels();
  const bool has_alpha = channels % 2 == 0;
  const double scale = pixels.bit_depth == 16 ? 65535 : 255;
  const png_byte* byte = pixels.bytes.data();
  const auto next_sample = [&]() -> double {
    double sample = *byte++;
    if (pixels.bit_depth == 16) sample = 256 * sample + *byte++;
    return sample / scale;
  };
  Image image(pixels.width, pixels.height, default_channel_names(channels));
  for (std::size_t i = 0; i < image.values().size(); i += channels) {
    const auto pixel = image.values().subspan(i, channels);
    std::generate(pixel.begin(), pixel.end(), next_sample);
    const double alpha = has_alpha ? pixel.back() : 1;
    for (std::size_t c = 0; c + (has_alpha ? 1 : 0) < channels; ++c)
      pixel[c] = decode(pixel[c], pixels.gamma) * alpha;
  }
  return image;
}

/// Deflate cannot make data smaller than by this factor: a file that announces more is cut short.
void require_possible_size(const PngPixels& pixels, std::uint64_t file_bytes,
                           const std::string& path) {
  constexpr std::uint64_t kLargestRatio = 1032;
  require_sane_size(pixels.width, pixels.height, pixels.channels(), path);
  const std::uint64_t announced = std::uint64_t{pixels.row_bytes()} * pixels.height;
  if (announced / kLargestRatio > file_bytes)
    throw InputError(path, fmt::format("the file ends too early ({} bytes cannot hold {} x {} "
                                       "pixels)",
                                       file_bytes, pixels.width, pixels.height));
}

/// libpng's two structures for one file, freed whatever happens.
class PngHandle {
 public:
  enum class Mode { read, write };

  explicit PngHandle(Mode mode) : mode_(mode) {
    const auto create = mode == Mode::read ? png_create_read_struct : png_create_write_struct;
    png = create(PNG_LIBPNG_VER_STRING, &complaint_, complain, ignore_warning);
    if (png == nullptr) throw std::bad_alloc();
    info = png_create_info_struct(png);
  }
  ~PngHandle() {
    if (mode_ == Mode::read)
      png_destroy_read_struct(&png, &info, nullptr);
    else
      png_destroy_write_struct(&png, &info);
  }
  PngHandle(const PngHandle&) = delete;
  PngHandle& operator=(const PngHandle&) = delete;

  [[nodiscard]] const char* complaint() const { return complaint_.text.data(); }

  png_structp png = nullptr;
  png_infop info = nullptr;

 private:
  Mode mode_;
  Complaint complaint_;
};

}  // namespace

void write_png(const std::string& path, const Image& image, const WriteOptions& options) {
  const PngPixels pixels = encode(image, picked_channels(path, image, options), options.linear);
  const std::vector<png_text> texts = texts_of(options);
  FileWriter file(path);
  PngHandle handle(PngHandle::Mode::write);
  if (!write_pixels(handle.png, handle.info, file.handle(), pixels, texts))
    throw InputError(path, fmt::format("cannot be written ({})", handle.complaint()));
  file.close();
  file.commit();
}

ImageFile read_png(const std::string& path) {
  const FileHandle file = open_image_file(path);
  const std::uint64_t file_bytes = remaining_bytes(file.get(), path);
  const auto malformed = [&](const PngHandle& handle) {
    return InputError(path, fmt::format("not a readable PNG file ({})", handle.complaint()));
  };
  PngHandle handle(PngHandle::Mode::read);
  PngPixels pixels;
  if (!read_info(handle.png, handle.info, file.get(), pixels)) throw malformed(handle);
  require_possible_size(pixels, file_bytes, path);
  pixels.bytes.resize(pixels.row_bytes() * pixels.height);
  std::vector<png_bytep> rows(pixels.height);
  if (!read_rows(handle.png, handle.info, pixels, rows.data())) throw malformed(handle);
  ImageFile read{to_image(pixels), {}};
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(handle.png, handle.info, &texts, &count);
  for (int i = 0; i < count; ++i)
    read.attributes.emplace_back(texts[i].key, texts[i].text != nullptr ? texts[i].text : "");
  return read;
}

}  // namespace hiac::image_files
