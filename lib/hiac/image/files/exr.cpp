#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/image/files/image_formats.hpp"

namespace hiac::image_files {
namespace {

/// Number of lines that are converted at a time: one block of ZIP compression.
constexpr std::size_t kBlockLines = 16;

/// OpenEXR's output through a FileWriter. Its own stream would lose errors in the last bytes, which
/// a destructor writes; here the file remembers them and FileWriter::close throws.
class ExrStream : public Imf::OStream {
 public:
  ExrStream(FileWriter& file, const std::string& path) : Imf::OStream(path.c_str()), file_(file) {}

  void write(const char bytes[], int count) override {
    file_.write(std::as_bytes(std::span(bytes, static_cast<std::size_t>(count))));
  }
  std::uint64_t tellp() override { return static_cast<std::uint64_t>(std::ftell(file_.handle())); }
  void seekp(std::uint64_t position) override {
    std::fseek(file_.handle(), static_cast<long>(position), SEEK_SET);
  }

 private:
  FileWriter& file_;
};

Imf::Header header_of(const Image& image, const WriteOptions& options) {
  Imf::Header header(static_cast<int>(image.width()), static_cast<int>(image.height()));
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& name : image.channels())
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  for (const auto& [name, text] : options.attributes)
    header.insert(name, Imf::StringAttribute(text));
  return header;
}

/// Describes interleaved floats of the lines from first_line on as OpenEXR's frame buffer.
Imf::FrameBuffer frame_buffer(std::vector<float>& lines, std::span<const std::string> channels,
                              std::size_t width, const Imath::V2i& first_pixel) {
  Imf::FrameBuffer buffer;
  const std::size_t pixel_bytes = channels.size() * sizeof(float);
  const std::size_t line_bytes = width * pixel_bytes;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    // the slice's base is the place of pixel (0, 0), which may lie outside the lines
    char* const base = reinterpret_cast<char*>(lines.data() + c) -
                       static_cast<std::ptrdiff_t>(pixel_bytes) * first_pixel.x -
                       static_cast<std::ptrdiff_t>(line_bytes) * first_pixel.y;
    buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, base, pixel_bytes, line_bytes));
  }
  return buffer;
}

void write_lines(Imf::OutputFile& file, const Image& image) {
  std::vector<float> lines(kBlockLines * image.width() * image.channel_count());
  for (std::size_t y = 0; y < image.height(); y += kBlockLines) {
    const std::size_t count = std::min(kBlockLines, image.height() - y);
    const std::size_t line_values = image.width() * image.channel_count();
    const auto source = image.values().subspan(y * line_values, count * line_values);
    std::transform(source.begin(), source.end(), lines.begin(),
                   [](double value) { return static_cast<float>(value); });
    file.setFrameBuffer(
        frame_buffer(lines, image.channels(), image.width(), {0, static_cast<int>(y)}));
    file.writePixels(static_cast<int>(count));
  }
}

// Reading -----------------------------------------------------------------------------------------

constexpr int kMaxSide = 65536;
constexpr int kMaxTileSide = 4096;

/// Reads a zero-terminated text of at most 255 characters.
std::string read_name(std::FILE* file, const std::string& path) {
  std::string name;
  for (char c = 0; name.size() < 256; name += c) {
    read_exactly(file, std::as_writable_bytes(std::span(&c, 1)), path);
    if (c == 0) return name;
  }
  throw InputError(path, "malformed OpenEXR header (a name longer than 255 characters)");
}

