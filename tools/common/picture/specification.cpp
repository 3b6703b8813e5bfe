#include "tools/common/picture/specification.hpp"

#include <algorithm>
#include <filesystem>

#include "hiac/base/error.hpp"
#include "hiac/image/image_io.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/toml/spec_text.hpp"
#include "tools/common/as_option.hpp"

namespace hiac::tools {
namespace {

/// The specification that a picture was made by, which its writer left in it.
std::string specification_in(const std::string& picture) {
  constexpr std::string_view kWidthUnknown =
      ".f32";  // holds no texts, and cannot be read by itself
  if (!picture.ends_with(kWidthUnknown)) {
    const ImageFile file = read_image(picture);
    const auto found = std::ranges::find(file.attributes, "hiac:specification",
                                         &std::pair<std::string, std::string>::first);
    if (found != file.attributes.end()) return found->second;
  }
  throw InputError(picture,
                   "is a picture that does not hold its specification (one in .png, .exr or .tiff "
                   "by hiac-render or hiac-preview expected, or a TOML file)");
}

}  // namespace

std::string specification_text(const std::string& path) {
  if (is_paraview_file(path)) return view_from_state(path).text;
  return has_image_extension(path) ? specification_in(path) : read_text_file(path);
}

ParsedScene read_specification(const std::string& path, const std::vector<std::string>& overrides) {
  return as_option("--set ", [&] {
    if (!has_image_extension(path) && !is_paraview_file(path)) return read_scene(path, overrides);
    return parse_scene(specification_text(path), path,
                       std::filesystem::path(path).parent_path().string(), overrides);
  });
}

}  // namespace hiac::tools
