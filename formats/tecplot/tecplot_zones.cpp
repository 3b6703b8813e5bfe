#include "formats/tecplot/tecplot_zones.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/text_cursor.hpp"
#include "formats/tecplot/tecplot_tokens.hpp"

namespace hiac::formats::tecplot {
namespace {

class Reader {
 public:
  explicit Reader(const InputText& text) : cursor_(text.text(), text.path()), tokens_(cursor_) {}

  TecplotFile run() {
    while (tokens_.skip()) {
      const std::size_t start = cursor_.offset();
      const std::string keyword = upper(tokens_.next());
      if (keyword == "TITLE") {
        read_title();
      } else if (keyword == "VARIABLES") {
        read_variables(start);
      } else if (keyword == "ZONE") {
        read_zone();
      } else if (keyword == "FILETYPE" || keyword == "DATASETAUXDATA" || keyword == "VARAUXDATA") {
        cursor_.line();
      } else if (keyword == "TEXT" || keyword == "GEOMETRY" || keyword == "CUSTOMLABELS") {
        file_.notes.push_back(fmt::format("left out a record {}", keyword));
        skip_record();
      } else {
        cursor_.fail_at(
            start, fmt::format("TITLE, VARIABLES or ZONE expected ({} found)", shown(keyword)));
      }
    }
    if (file_.zones.empty()) cursor_.fail("no ZONE found");
    return std::move(file_);
  }

 private:
  /// A quoted text, or the rest of the line.
  void read_title() {
    tokens_.take('=');
    const std::string_view rest = trimmed(cursor_.peek_line());
    if (!rest.starts_with('"') && !rest.starts_with('\''))
      file_.title = trimmed(cursor_.line());
    else if (tokens_.skip())
      file_.title = tokens_.next();
  }

  void skip_record() {
    while (!cursor_.at_end()) {
      const std::string_view line = trimmed(cursor_.peek_line());
      if (starts_with_upper(line, "ZONE") || starts_with_upper(line, "TEXT") ||
          starts_with_upper(line, "GEOMETRY"))
        return;
      cursor_.line();
    }
  }

  /// Quoted names or words, up to the next keyword. Files joined end to end repeat them.
  void read_variables(std::size_t record) {
    std::vector<std::string> names = variable_names();
    if (file_.zones.empty())
      file_.variables.insert(file_.variables.end(), std::make_move_iterator(names.begin()),
                             std::make_move_iterator(names.end()));
    else if (names != file_.variables)
      cursor_.fail_at(
          record,
          fmt::format("the VARIABLES of the zones before expected ({} names found)", names.size()));
  }

  std::vector<std::string> variable_names() {
    std::vector<std::string> names;
    tokens_.take('=');
    while (tokens_.skip()) {
      const std::size_t start = cursor_.offset();
      const bool is_text = tokens_.front() == '"' || tokens_.front() == '\'';
      std::string name = tokens_.next();
      const std::string word = upper(name);
      if (!is_text && (word == "ZONE" || word == "TITLE" || word == "TEXT" ||
                       word == "DATASETAUXDATA" || word == "VARAUXDATA" || word == "FILETYPE")) {
        cursor_.move_to(start);
        break;
      }
      names.push_back(std::move(name));
    }
    return names;
  }

  std::size_t count_of(const std::string& value, std::size_t start) const {
    const auto count = to_integer(value);
    if (!count || *count < 0 || static_cast<std::uint64_t>(*count) > cursor_.text().size())
      cursor_.fail_at(start, fmt::format("a count expected ({} found)", shown(value)));
    return static_cast<std::size_t>(*count);
  }

  using Header = std::map<std::string, std::string>;

  /// NAME=VALUE pairs up to the first number, which begins the data.
  Header read_header() {
    Header header;
    while (tokens_.skip()) {
      const char c = tokens_.front();
      if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.')
        break;
      const std::size_t start = cursor_.offset();
      const std::string name = upper(tokens_.next());
      // these words are values too, and begin the data
      if (name == "NAN" || name == "INF" || name == "INFINITY") {
        cursor_.move_to(start);
        break;
      }
      if (name == "ZONE") {
        cursor_.move_to(start);
        break;
      }
      if (name == "AUXDATA") {
        cursor_.line();
        continue;
      }
      if (!tokens_.take('='))
        cursor_.fail_at(
            start, fmt::format("NAME=VALUE of a zone or numbers expected ({} found)", shown(name)));
      if (!tokens_.skip()) cursor_.fail_at(start, "a value expected (the file ends)");
      header[name] = tokens_.next();
    }
    return header;
  }

