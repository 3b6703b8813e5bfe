#include "formats/tecplot/zone_header.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

namespace hiac::formats::tecplot {
namespace {

/// F or DATAPACKING as written.
std::string written_packing(const ZoneHeader& header) {
  std::string packing = "POINT";
  if (const std::string* f = header.value("F")) packing = upper(*f);
  if (const std::string* f = header.value("DATAPACKING")) packing = upper(*f);
  return packing;
}

/// ([4-5]=CELLCENTERED, [1]=NODAL) or (NODAL, NODAL, CELLCENTERED).
void set_locations(std::string_view text, Zone& zone) {
  if (text.find('[') == std::string_view::npos) {
    std::size_t variable = 0;
    for (std::size_t at = 0; at < text.size() && variable < zone.cell_centered.size(); ++variable) {
      const std::size_t comma = std::min(text.find(',', at), text.size());
      zone.cell_centered[variable] =
          upper(text.substr(at, comma - at)).find("CELLCENTERED") != std::string::npos;
      at = comma + 1;
    }
    return;
  }
  for (std::size_t at = text.find('['); at != std::string_view::npos; at = text.find('[', at + 1)) {
    const std::size_t end = std::min(text.find(']', at), text.size());
    const std::string_view rest =
        text.substr(end, std::min(text.find('[', end), text.size()) - end);
    if (upper(rest).find("CELLCENTERED") == std::string::npos) continue;
    for (const std::size_t variable : number_list(text.substr(at, end - at)))
      if (variable < zone.cell_centered.size()) zone.cell_centered[variable] = true;
  }
}

}  // namespace

ZoneHeader::ZoneHeader(TextCursor& cursor, Tokens& tokens)
    : cursor_(cursor), start_(cursor.offset()) {
  read(tokens, cursor);
}

void ZoneHeader::read(Tokens& tokens, TextCursor& cursor) {
  while (tokens.skip()) {
    const char c = tokens.front();
    if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.') break;
    const std::size_t start = cursor.offset();
    const std::string name = upper(tokens.next());
    // these words are values too, and begin the data
    const bool is_value = name == "NAN" || name == "INF" || name == "INFINITY";
    if (is_value || name == "ZONE") {
      cursor.move_to(start);
      break;
    }
    if (name == "AUXDATA") {
      cursor.line();
      continue;
    }
    if (!tokens.take('='))
      cursor.fail_at(
          start, fmt::format("NAME=VALUE of a zone or numbers expected ({} found)", shown(name)));
    if (!tokens.skip()) cursor.fail_at(start, "a value expected (the file ends)");
    pairs_[name] = tokens.next();
  }
}

const std::string* ZoneHeader::value(const std::string& name) const {
  const auto found = pairs_.find(name);
  return found == pairs_.end() ? nullptr : &found->second;
}

std::size_t ZoneHeader::count(const std::string& name, const std::string& other,
                              std::size_t otherwise) const {
  const std::string* found = value(name);
  if (found == nullptr) found = value(other);
  if (found == nullptr) return otherwise;
  const auto count = to_integer(*found);
  if (!count || *count < 0 || static_cast<std::uint64_t>(*count) > cursor_.text().size())
    fail(fmt::format("a count expected ({} found)", shown(*found)));
  return static_cast<std::size_t>(*count);
}

void ZoneHeader::fail(const std::string& problem) const { cursor_.fail_at(start_, problem); }

std::string ZoneHeader::packing() const {
  const std::string packing = written_packing(*this);
  return packing.starts_with("FE") ? packing.substr(2) : packing;
}

Zone ZoneHeader::zone(std::size_t variables) const {
  Zone zone;
  set_element(zone);
  if (const std::string* name = value("T")) zone.name = *name;
  if (const std::string* time = value("SOLUTIONTIME")) zone.time = to_real(*time);
  set_sizes(zone);
  zone.cell_centered.assign(variables, false);
  if (const std::string* places = value("VARLOCATION")) set_locations(*places, zone);
  zone.values.resize(variables);
  return zone;
}

void ZoneHeader::set_element(Zone& zone) const {
  zone.ordered = !written_packing(*this).starts_with("FE");
  if (const std::string packed = packing(); packed != "POINT" && packed != "BLOCK")
    fail(fmt::format("POINT or BLOCK packing expected ({} found)", shown(packed)));
  if (const std::string* et = value("ET")) zone.element = upper(*et);
  if (const std::string* type = value("ZONETYPE")) {
    const std::string name = upper(*type);
    zone.ordered = name == "ORDERED";
    if (name.starts_with("FE")) zone.element = name.substr(2);
  }
  if (!zone.element.empty()) zone.ordered = false;
}

void ZoneHeader::set_sizes(Zone& zone) const {
  if (zone.ordered) return set_grid_sizes(zone);
  zone.nodes = count("N", "NODES", 0);
  zone.elements = count("E", "ELEMENTS", 0);
  static const std::map<std::string, std::size_t> kNodes{{"BRICK", 8},         {"TETRAHEDRON", 4},
                                                         {"QUADRILATERAL", 4}, {"TRIANGLE", 3},
                                                         {"LINESEG", 2},       {"LINE", 2}};
  if (zone.has_faces()) return;
  const auto nodes = kNodes.find(zone.element);
  if (nodes == kNodes.end())
    fail(
        fmt::format("element type {} is not supported (BRICK, TETRAHEDRON, QUADRILATERAL, "
                    "TRIANGLE, LINESEG, POLYGON or POLYHEDRON expected)",
                    shown(zone.element)));
  zone.nodes_per_element = nodes->second;
}

void ZoneHeader::set_grid_sizes(Zone& zone) const {
  zone.dimensions = {count("I", "IMAX", 1), count("J", "JMAX", 1), count("K", "KMAX", 1)};
  const std::size_t limit = cursor_.text().size();
  zone.nodes = 1;
  zone.elements = 1;
  for (const std::size_t n : zone.dimensions) {
    if (n == 0 || zone.nodes > limit / n)
      fail("a zone's size is impossible or more than the file can hold");
    zone.nodes *= n;
    zone.elements *= n > 1 ? n - 1 : 1;
  }
}

}  // namespace hiac::formats::tecplot
