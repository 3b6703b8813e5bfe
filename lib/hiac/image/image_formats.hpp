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

// One writer and one reader a format (write_image and read_image dispatch).
// ------------------------

void write_npy(const std::string& path, const Image& image);
Image read_npy(const std::string& path);

void write_f32(const std::string& path, const Image& image);
Image read_f32(const std::string& path, std::size_t width);

void write_exr(const std::string& path, const Image& image, const WriteOptions& options);
ImageFile read_exr(const std::string& path);

void write_png(const std::string& path, const Image& image, const WriteOptions& options);
ImageFile read_png(const std::string& path);

// What they share. --------------------------------------------------------------------------------

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

/// Opens a file to read. Throws InputError naming it.
FileHandle open_image_file(const std::string& path);

/// Bytes from the current position to the end of a file that can seek; throws InputError for
/// others.
std::uint64_t remaining_bytes(std::FILE* file, const std::string& path);

/// Reads exactly `into.size()` bytes; throws InputError when the file ends before.
void read_exactly(std::FILE* file, std::span<std::byte> into, const std::string& path);

/// A file being written under a temporary name; every member throws InputError naming the file.
class FileWriter {
 public:
  explicit FileWriter(const std::string& path);
  void write(std::span<const std::byte> bytes);
  [[nodiscard]] std::FILE* handle() { return file_.get(); }
  /// Flushes and closes: whatever can fail for want of room has then been done.
  void close();
  /// Gives the closed file its name.
  void commit() { output_.commit(); }

 private:
  std::string path_;
  OutputFile output_;
  FileHandle file_;
};

/// Width, height and number of channels that a file announces, each positive and together within
/// what an image of this library may hold; throws InputError otherwise.
void require_sane_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                       const std::string& path);

/// Names for channels that come without: Y; Y A; R G B; R G B A; then "channel4" and so on.
std::vector<std::string> default_channel_names(std::size_t count);

}  // namespace hiac::image_files
