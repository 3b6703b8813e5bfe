#include "formats/gmsh/gmsh_data.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "formats/common/io/number_index.hpp"
#include "formats/common/mesh/node_resolver.hpp"

namespace hiac::formats::gmsh {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The tables for looking up values, shared by all fields of a file.
struct Places {
  std::shared_ptr<InputText> text;
  NumberIndex nodes;
  NumberIndex cells;
  std::size_t points = 0;
  std::vector<std::size_t> starts;  ///< of the cells' nodes
  std::vector<std::uint16_t> cell_types;
  std::vector<ForeignType> types;
};

std::size_t place_of(const NumberIndex& index, std::int64_t number, const MshStream& stream) {
  const std::size_t place = index.find(number);
  if (place == NumberIndex::kNone)
    stream.fail(fmt::format("a value for {}, which there is not", number));
  return place;
}

void read_tuple(MshStream& stream, std::size_t width, double* to) {
  for (std::size_t c = 0; c < width; ++c) to[c] = stream.real("a value");
}

/// A quadratic element that has values at its corners only: they are linear along its edges.
void fill_edges(const ForeignType& type, std::size_t width, double* values) {
  const std::size_t corners = corner_count(type.conversion.kind);
  for (std::size_t n = corners; n < type.nodes; ++n) {
    const auto [a, b] = edge_ends(type.conversion, n);
    for (std::size_t c = 0; c < width; ++c)
      values[n * width + c] = (values[a * width + c] + values[b * width + c]) / 2;
  }
}

void read_element_nodes(MshStream& stream, const Places& places, std::size_t width,
                        std::vector<double>& values) {
  const std::size_t cell = place_of(places.cells, stream.integer("an element number"), stream);
  const std::size_t count = stream.narrow_count("a number of nodes", 8);
  const ForeignType& type = places.types[places.cell_types[cell]];
  const bool quadratic = type.conversion.fate == CellFate::converted &&
                         order_of(type.conversion.kind) == CellOrder::quadratic;
  const bool corners_only = quadratic && count == corner_count(type.conversion.kind);
  if (count != type.nodes && !corners_only && type.conversion.fate != CellFate::no_volume)
    stream.fail(fmt::format("values at the {} nodes of a {} expected ({} found)", type.nodes,
                            type.name, count));
  std::vector<double> passed_over(width);
  double* const to = &values[places.starts[cell] * width];
  for (std::size_t n = 0; n < count; ++n)
    read_tuple(stream, width, n < type.nodes ? to + n * width : passed_over.data());
  if (corners_only) fill_edges(type, width, to);
}

void read_section(const DataSection& section, const Places& places, std::vector<double>& values) {
  MshStream stream = section.data;
  const std::size_t width = section.components;
  for (std::size_t i = 0; i < section.entities; ++i) {
    if (section.location == FieldLocation::corner) {
      read_element_nodes(stream, places, width, values);
      continue;
    }
    const bool node = section.location == FieldLocation::node;
    const std::int64_t number = stream.integer(node ? "a node number" : "an element number");
    const std::size_t place = place_of(node ? places.nodes : places.cells, number, stream);
    read_tuple(stream, width, &values[place * width]);
  }
}

std::size_t tuples_of(FieldLocation location, const Places& places) {
  if (location == FieldLocation::node) return places.points;
  return location == FieldLocation::cell ? places.cell_types.size() : places.starts.back();
}

/// Sections of one field at one step.
struct FieldParts {
  std::optional<std::size_t> time;
  std::vector<DataSection> sections;
};

/// A field has one step number at a time; a different number is a different step, even at the same
/// time.
class Grouping {
 public:
  std::vector<double> times;
  std::vector<FieldParts> fields;

  void add(DataSection&& section) {
    if (!section.time) return add_at(std::nullopt, std::move(section));
    std::size_t time = 0;
    for (; time < times.size(); ++time) {
      if (times[time] != *section.time) continue;
      const FieldParts* parts = find(section, time);
      if (parts == nullptr || parts->sections.front().step == section.step) break;
    }
    if (time == times.size()) times.push_back(*section.time);
    add_at(time, std::move(section));
  }

 private:
  void add_at(std::optional<std::size_t> time, DataSection&& section) {
    FieldParts* parts = find(section, time);
    if (parts == nullptr) parts = &fields.emplace_back(FieldParts{time, {}});
    parts->sections.push_back(std::move(section));
  }

  FieldParts* find(const DataSection& section, std::optional<std::size_t> time) {
    for (FieldParts& parts : fields) {
      const DataSection& first = parts.sections.front();
      if (parts.time == time && first.name == section.name && first.location == section.location &&
          first.components == section.components)
        return &parts;
    }
    return nullptr;
  }
};

std::shared_ptr<Places> places_of(const ForeignMesh& mesh, const std::shared_ptr<InputText>& text) {
  auto places = std::make_shared<Places>();
  places->text = text;
  places->nodes = NumberIndex(mesh.node_numbers);
  places->cells = NumberIndex(mesh.cell_numbers);
  places->points = mesh.point_count();
  places->cell_types = mesh.cell_types;
  places->types = mesh.types;
  places->starts.reserve(mesh.cell_count() + 1);
  places->starts.push_back(0);
  for (const std::uint16_t type : mesh.cell_types)
    places->starts.push_back(places->starts.back() + mesh.types[type].nodes);
  return places;
}

}  // namespace

void add_data(std::vector<DataSection>&& sections, const std::shared_ptr<InputText>& text,
              ForeignMesh& mesh) {
  if (sections.empty()) return;
  Grouping grouping;
  for (DataSection& section : sections) grouping.add(std::move(section));
  const std::shared_ptr<Places> places = places_of(mesh, text);
  mesh.times = std::move(grouping.times);
  for (FieldParts& parts : grouping.fields) {
    const DataSection& first = parts.sections.front();
    ForeignField field;
    field.name = first.name;
    field.location = first.location;
    field.components = static_cast<std::uint32_t>(first.components);
    field.step = parts.time;
    field.values = [places, data = std::move(parts.sections)] {
      std::vector<double> values(
          tuples_of(data.front().location, *places) * data.front().components, kNone);
      for (const DataSection& section : data) read_section(section, *places, values);
      return values;
    };
    mesh.fields.push_back(std::move(field));
  }
}

}  // namespace hiac::formats::gmsh
