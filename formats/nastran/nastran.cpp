#include "formats/nastran/nastran.hpp"

#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/nastran/bulk_data.hpp"

namespace hiac::formats {
namespace {

/// Whether one of the lines begins a section or a grid point of a deck.
bool has_deck_line(std::string_view head) {
  TextCursor cursor(head, "");
  while (!cursor.at_end()) {
    const std::string_view line = cursor.line();
    if (starts_with_upper(line, "BEGIN") && upper(line).find("BULK") != std::string::npos)
      return true;
    if (starts_with_upper(line, "CEND") && trimmed(line).size() == 4) return true;
    for (const std::string_view start : {"GRID    ", "GRID,", "GRID*"})
      if (starts_with_upper(line, start)) return true;
  }
  return false;
}

/// Whether the first line is a comment or a statement of the sections before the bulk data. Those
/// sections may be longer than the bytes that are examined.
bool begins_deck(std::string_view head) {
  TextCursor cursor(head, "");
  cursor.skip_space();
  const std::string_view line = cursor.line();
  if (line.starts_with('$')) return true;
  for (const std::string_view word : {"SOL", "ID", "INCLUDE", "TITLE", "SUBTITLE", "NASTRAN",
                                      "ASSIGN", "INIT", "TIME", "DIAG", "ECHO"})
    if (starts_with_upper(line, word) &&
        (line.size() == word.size() || line.find_first_of(" =,(", word.size()) == word.size()))
      return true;
  return false;
}

}  // namespace

Format nastran_format() {
  Format format;
  format.name = "nastran";
  format.extensions = {".bdf", ".nas", ".fem", ".dat", ".blk", ".bulk"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 wedge7,18 brick8,20";
  format.fields = "none";
  format.time_steps = "none";
  format.recognizes = has_deck_line;
  format.plausible = begins_deck;
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions&) {
    return nastran::read_bulk_data(path);
  });
  return format;
}

}  // namespace hiac::formats