/// Walks through the headers' attributes, because OpenEXR allocates the memory that an attribute
/// announces before reading it. Returns the file's length.
std::uint64_t require_sane_headers(const std::string& path) {
  const FileHandle file = open_image_file(path);
  const std::uint64_t file_bytes = remaining_bytes(file.get(), path);
  std::array<std::uint32_t, 2> start{};  // magic number, version with flags
  read_exactly(file.get(), std::as_writable_bytes(std::span(start)), path);
  if (start[0] != 20000630) throw InputError(path, "not an OpenEXR file (wrong magic number)");
  const bool several_parts = (start[1] & 0x1000) != 0;
  while (true) {
    bool is_empty = true;
    while (!read_name(file.get(), path).empty()) {
      is_empty = false;
      read_name(file.get(), path);  // the attribute's type
      std::uint32_t size = 0;
      read_exactly(file.get(), std::as_writable_bytes(std::span(&size, 1)), path);
      if (size > remaining_bytes(file.get(), path))
        throw InputError(path, fmt::format("malformed OpenEXR header (an attribute of {} bytes, "
                                           "more than the file has)",
                                           size));
      std::fseek(file.get(), static_cast<long>(size), SEEK_CUR);
    }
    if (is_empty || !several_parts) return file_bytes;
  }
}

/// Returns R G B A first, then the others in the file's (sorted) order.
std::vector<std::string> channel_names(const Imf::ChannelList& channels) {
  std::vector<std::string> names;
  for (const std::string& name : rgba_channels())
    if (channels.findChannel(name) != nullptr) names.push_back(name);
  const auto first = static_cast<std::ptrdiff_t>(names.size());
  for (auto channel = channels.begin(); channel != channels.end(); ++channel)
    if (std::find(names.begin(), names.begin() + first, channel.name()) == names.begin() + first)
      names.emplace_back(channel.name());
  return names;
}

/// Memory grows as lines are decoded: a header that announces too much costs nothing.
Image read_lines(Imf::InputFile& file, std::uint64_t file_bytes, const std::string& path) {
  const Imath::Box2i window = file.header().dataWindow();
  const auto width = std::int64_t{window.max.x} - window.min.x + 1;
  const auto height = std::int64_t{window.max.y} - window.min.y + 1;
  const std::vector<std::string> names = channel_names(file.header().channels());
  require_sane_size(width < 0 ? 0 : static_cast<std::uint64_t>(width),
                    height < 0 ? 0 : static_cast<std::uint64_t>(height), names.size(), path);
  const auto columns = static_cast<std::size_t>(width);
  const std::uint64_t block_bytes = kBlockLines * columns * names.size() * sizeof(float);
  if (block_bytes > kHarmlessBytes && block_bytes / kDeflateRatio > file_bytes)
    throw InputError(path, fmt::format("{} bytes cannot hold lines of {} pixels with {} channels",
                                       file_bytes, columns, names.size()));
  std::vector<float> lines(kBlockLines * columns * names.size());
  std::vector<double> values;
  for (std::int64_t y = 0; y < height; y += static_cast<std::int64_t>(kBlockLines)) {
    const auto count = std::min(static_cast<std::int64_t>(kBlockLines), height - y);
    const int first = static_cast<int>(window.min.y + y);
    file.setFrameBuffer(frame_buffer(lines, names, columns, {window.min.x, first}));
    file.readPixels(first, static_cast<int>(first + count - 1));
    const auto end = lines.begin() + count * width * static_cast<std::int64_t>(names.size());
    values.insert(values.end(), lines.begin(), end);
  }
  return {columns, static_cast<std::size_t>(height), names, std::move(values)};
}

}  // namespace

void write_exr(const std::string& path, const Image& image, const WriteOptions& options) {
  FileWriter writer(path);
  try {
    ExrStream stream(writer, path);
    Imf::OutputFile file(stream, header_of(image, options));
    write_lines(file, image);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path, fmt::format("cannot be written ({})", error.what()));
  }
  writer.close();
  writer.commit();
}

ImageFile read_exr(const std::string& path) {
  const std::uint64_t file_bytes = require_sane_headers(path);
  Imf::Header::setMaxImageSize(kMaxSide, kMaxSide);
  Imf::Header::setMaxTileSize(kMaxTileSide, kMaxTileSide);
  try {
    Imf::InputFile file(path.c_str());
    ImageFile read{read_lines(file, file_bytes, path), {}};
    for (auto attribute = file.header().begin(); attribute != file.header().end(); ++attribute)
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
        read.attributes.emplace_back(attribute.name(), text->value());
    return read;
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path, fmt::format("not a readable OpenEXR file ({})", error.what()));
  }
}

}  // namespace hiac::image_files
