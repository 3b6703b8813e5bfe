#include "tools/common/render/picture_behind.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/image/composite.hpp"
#include "hiac/image/image_io.hpp"

namespace hiac::tools {

std::optional<Image> read_picture_behind(const std::string& path, const ImageSize& size) {
  if (path.empty()) return std::nullopt;
  Image under = read_image(path, {.width = size.width}).image;
  if (under.width() != size.width || under.height() != size.height)
    throw InputError(path,
                     fmt::format("a picture of another size ({} x {} pixels expected, {} x {} "
                                 "found)",
                                 size.width, size.height, under.width(), under.height()));
  if (!color_channels(under))
    throw InputError(path, fmt::format("a picture without colour (channels {})",
                                       fmt::join(under.channels(), " ")));
  if (const auto bad = not_finite_in(under)) throw InputError(path, *bad);
  return under;
}

}  // namespace hiac::tools
