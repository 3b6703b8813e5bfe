#include "hiac/image/files/image_formats.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "hiac/base/error.hpp"

namespace hiac::image_files {

FileHandle open_image_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  // a pipe would be waited for
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path, "not a regular file (an image is read from a file, not from a pipe)");
  FileHandle file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
  return file;
}

std::uint64_t remaining_bytes(std::FILE* file, const std::string& path) {
  struct stat status {};
  if (fstat(fileno(file), &status) != 0 || !S_ISREG(status.st_mode))
    throw InputError(path, "not a regular file (an image is read from a file, not from a pipe)");
  const long here = std::ftell(file);
  return static_cast<std::uint64_t>(status.st_size) - static_cast<std::uint64_t>(here);
}

void read_exactly(std::FILE* file, std::span<std::byte> into, const std::string& path) {
  const std::size_t got = std::fread(into.data(), 1, into.size(), file);
  if (got == into.size()) return;
  if (std::ferror(file) != 0)
    throw InputError(path, fmt::format("cannot be read ({})", std::strerror(errno)));
  throw InputError(path, fmt::format("the file ends too early (expected {} more bytes, found {})",
                                     into.size(), got));
}

std::vector<std::byte> read_whole(const std::string& path) {
  const FileHandle file = open_image_file(path);
  std::vector<std::byte> bytes(remaining_bytes(file.get(), path));
  read_exactly(file.get(), bytes, path);
  return bytes;
}

FileWriter::FileWriter(const std::string& path)
    : path_(path), output_(path), file_(std::fopen(output_.temporary_path().c_str(), "wb")) {
  if (!file_) throw InputError(path_, fmt::format("cannot be written ({})", std::strerror(errno)));
}

void FileWriter::write(std::span<const std::byte> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    throw InputError(path_, fmt::format("cannot be written ({})", std::strerror(errno)));
}

void FileWriter::close() {
  const bool failed_before = std::ferror(file_.get()) != 0;
  if (std::fclose(file_.release()) != 0 || failed_before)
    throw InputError(path_, fmt::format("cannot be written ({})", std::strerror(errno)));
}

void require_sane_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                       const std::string& path) {
  constexpr std::uint64_t kMaxSide = 65536;
  constexpr std::uint64_t kMaxChannels = 1024;
  const bool sane = width > 0 && height > 0 && channels > 0 && width <= kMaxSide &&
                    height <= kMaxSide && channels <= kMaxChannels;
  if (!sane)
    throw InputError(path, fmt::format("impossible image size (expected 1 to {} pixels a side and "
                                       "1 to {} channels, found {} x {} with {} channels)",
                                       kMaxSide, kMaxChannels, width, height, channels));
}

void require_possible_size(std::uint64_t row_bytes, std::uint64_t rows, std::uint64_t ratio,
                           std::uint64_t file_bytes, const std::string& path) {
  if (row_bytes * rows / ratio > file_bytes)
    throw InputError(path, fmt::format("the file ends too early ({} bytes cannot hold {} rows of "
                                       "{} bytes)",
                                       file_bytes, rows, row_bytes));
}

std::vector<std::size_t> picked_channels(const std::string& path, const char* format,
                                         const Image& image, bool with_alpha) {
  std::vector<std::size_t> picked;
  for (const char* name : {"R", "G", "B"})
    if (const auto index = image.channel_index(name)) picked.push_back(*index);
  if (picked.empty())
    if (const auto index = image.channel_index("Y")) picked.push_back(*index);
  if (picked.size() != 1 && picked.size() != 3)
    throw UsageError(fmt::format("{}: {} needs the channels R G B or Y (found {})", path, format,
                                 fmt::join(image.channels(), " ")));
  if (const auto alpha = image.channel_index("A"); alpha && with_alpha) picked.push_back(*alpha);
  return picked;
}

std::vector<std::string> default_channel_names(std::size_t count) {
  switch (count) {
    case 1:
      return {"Y"};
    case 2:
      return {"Y", "A"};
    case 3:
      return {"R", "G", "B"};
    default:
      break;
  }
  std::vector<std::string> names = rgba_channels();
  for (std::size_t c = names.size(); c < count; ++c) names.push_back(fmt::format("channel{}", c));
  return names;
}

}  // namespace hiac::image_files