  static const std::string* value(const Header& header, const std::string& name) {
    const auto found = header.find(name);
    return found == header.end() ? nullptr : &found->second;
  }

  void read_zone() {
    const std::size_t start = cursor_.offset();
    const Header header = read_header();
    Zone zone;
    bool block = false;
    set_layout(header, start, zone, block);
    if (const std::string* name = value(header, "T")) zone.name = *name;
    if (const std::string* time = value(header, "SOLUTIONTIME")) zone.time = to_real(*time);
    set_sizes(header, start, zone);
    zone.cell_centered.assign(file_.variables.size(), false);
    if (const std::string* places = value(header, "VARLOCATION")) set_locations(*places, zone);
    zone.values.resize(file_.variables.size());
    const std::set<std::size_t> given = share(header, start, zone);
    if (block)
      read_block(zone, given);
    else
      read_points(zone, given);
    read_connectivity(header, start, zone);
    file_.zones.push_back(std::move(zone));
  }

  void set_layout(const Header& header, std::size_t start, Zone& zone, bool& block) const {
    std::string packing = "POINT";
    if (const std::string* f = value(header, "F")) packing = upper(*f);
    if (const std::string* f = value(header, "DATAPACKING")) packing = upper(*f);
    zone.ordered = !packing.starts_with("FE");
    if (packing.starts_with("FE")) packing = packing.substr(2);
    if (packing != "POINT" && packing != "BLOCK")
      cursor_.fail_at(start,
                      fmt::format("POINT or BLOCK packing expected ({} found)", shown(packing)));
    block = packing == "BLOCK";
    if (const std::string* et = value(header, "ET")) zone.element = upper(*et);
    if (const std::string* type = value(header, "ZONETYPE")) {
      const std::string name = upper(*type);
      zone.ordered = name == "ORDERED";
      if (name.starts_with("FE")) zone.element = name.substr(2);
    }
    if (!zone.element.empty()) zone.ordered = false;
  }

  void set_sizes(const Header& header, std::size_t start, Zone& zone) const {
    const auto size = [&](const char* name, const char* other, std::size_t otherwise) {
      const std::string* found = value(header, name);
      if (found == nullptr) found = value(header, other);
      return found == nullptr ? otherwise : count_of(*found, start);
    };
    if (zone.ordered) {
      zone.dimensions = {size("I", "IMAX", 1), size("J", "JMAX", 1), size("K", "KMAX", 1)};
      const std::size_t limit = cursor_.text().size();
      zone.nodes = 1;
      zone.elements = 1;
      for (const std::size_t n : zone.dimensions) {
        if (n == 0 || zone.nodes > limit / n)
          cursor_.fail_at(start, "a zone's size is impossible or more than the file can hold");
        zone.nodes *= n;
        zone.elements *= n > 1 ? n - 1 : 1;
      }
      return;
    }
    zone.nodes = size("N", "NODES", 0);
    zone.elements = size("E", "ELEMENTS", 0);
    static const std::map<std::string, std::size_t> kNodes{{"BRICK", 8},         {"TETRAHEDRON", 4},
                                                           {"QUADRILATERAL", 4}, {"TRIANGLE", 3},
                                                           {"LINESEG", 2},       {"LINE", 2}};
    if (has_faces(zone)) return;
    const auto nodes = kNodes.find(zone.element);
    if (nodes == kNodes.end())
      cursor_.fail_at(start, fmt::format("element type {} is not supported (BRICK, TETRAHEDRON, "
                                         "QUADRILATERAL, TRIANGLE, LINESEG, POLYGON or POLYHEDRON "
                                         "expected)",
                                         shown(zone.element)));
    zone.nodes_per_element = nodes->second;
  }

  static bool has_faces(const Zone& zone) {
    return zone.element == "POLYHEDRON" || zone.element == "POLYGON";
  }

  /// ([4-5]=CELLCENTERED, [1]=NODAL) or (NODAL, NODAL, CELLCENTERED).
  static void set_locations(std::string_view text, Zone& zone) {
    if (text.find('[') == std::string_view::npos) {
      std::size_t variable = 0;
      for (std::size_t at = 0; at < text.size() && variable < zone.cell_centered.size();
           ++variable) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        zone.cell_centered[variable] =
            upper(text.substr(at, comma - at)).find("CELLCENTERED") != std::string::npos;
        at = comma + 1;
      }
      return;
    }
    for (std::size_t at = text.find('['); at != std::string_view::npos;
         at = text.find('[', at + 1)) {
      const std::size_t end = std::min(text.find(']', at), text.size());
      const std::string_view rest =
          text.substr(end, std::min(text.find('[', end), text.size()) - end);
      if (upper(rest).find("CELLCENTERED") == std::string::npos) continue;
      for (const std::size_t variable : number_list(text.substr(at, end - at)))
        if (variable < zone.cell_centered.size()) zone.cell_centered[variable] = true;
    }
  }

