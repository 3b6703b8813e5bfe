#include "hiac/image/files/isolated_image.hpp"

#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hiac/base/process/isolated_process.hpp"
#include "hiac/base/process/pack.hpp"

namespace hiac::image_files {
namespace {

void pack_image(PackWriter& out, ImageFile file) {
  Image& image = file.image;
  out.number(image.width());
  out.number(image.height());
  out.number(image.channel_count());
  for (const std::string& channel : image.channels()) out.text(channel);
  out.number(file.attributes.size());
  for (const auto& [name, value] : file.attributes) {
    out.text(name);
    out.text(value);
  }
  out.consume_block(image.values().data(), image.values().size_bytes());
}

ImageFile unpack_image(PackReader& in) {
  constexpr std::uint64_t kMostSide = std::uint64_t{1} << 17;
  const std::uint64_t width = in.number_below(kMostSide);
  const std::uint64_t height = in.number_below(kMostSide);
  std::vector<std::string> channels(in.count());
  for (std::string& channel : channels) channel = in.text();
  std::vector<std::pair<std::string, std::string>> attributes(in.count());
  for (auto& [name, value] : attributes) {
    name = in.text();
    value = in.text();
  }
  const std::span<const char> bytes = in.block();
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  try {
    return {Image(width, height, std::move(channels), std::move(values)), std::move(attributes)};
  } catch (const std::invalid_argument&) {
    in.fail();
  }
}

}  // namespace

ImageFile read_isolated_image(const std::string& path, const std::string& library,
                              const std::function<ImageFile()>& read) {
  IsolatedProcess process(library, [&](const std::string&, const std::string&, PackWriter& out) {
    pack_image(out, read());
  });
  const PackedAnswer answer = process.answer(path, "");
  PackReader in(answer.bytes(), path);
  return unpack_image(in);
}

}  // namespace hiac::image_files
