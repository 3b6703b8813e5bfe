#include "formats/calculix/frd.hpp"

#include <algorithm>

#include "formats/calculix/frd_file.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {

Format frd_format() {
  Format format;
  format.name = "frd";
  format.extensions = {".frd"};
  format.kinds = "tet4,10 prism6,15 brick8,20";
  format.fields = "node";
  format.time_steps = "many";
  format.recognizes = [](std::string_view head) {
    const std::string_view rest = head.substr(std::min<std::size_t>(head.size(), 6));
    return head.starts_with("    1C") && rest.find("\n    1U") != std::string_view::npos;
  };
  format.plausible = [](std::string_view head) {
    return head.starts_with("    1") || head.starts_with("    2C");
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return frd::read_frd(std::make_shared<InputText>(path));
  });
  return format;
}

}  // namespace hiac::formats
