#include "formats/medit/medit.hpp"

#include "formats/common/mesh/assemble.hpp"
#include "formats/medit/gmf_file.hpp"

namespace hiac::formats {

Format medit_format() {
  Format format;
  format.name = "medit";
  format.extensions = {".mesh", ".meshb"};
  format.kinds = "tet4,10 pyr5 prism6 wedge7 brick8";
  format.fields = "node, cell (references)";
  format.time_steps = "none";
  format.recognizes = medit::looks_like_gmf;
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return medit::read_gmf(InputText(path));
  });
  return format;
}

}  // namespace hiac::formats
