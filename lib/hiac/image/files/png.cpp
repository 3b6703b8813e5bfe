#include <cmath>
#include <csetjmp>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <png.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"
#include "hiac/image/files/integer_pixels.hpp"

namespace hiac::image_files {
namespace {

// libpng reports errors by longjmp. Functions here that call it own nothing that a jump would have
// to destroy; they return messages in this buffer.
struct PngComplaint {
  std::array<char, 256> text{};
};

void complain(png_structp png, png_const_charp message) {
  auto* complaint = static_cast<PngComplaint*>(png_get_error_ptr(png));
  std::strncpy(complaint->text.data(), message, complaint->text.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// The rows of a file: samples of one or two bytes, most significant byte first.
struct PngRows {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bit_depth = 8;  ///< 8 or 16
  int color_type = PNG_COLOR_TYPE_RGB;
  double gamma = 0;  ///< the exponent in the file; 0: sRGB
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

PngRows to_rows(const IntegerPixels& pixels) {
  PngRows rows;
  rows.width = static_cast<png_uint_32>(pixels.width);
  rows.height = static_cast<png_uint_32>(pixels.height);
  rows.bit_depth = pixels.depth;
  rows.color_type = (pixels.channels >= 3 ? PNG_COLOR_MASK_COLOR : 0) |
                    (pixels.has_alpha() ? PNG_COLOR_MASK_ALPHA : 0);
  rows.gamma = pixels.gamma;
  rows.bytes.reserve(rows.row_bytes() * rows.height);
  for (const std::uint16_t sample : pixels.samples) {
    if (rows.bit_depth == 16) rows.bytes.push_back(static_cast<png_byte>(sample >> 8));
    rows.bytes.push_back(static_cast<png_byte>(sample & 0xff));
  }
  return rows;
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

bool write_rows(png_structp png, png_infop info, std::FILE* file, const PngRows& rows,
                std::span<const png_text> texts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_IHDR(png, info, rows.width, rows.height, rows.bit_depth, rows.color_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (rows.gamma == 0)
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  else
    png_set_gAMA(png, info, rows.gamma);
  if (!texts.empty()) png_set_text(png, info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < rows.height; ++y)
    png_write_row(png, rows.bytes.data() + y * rows.row_bytes());
  png_write_end(png, nullptr);
  return true;
}

// Reading -----------------------------------------------------------------------------------------

/// Reads up to the pixels, and requests their expansion to grey or colour of 8 or 16 bits.
bool read_info(png_structp png, png_infop info, std::FILE* file, PngRows& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_init_io(png, file);
  png_set_user_limits(png, 65536, 65536);
  png_read_info(png, info);
  png_set_expand(png);
  rows.width = png_get_image_width(png, info);
  rows.height = png_get_image_height(png, info);
  int intent = 0;
  const bool says_srgb = png_get_sRGB(png, info, &intent) != 0;
  double gamma = 0;
  constexpr double kSrgbGamma = 0.45455;  // the gAMA value of sRGB files
  if (!says_srgb && png_get_gAMA(png, info, &gamma) != 0 && std::fabs(gamma - kSrgbGamma) > 1e-4)
    rows.gamma = gamma;
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  rows.bit_depth = png_get_bit_depth(png, info);
  rows.color_type = png_get_color_type(png, info);
  return true;
}

bool read_rows(png_structp png, png_infop info, PngRows& rows, png_bytepp starts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (png_uint_32 y = 0; y < rows.height; ++y)
    starts[y] = rows.bytes.data() + y * rows.row_bytes();
  png_read_image(png, starts);
  png_read_end(png, info);
  return true;
}

IntegerPixels to_pixels(const PngRows& rows) {
  IntegerPixels pixels;
  pixels.width = rows.width;
  pixels.height = rows.height;
  pixels.channels = rows.channels();
  pixels.depth = rows.bit_depth;
  pixels.gamma = rows.gamma;
  const png_byte* byte = rows.bytes.data();
  pixels.samples.resize(pixels.width * pixels.height * pixels.channels);
  for (std::uint16_t& sample : pixels.samples) {
    sample = *byte++;
    if (rows.bit_depth == 16) sample = static_cast<std::uint16_t>(256 * sample + *byte++);
  }
  return pixels;
}

/// libpng's two structures for one file, which the destructor frees.
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
  PngComplaint complaint_;
};

}  // namespace

void write_png(const std::string& path, const Image& image, const WriteOptions& options) {
  const PngRows rows = to_rows(encode_integers(path, "PNG", image, options));
  const std::vector<png_text> texts = texts_of(options);
  FileWriter file(path);
  PngHandle handle(PngHandle::Mode::write);
  if (!write_rows(handle.png, handle.info, file.handle(), rows, texts))
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
  PngRows rows;
  if (!read_info(handle.png, handle.info, file.get(), rows)) throw malformed(handle);
  require_sane_size(rows.width, rows.height, rows.channels(), path);
  require_possible_size(rows.row_bytes(), rows.height, kDeflateRatio, file_bytes, path);
  rows.bytes.resize(rows.row_bytes() * rows.height);
  std::vector<png_bytep> starts(rows.height);
  if (!read_rows(handle.png, handle.info, rows, starts.data())) throw malformed(handle);
  ImageFile read{decode_integers(to_pixels(rows)), {}};
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(handle.png, handle.info, &texts, &count);
  for (int i = 0; i < count; ++i)
    read.attributes.emplace_back(texts[i].key, texts[i].text != nullptr ? texts[i].text : "");
  return read;
}

}  // namespace hiac::image_files