  /// Takes shared variables from earlier zones; returns the variables that the zone does not store
  /// itself.
  std::set<std::size_t> share(const Header& header, std::size_t start, Zone& zone) const {
    std::set<std::size_t> given;
    if (const std::string* passive = value(header, "PASSIVEVARLIST")) {
      for (const std::size_t variable : number_list(*passive)) {
        if (variable >= zone.values.size()) continue;
        zone.values[variable].assign(tuples(zone, variable),
                                     std::numeric_limits<double>::quiet_NaN());
        given.insert(variable);
      }
    }
    duplicate(header, start, zone, given);
    const std::string* shared = value(header, "VARSHARELIST");
    if (shared == nullptr) return given;
    const std::string_view text = *shared;
    for (std::size_t at = text.find('['); at != std::string_view::npos;
         at = text.find('[', at + 1)) {
      const std::size_t end = std::min(text.find(']', at), text.size());
      const std::string_view rest =
          text.substr(end, std::min(text.find('[', end), text.size()) - end);
      const std::vector<std::size_t> from = number_list(rest);
      const std::size_t source = from.empty() ? 0 : from.front();
      for (const std::size_t variable : number_list(text.substr(at, end - at))) {
        if (source >= file_.zones.size() || variable >= zone.values.size() ||
            file_.zones[source].values[variable].size() != tuples(zone, variable))
          cursor_.fail_at(start, "VARSHARELIST: there is no such variable, or it has another size");
        zone.values[variable] = file_.zones[source].values[variable];
        given.insert(variable);
      }
    }
    return given;
  }

  /// D=(1,2,FECONNECT): the variables, and with FECONNECT the elements, of the preceding zone.
  void duplicate(const Header& header, std::size_t start, Zone& zone,
                 std::set<std::size_t>& given) const {
    const std::string* list = value(header, "D");
    if (list == nullptr) return;
    for (const std::size_t variable : number_list(*list)) {
      if (file_.zones.empty() || variable >= zone.values.size() ||
          file_.zones.back().values[variable].size() != tuples(zone, variable))
        cursor_.fail_at(start, "D=: there is no zone before, or it has another size");
      zone.values[variable] = file_.zones.back().values[variable];
      given.insert(variable);
    }
  }

  /// The place of the zone whose elements this zone shares, if it shares any.
  std::optional<std::size_t> shared_elements(const Header& header) const {
    if (const std::string* shared = value(header, "CONNECTIVITYSHAREZONE")) {
      const std::vector<std::size_t> from = number_list(*shared);
      return from.empty() ? file_.zones.size() : from.front();
    }
    const std::string* list = value(header, "D");
    if (list == nullptr || upper(*list).find("FECONNECT") == std::string::npos) return std::nullopt;
    return file_.zones.empty() ? 0 : file_.zones.size() - 1;
  }

  static std::size_t tuples(const Zone& zone, std::size_t variable) {
    return zone.cell_centered[variable] ? zone.elements : zone.nodes;
  }

  /// The next value of the data; "3*1.5" stands for three values.
  double next_value() {
    if (repeats_ > 0) {
      --repeats_;
      return repeated_;
    }
    skip_to_number();
    const std::size_t start = cursor_.offset();
    const std::string_view line = cursor_.peek_line();
    const std::size_t star = line.substr(0, line.find_first_of(" \t,")).find('*');
    if (star == std::string_view::npos) return number();
    const auto count = to_integer(line.substr(0, star));
    if (!count || *count < 1) cursor_.fail_at(start, "a repeated value N*VALUE expected");
    cursor_.move_to(start + star + 1);
    repeated_ = number();
    repeats_ = static_cast<std::size_t>(*count) - 1;
    return repeated_;
  }

  /// Skips blanks, commas and comments, which may separate numbers.
  void skip_to_number() { tokens_.skip(); }

  double number() {
    const std::string_view line = cursor_.peek_line();
    const std::size_t comma = line.substr(0, line.find_first_of(" \t")).find(',');
    if (comma == std::string_view::npos) return cursor_.real("a value");
    const auto value = to_real(line.substr(0, comma));
    if (!value) cursor_.refuse_word("a value");
    cursor_.bytes(comma, "");
    return *value;
  }

