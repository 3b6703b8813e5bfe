#include "formats/abaqus/abaqus.hpp"

#include <cctype>

#include "formats/abaqus/inp_parser.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats {
namespace {

/// Whether the first line that is not a comment is a keyword of an Abaqus deck (and not one of
/// LS-DYNA).
bool begins_with_keyword(std::string_view head) {
  TextCursor cursor(head, "");
  while (!cursor.at_end()) {
    const std::string_view line = trimmed(cursor.line());
    if (line.empty() || line.starts_with("**")) continue;
    return line.size() > 1 && line.front() == '*' &&
           std::isalpha(static_cast<unsigned char>(line[1])) != 0 &&
           !starts_with_upper(line, "*KEYWORD");
  }
  return false;
}

ForeignMesh read_abaqus_file(const std::string& path) {
  return abaqus::mesh_of(abaqus::parse_deck(path), path);
}

}  // namespace

Format abaqus_format() {
  Format format;
  format.name = "abaqus";
  format.extensions = {".inp"};
  format.kinds = "tet4,10 pyr5 prism6,15 wedge7,18 brick8,20";
  format.fields = "none";
  format.time_steps = "none";
  format.recognizes = begins_with_keyword;
  format.plausible = [](std::string_view head) { return head.starts_with("**"); };
  format.gzip = true;
  read_through(format,
               [](const std::string& path, const ReadOptions&) { return read_abaqus_file(path); });
  return format;
}

}  // namespace hiac::formats
