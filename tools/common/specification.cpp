#include "tools/common/specification.hpp"

#include "tools/common/as_option.hpp"

namespace hiac::tools {

ParsedScene read_specification(const std::string& path, const std::vector<std::string>& overrides) {
  return as_option("--set ", [&] { return read_scene(path, overrides); });
}

}  // namespace hiac::tools