  void read_block(Zone& zone, const std::set<std::size_t>& given) {
    for (std::size_t v = 0; v < zone.values.size(); ++v) {
      if (given.contains(v)) continue;
      for (std::size_t i = 0; i < tuples(zone, v); ++i) zone.values[v].push_back(next_value());
    }
    repeats_ = 0;
  }

  void read_points(Zone& zone, const std::set<std::size_t>& given) {
    for (std::size_t i = 0; i < zone.nodes; ++i)
      for (std::size_t v = 0; v < zone.values.size(); ++v)
        if (!given.contains(v)) zone.values[v].push_back(next_value());
    if (std::find(zone.cell_centered.begin(), zone.cell_centered.end(), true) !=
        zone.cell_centered.end())
      cursor_.fail("cell-centred variables need BLOCK packing");
    repeats_ = 0;
  }

  void read_connectivity(const Header& header, std::size_t start, Zone& zone) {
    if (zone.ordered) return;
    if (const std::optional<std::size_t> from = shared_elements(header)) {
      if (*from >= file_.zones.size() || file_.zones[*from].element != zone.element ||
          file_.zones[*from].elements != zone.elements)
        cursor_.fail_at(start,
                        "the zone whose elements it shares is not there, or has other elements");
      zone.connectivity = file_.zones[*from].connectivity;
      zone.polyhedra = file_.zones[*from].polyhedra;
      return;
    }
    if (zone.elements > cursor_.left())
      cursor_.fail_at(start, "more elements announced than the file can hold");
    if (has_faces(zone)) return read_faces(header, start, zone);
    for (std::size_t i = 0; i < zone.elements * zone.nodes_per_element; ++i) {
      skip_to_number();
      zone.connectivity.push_back(cursor_.integer("a node number"));
    }
    if (value(header, "FACENEIGHBORCONNECTIONS") != nullptr) skip_numbers();
  }

  /// Skips the neighbours of faces, up to the next word that is not a number.
  void skip_numbers() {
    while (tokens_.skip() && (std::isdigit(static_cast<unsigned char>(tokens_.front())) != 0 ||
                              tokens_.front() == '-'))
      cursor_.word();
  }

  std::int64_t next_integer(std::string_view what) {
    skip_to_number();
    return cursor_.integer(what);
  }

  /// The number of nodes of each face (of a polygon: two), their nodes, the elements to the left
  /// and to the right of each face, and connections with other zones.
  void read_faces(const Header& header, std::size_t start, Zone& zone) {
    const auto size = [&](const char* name) {
      const std::string* found = value(header, name);
      return found == nullptr ? 0 : count_of(*found, start);
    };
    const bool solid = zone.element == "POLYHEDRON";
    std::vector<std::vector<std::int64_t>> faces;
    std::size_t total = 0;
    for (std::size_t f = size("FACES"); f > 0; --f) {
      const std::int64_t nodes = solid ? next_integer("a face's number of nodes") : 2;
      if (nodes < 0 || static_cast<std::uint64_t>(nodes) > cursor_.text().size() - total)
        cursor_.fail(fmt::format("a face's number of nodes expected ({} found)", nodes));
      faces.emplace_back(static_cast<std::size_t>(nodes));
      total += faces.back().size();
    }
    for (auto& face : faces)
      for (std::int64_t& node : face) node = next_integer("a face's node");
    if (solid) zone.polyhedra.resize(zone.elements);
    for (int side = 0; side < 2; ++side)
      for (const auto& face : faces) {
        // 0: no element; negative: an element of another zone
        const std::int64_t element = next_integer("the element beside a face");
        if (element > 0 && static_cast<std::uint64_t>(element) > zone.elements)
          cursor_.fail(fmt::format("there is no element {} beside a face (1 to {} expected)",
                                   element, zone.elements));
        if (solid && element > 0)
          zone.polyhedra[static_cast<std::size_t>(element) - 1].push_back(face);
      }
    const std::size_t connections = size("TOTALNUMBOUNDARYCONNECTIONS");
    for (std::size_t n = size("NUMCONNECTEDBOUNDARYFACES"); n > 0; --n)
      next_integer("a number of connections");
    for (std::size_t n = 0; n < 2 * connections; ++n) next_integer("a connection");
  }

  TextCursor cursor_;
  Tokens tokens_;
  TecplotFile file_;
  double repeated_ = 0;
  std::size_t repeats_ = 0;
};

}  // namespace

TecplotFile read_tecplot_text(const InputText& text) { return Reader(text).run(); }

}  // namespace hiac::formats::tecplot
