#pragma once

#include <string>
#include <vector>

#include "hiac/scene/specification.hpp"

namespace hiac::tools {

/// The text of the specification in a file, in a picture that was made by one, or of a view of
/// ParaView (read_specification).
std::string specification_text(const std::string& path);

/// The specification in a file with the overrides of the option --set, which errors name. A picture
/// (.png, .exr, .tiff) gives the specification by which it was made; one that does not hold it is
/// an InputError. A state or a camera of ParaView (.pvsm, .pvcc) gives its view.
ParsedScene read_specification(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace hiac::tools
