#include "formats/ucd/ucd.hpp"

#include "formats/common/mesh/assemble.hpp"
#include "formats/ucd/ucd_file.hpp"

namespace hiac::formats {

Format ucd_format() {
  Format format;
  format.name = "ucd";
  format.extensions = {".inp", ".ucd", ".avs"};
  format.kinds = "tet4 pyr5 prism6 wedge7 brick8";
  format.fields = "node, cell";
  format.time_steps = "none";
  format.recognizes = [](std::string_view) { return false; };
  format.plausible = ucd::looks_like_ucd;
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return ucd::read_ucd(InputText(path));
  });
  return format;
}

}  // namespace hiac::formats
