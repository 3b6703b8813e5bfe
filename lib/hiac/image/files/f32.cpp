#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"

namespace hiac::image_files {
namespace {

std::vector<float> read_plane(const std::string& path) {
  const FileHandle file = open_image_file(path);
  const std::uint64_t bytes = remaining_bytes(file.get(), path);
  if (bytes == 0 || bytes % sizeof(float) != 0)
    throw InputError(path, fmt::format("wrong length (expected a multiple of {} bytes, found {})",
                                       sizeof(float), bytes));
  std::vector<float> plane(bytes / sizeof(float));
  read_exactly(file.get(), std::as_writable_bytes(std::span(plane)), path);
  return plane;
}

}  // namespace

std::string f32_channel_path(const std::string& path, std::string channel) {
  std::transform(channel.begin(), channel.end(), channel.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::filesystem::path base = std::filesystem::path(path).replace_extension();
  return fmt::format("{}.{}.f32", base.string(), channel);
}

void write_f32(const std::string& path, const Image& image) {
  std::vector<std::unique_ptr<FileWriter>> files;
  std::vector<float> row(image.width());
  for (std::size_t c = 0; c < image.channel_count(); ++c) {
    FileWriter& file = *files.emplace_back(
        std::make_unique<FileWriter>(f32_channel_path(path, image.channels()[c])));
    for (std::size_t y = 0; y < image.height(); ++y) {
      for (std::size_t x = 0; x < image.width(); ++x)
        row[x] = static_cast<float>(image.at(x, y, c));
      file.write(std::as_bytes(std::span(row)));
    }
    file.close();
  }
  for (const auto& file : files) file->commit();
}

Image read_f32(const std::string& path, std::size_t width) {
  if (width == 0)
    throw UsageError(path + ": raw files do not hold their size (expected the image's width)");
  std::vector<std::string> names;
  std::vector<std::vector<float>> planes;
  for (const std::string& name : rgba_channels()) {
    const std::string plane_path = f32_channel_path(path, name);
    if (!std::filesystem::exists(plane_path)) continue;
    names.push_back(name);
    planes.push_back(read_plane(plane_path));
    if (planes.back().size() != planes.front().size() || planes.back().size() % width != 0)
      throw InputError(plane_path, fmt::format("wrong length (expected rows of {} values, as many "
                                               "as in the other channels, found {} values)",
                                               width, planes.back().size()));
  }
  if (planes.empty())
    throw InputError(
        path, fmt::format("cannot be opened (expected {} and so on)", f32_channel_path(path, "r")));
  const std::size_t height = planes.front().size() / width;
  require_sane_size(width, height, planes.size(), path);
  Image image(width, height, names);
  for (std::size_t c = 0; c < planes.size(); ++c)
    for (std::size_t i = 0; i < planes[c].size(); ++i)
      image.values()[i * planes.size() + c] = static_cast<double>(planes[c][i]);
  return image;
}

}  // namespace hiac::image_files
