#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hiac::image_files {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// An image's attributes as the text of TIFF's tag ImageDescription: a JSON object of strings, in
/// ASCII, as that tag demands. What is not UTF-8 is replaced. Empty without attributes.
std::string to_description(const Attributes& attributes);

/// The attributes of such a text. Another program's text is one attribute, "ImageDescription".
Attributes from_description(std::string_view text);

}  // namespace hiac::image_files
