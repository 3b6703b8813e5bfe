#include "formats/ansys/ansys.hpp"

#include "formats/ansys/cdb_file.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

bool has_archive_line(std::string_view head) {
  TextCursor cursor(head, "");
  while (!cursor.at_end()) {
    const std::string_view line = cursor.line();
    for (const std::string_view start : {"/PREP7", "/COM,ANSYS", "NBLOCK,", "/BATCH", "ET,"})
      if (starts_with_upper(line, start)) return true;
  }
  return false;
}

}  // namespace

Format ansys_format() {
  Format format;
  format.name = "ansys";
  format.extensions = {".cdb"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20";
  format.fields = "none";
  format.time_steps = "none";
  format.recognizes = has_archive_line;
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return ansys::read_cdb(InputText(path));
  });
  return format;
}

}  // namespace hiac::formats
