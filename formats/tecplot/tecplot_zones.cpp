#include "formats/tecplot/tecplot_zones.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/text_cursor.hpp"
#include "formats/tecplot/data_numbers.hpp"
#include "formats/tecplot/tecplot_tokens.hpp"
#include "formats/tecplot/zone_header.hpp"

namespace hiac::formats::tecplot {
namespace {

class TextReader {
 public:
  explicit TextReader(const InputText& text)
      : cursor_(text.text(), text.path()), tokens_(cursor_), numbers_(cursor_, tokens_) {}

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

  void read_zone() {
    const ZoneHeader header(cursor_, tokens_);
    Zone zone = header.zone(file_.variables.size());
    const std::set<std::size_t> given = share(header, zone);
    if (header.is_block())
      read_block(zone, given);
    else
      read_points(zone, given);
    read_connectivity(header, zone);
    file_.zones.push_back(std::move(zone));
  }

  /// Takes shared variables from earlier zones; returns the variables that the zone does not store
  /// itself.
  std::set<std::size_t> share(const ZoneHeader& header, Zone& zone) const {
    std::set<std::size_t> given;
    if (const std::string* passive = header.value("PASSIVEVARLIST")) {
      for (const std::size_t variable : number_list(*passive)) {
        if (variable >= zone.values.size()) continue;
        zone.values[variable].assign(zone.tuples(variable),
                                     std::numeric_limits<double>::quiet_NaN());
        given.insert(variable);
      }
    }
    duplicate(header, zone, given);
    const std::string* shared = header.value("VARSHARELIST");
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
            file_.zones[source].values[variable].size() != zone.tuples(variable))
          header.fail("VARSHARELIST: there is no such variable, or it has another size");
        zone.values[variable] = file_.zones[source].values[variable];
        given.insert(variable);
      }
    }
    return given;
  }

  /// D=(1,2,FECONNECT): the variables, and with FECONNECT the elements, of the preceding zone.
  void duplicate(const ZoneHeader& header, Zone& zone, std::set<std::size_t>& given) const {
    const std::string* list = header.value("D");
    if (list == nullptr) return;
    for (const std::size_t variable : number_list(*list)) {
      if (file_.zones.empty() || variable >= zone.values.size() ||
          file_.zones.back().values[variable].size() != zone.tuples(variable))
        header.fail("D=: there is no zone before, or it has another size");
      zone.values[variable] = file_.zones.back().values[variable];
      given.insert(variable);
    }
  }

  /// The place of the zone whose elements this zone shares, if it shares any.
  std::optional<std::size_t> shared_elements(const ZoneHeader& header) const {
    if (const std::string* shared = header.value("CONNECTIVITYSHAREZONE")) {
      const std::vector<std::size_t> from = number_list(*shared);
      return from.empty() ? file_.zones.size() : from.front();
    }
    const std::string* list = header.value("D");
    if (list == nullptr || upper(*list).find("FECONNECT") == std::string::npos) return std::nullopt;
    return file_.zones.empty() ? 0 : file_.zones.size() - 1;
  }

  void read_block(Zone& zone, const std::set<std::size_t>& given) {
    for (std::size_t v = 0; v < zone.values.size(); ++v) {
      if (given.contains(v)) continue;
      for (std::size_t i = 0; i < zone.tuples(v); ++i) zone.values[v].push_back(numbers_.value());
    }
    numbers_.drop_repeats();
  }

  void read_points(Zone& zone, const std::set<std::size_t>& given) {
    for (std::size_t i = 0; i < zone.nodes; ++i)
      for (std::size_t v = 0; v < zone.values.size(); ++v)
        if (!given.contains(v)) zone.values[v].push_back(numbers_.value());
    if (std::find(zone.cell_centered.begin(), zone.cell_centered.end(), true) !=
        zone.cell_centered.end())
      cursor_.fail("cell-centred variables need BLOCK packing");
    numbers_.drop_repeats();
  }

  void read_connectivity(const ZoneHeader& header, Zone& zone) {
    if (zone.ordered) return;
    if (const std::optional<std::size_t> from = shared_elements(header)) {
      if (*from >= file_.zones.size() || file_.zones[*from].element != zone.element ||
          file_.zones[*from].elements != zone.elements)
        header.fail("the zone whose elements it shares is not there, or has other elements");
      zone.connectivity = file_.zones[*from].connectivity;
      zone.polyhedra = file_.zones[*from].polyhedra;
      return;
    }
    if (zone.elements > cursor_.left())
      header.fail("more elements announced than the file can hold");
    if (zone.has_faces()) return read_faces(header, zone);
    for (std::size_t i = 0; i < zone.elements * zone.nodes_per_element; ++i)
      zone.connectivity.push_back(numbers_.integer("a node number"));
    if (header.value("FACENEIGHBORCONNECTIONS") != nullptr) numbers_.skip_integers();
  }

  /// The number of nodes of each face (of a polygon: two), their nodes, the elements to the left
  /// and to the right of each face, and connections with other zones.
  void read_faces(const ZoneHeader& header, Zone& zone) {
    const bool solid = zone.element == "POLYHEDRON";
    std::vector<std::vector<std::int64_t>> faces;
    std::size_t total = 0;
    for (std::size_t f = header.count("FACES"); f > 0; --f) {
      const std::int64_t nodes = solid ? numbers_.integer("a face's number of nodes") : 2;
      if (nodes < 0 || static_cast<std::uint64_t>(nodes) > cursor_.text().size() - total)
        cursor_.fail(fmt::format("a face's number of nodes expected ({} found)", nodes));
      faces.emplace_back(static_cast<std::size_t>(nodes));
      total += faces.back().size();
    }
    for (auto& face : faces)
      for (std::int64_t& node : face) node = numbers_.integer("a face's node");
    if (solid) zone.polyhedra.resize(zone.elements);
    for (int side = 0; side < 2; ++side)
      for (const auto& face : faces) {
        // 0: no element; negative: an element of another zone
        const std::int64_t element = numbers_.integer("the element beside a face");
        if (element > 0 && static_cast<std::uint64_t>(element) > zone.elements)
          cursor_.fail(fmt::format("there is no element {} beside a face (1 to {} expected)",
                                   element, zone.elements));
        if (solid && element > 0)
          zone.polyhedra[static_cast<std::size_t>(element) - 1].push_back(face);
      }
    const std::size_t connections = header.count("TOTALNUMBOUNDARYCONNECTIONS");
    for (std::size_t n = header.count("NUMCONNECTEDBOUNDARYFACES"); n > 0; --n)
      numbers_.integer("a number of connections");
    for (std::size_t n = 0; n < 2 * connections; ++n) numbers_.integer("a connection");
  }

  TextCursor cursor_;
  Tokens tokens_;
  DataNumbers numbers_;
  TecplotFile file_;
};

}  // namespace

TecplotFile read_tecplot_text(const InputText& text) { return TextReader(text).run(); }

}  // namespace hiac::formats::tecplot
