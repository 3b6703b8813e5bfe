#include "formats/unv/unv.hpp"

#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/unv/unv_file.hpp"

namespace hiac::formats {

Format unv_format() {
  Format format;
  format.name = "unv";
  format.extensions = {".unv"};
  format.kinds = "tet4,10 prism6,15 wedge7 brick8,20";
  format.fields = "node, cell, corner";
  format.time_steps = "many";
  format.recognizes = [](std::string_view head) {
    TextCursor cursor(head, "");
    while (!cursor.at_end()) {
      const std::string_view line = cursor.line();
      if (trimmed(line).empty()) continue;
      return line.starts_with("    -1") && trimmed(line) == "-1" &&
             to_integer(cursor.line()).has_value();
    }
    return false;
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return unv::read_unv(std::make_shared<InputText>(path));
  });
  return format;
}

}  // namespace hiac::formats
