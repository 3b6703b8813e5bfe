#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hiac/base/output_file.hpp"
#include "hiac/image/image.hpp"
#include "hiac/image/image_io.hpp"

namespace hiac::image_files {

static_assert(std::endian::native == std::endian::little, "files are written as memory has them");

// One writer and one reader per format, which write_image and read_image call ---------------------

void write_npy(const std::string& path, const Image& image);
Image read_npy(const std::string& path);

/// BASE.f32 and channel R: BASE.r.f32
std::string f32_channel_path(const std::string& path, std::string channel);
void write_f32(const std::string& path, const Image& image);
Image read_f32(const std::string& path, std::size_t width);

void write_exr(const std::string& path, const Image& image, const WriteOptions& options);
ImageFile read_exr(const std::string& path);

void write_png(const std::string& path, const Image& image, const WriteOptions& options);
ImageFile read_png(const std::string& path);

void write_sgi(const std::string& path, const Image& image, const WriteOptions& options);
Image read_sgi(const std::string& path, bool linear);

void write_tiff(const std::string& path, const Image& image, const WriteOptions& options);
ImageFile read_tiff(const std::string& path, bool linear);

void write_pfm(const std::string& path, const Image& image);
Image read_pfm(const std::string& path);

void write_hdr(const std::string& path, const Image& image);
Image read_hdr(const std::string& path);

// Shared helpers --------------------------------------------------------------------------------

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

/// Opens a file for reading. Throws InputError with its name.
FileHandle open_image_file(const std::string& path);

/// Returns the number of bytes from the current position to the end of a seekable file; throws
/// InputError for other files.
std::uint64_t remaining_bytes(std::FILE* file, const std::string& path);

/// Reads exactly `into.size()` bytes; throws InputError if the file ends before.
void read_exactly(std::FILE* file, std::span<std::byte> into, const std::string& path);

/// Returns all bytes of a file; throws InputError with its name.
std::vector<std::byte> read_whole(const std::string& path);

/// A file that is written under a temporary name; every member throws InputError with its name.
class FileWriter {
 public:
  explicit FileWriter(const std::string& path);
  void write(std::span<const std::byte> bytes);
  [[nodiscard]] std::FILE* handle() { return file_.get(); }
  /// Flushes and closes the file; afterwards lack of space can cause no more errors.
  void close();
  /// Throws InputError: what a library tells, or what the system does (OutputFile::fail).
  [[noreturn]] void fail(const std::string& otherwise) const { output_.fail(otherwise); }
  /// Gives the closed file its name.
  void commit() { output_.commit(); }

 private:
  std::string path_;
  OutputFile output_;
  FileHandle file_;
};

/// Throws InputError unless the width, height and number of channels that a file announces are
/// positive and their product is within this library's limits.
void require_sane_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                       const std::string& path);

/// A reader may allocate this many bytes, however short the file is.
inline constexpr std::uint64_t kHarmlessBytes = std::uint64_t{64} << 20;

/// Deflate compresses at most by this factor.
inline constexpr std::uint64_t kDeflateRatio = 1032;

/// Throws InputError if rows of that many bytes, compressed at most by the factor `ratio`, do not
/// fit into a file of that length: the file is truncated.
void require_possible_size(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t ratio,
                           std::uint64_t file_bytes, const std::string& path);

/// Returns the image's channels that a grey or colour format stores: R G B, or else Y; then A if
/// the image has it and `with_alpha` is set. Throws UsageError, with the path and the format, if
/// the image has neither.
std::vector<std::size_t> picked_channels(const std::string& path, const char* format,
                                         const Image& image, bool with_alpha);

/// Returns names for unnamed channels: Y; Y A; R G B; R G B A; then "channel4" and so on.
std::vector<std::string> default_channel_names(std::size_t count);

}  // namespace hiac::image_files
