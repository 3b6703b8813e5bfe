#include "formats/medit/medit.hpp"

#include "formats/assemble.hpp"
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
  format.read = [](const std::string& path, const ReadOptions& options) {
    return assemble(medit::read_gmf(InputText(path)), options, path);
  };
  format.inspect = [](const std::string& path) {
    return inventory_of(medit::read_gmf(InputText(path)), "medit", path);
  };
  return format;
}

}  // namespace hiac::formats
