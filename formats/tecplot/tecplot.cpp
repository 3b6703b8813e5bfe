#include "formats/tecplot/tecplot.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

#include <fmt/format.h>

#include "formats/common/cells/solid_orders.hpp"
#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/tecplot/tecplot_binary.hpp"
#include "formats/tecplot/tecplot_zones.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using tecplot::TecplotFile;
using tecplot::Zone;

/// The places of x, y and z among the variables: by name, otherwise the first three.
std::array<std::size_t, 3> coordinate_places(const TecplotFile& file, const std::string& subject) {
  if (file.variables.size() < 3)
    throw InputError(subject, fmt::format("three coordinates expected among the variables ({} "
                                          "variables found)",
                                          file.variables.size()));
  std::array<std::size_t, 3> places{0, 1, 2};
  std::array<std::size_t, 3> named{};
  constexpr std::array<std::string_view, 3> kNames{"X", "Y", "Z"};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto found =
        std::find_if(file.variables.begin(), file.variables.end(), [&](const std::string& name) {
          const std::string plain = upper(trimmed(name));
          return plain == kNames[c] || plain == fmt::format("COORDINATE{}", kNames[c]);
        });
    if (found == file.variables.end()) return places;
    named[c] = static_cast<std::size_t>(found - file.variables.begin());
  }
  return named;
}

void add_ordered_cells(const Zone& zone, std::size_t first_node, ForeignMesh& mesh) {
  const std::size_t ni = zone.dimensions[0];
  const std::size_t nj = zone.dimensions[1];
  const std::size_t nk = zone.dimensions[2];
  const bool solid = ni > 1 && nj > 1 && nk > 1;
  const std::uint16_t type =
      solid ? mesh.type_place("ordered hexahedron", 8, solid_conversion(CellKind::brick8))
            : mesh.type_place("ordered surface or line", 0, kNoVolume);
  if (!solid) {
    mesh.cell_types.insert(mesh.cell_types.end(), zone.elements, type);
    return;
  }
  for (std::size_t k = 0; k + 1 < nk; ++k)
    for (std::size_t j = 0; j + 1 < nj; ++j)
      for (std::size_t i = 0; i + 1 < ni; ++i) {
        mesh.cell_types.push_back(type);
        const std::size_t corner = first_node + (k * nj + j) * ni + i;
        for (const std::size_t layer : {std::size_t{0}, ni * nj})
          for (const std::size_t n : {corner, corner + 1, corner + ni + 1, corner + ni})
            mesh.cell_nodes.push_back(static_cast<std::int64_t>(n + layer));
      }
}

void add_elements(const Zone& zone, std::size_t first_node, const std::string& subject,
                  ForeignMesh& mesh) {
  const auto checked = [&](std::int64_t node) {
    if (node < 1 || static_cast<std::uint64_t>(node) > zone.nodes)
      throw InputError(subject, fmt::format("zone '{}': there is no node {} (1 to {} expected)",
                                            zone.name, node, zone.nodes));
    return node - 1 + static_cast<std::int64_t>(first_node);
  };
  if (!zone.polyhedra.empty()) {
    for (std::vector<std::vector<std::int64_t>> faces : zone.polyhedra) {
      for (auto& face : faces)
        for (std::int64_t& node : face) node = checked(node);
      mesh.add_polyhedron("POLYHEDRON", faces);
    }
    return;
  }
  CellConversion conversion = kNoVolume;
  if (zone.element == "BRICK") conversion = solid_conversion(CellKind::brick8);
  if (zone.element == "TETRAHEDRON") conversion = solid_conversion(CellKind::tetrahedron4);
  const std::uint16_t type = mesh.type_place(zone.element, zone.nodes_per_element, conversion);
  mesh.cell_types.insert(mesh.cell_types.end(), zone.elements, type);
  for (const std::int64_t node : zone.connectivity) mesh.cell_nodes.push_back(checked(node));
}

/// Appends the values of a variable on nodes or on cells; NaN if the zone has it on the other.
void append_values(const Zone& zone, std::size_t variable, bool on_cells,
                   std::vector<double>& values) {
  const std::size_t tuples = on_cells ? zone.elements : zone.nodes;
  if (zone.cell_centered[variable] == on_cells)
    values.insert(values.end(), zone.values[variable].begin(), zone.values[variable].end());
  else
    values.insert(values.end(), tuples, std::numeric_limits<double>::quiet_NaN());
}

/// The distinct times of the zones, rising.
std::vector<double> times_of(const TecplotFile& file) {
  std::vector<double> times;
  for (const Zone& zone : file.zones)
    if (zone.time) times.push_back(*zone.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Zones are pieces of the mesh, and become blocks with their names. If zones have times, those of
/// the requested time and those without a time are read.
ForeignMesh mesh_of(TecplotFile&& file, const ReadOptions& options, const std::string& subject) {
  ForeignMesh mesh;
  mesh.notes = std::move(file.notes);
  mesh.times = times_of(file);
  if (!file.title.empty()) mesh.metadata.emplace_back("title", file.title);
  if (!mesh.times.empty()) {
    const std::size_t step =
        requested_step(options, mesh.times, subject).value_or(mesh.times.size() - 1);
    std::erase_if(file.zones,
                  [&](const Zone& zone) { return zone.time && *zone.time != mesh.times[step]; });
  }
  const auto places = coordinate_places(file, subject);
  for (const Zone& zone : file.zones) {
    const std::size_t first_node = mesh.point_count();
    for (const std::size_t place : places)
      if (zone.cell_centered[place])
        throw InputError(subject,
                         fmt::format("zone '{}': a coordinate is cell-centred", zone.name));
    for (std::size_t node = 0; node < zone.nodes; ++node)
      for (const std::size_t place : places) mesh.xyz.push_back(zone.values[place][node]);
    const std::size_t first_cell = mesh.cell_count();
    if (zone.ordered)
      add_ordered_cells(zone, first_node, mesh);
    else
      add_elements(zone, first_node, subject, mesh);
    mesh.blocks.push_back({zone.name, {{first_cell, mesh.cell_count()}}});
  }
  for (std::size_t v = 0; v < file.variables.size(); ++v) {
    if (std::find(places.begin(), places.end(), v) != places.end()) continue;
    for (const bool on_cells : {false, true}) {
      if (std::none_of(file.zones.begin(), file.zones.end(),
                       [&](const Zone& zone) { return zone.cell_centered[v] == on_cells; }))
        continue;
      std::vector<double> values;
      for (const Zone& zone : file.zones) append_values(zone, v, on_cells, values);
      mesh.fields.push_back(field_of(file.variables[v],
                                     on_cells ? FieldLocation::cell : FieldLocation::node, 1,
                                     std::move(values)));
      if (!mesh.times.empty()) {
        const std::size_t step =
            requested_step(options, mesh.times, subject).value_or(mesh.times.size() - 1);
        mesh.fields.back().step = step;
      }
    }
  }
  return mesh;
}

/// Whether the first line that is not a comment begins one of the records that come first. A title
/// alone is not enough: solvers' decks have titles too.
bool begins_with_record(std::string_view head) {
  TextCursor cursor(head, "");
  bool title = false;
  while (!cursor.at_end()) {
    const std::string_view line = trimmed(cursor.line());
    if (line.empty() || line.starts_with('#')) continue;
    for (const std::string_view word : {"VARIABLES", "ZONE", "FILETYPE"})
      if (starts_with_upper(line, word) &&
          (line.size() == word.size() ||
           std::isalpha(static_cast<unsigned char>(line[word.size()])) == 0))
        return true;
    if (!title && !starts_with_upper(line, "TITLE")) return false;
    title = true;
  }
  return false;
}

}  // namespace

Format tecplot_format() {
  Format format;
  format.name = "tecplot";
  format.extensions = {".dat", ".tec", ".plt", ".tp"};
  format.kinds = "tet4 pyr5 prism6 wedge7 brick8, polyhedra, ordered";
  format.fields = "node, cell";
  format.time_steps = "many";
  format.recognizes = [](std::string_view head) {
    if (tecplot::is_tecplot_binary(head)) return true;
    return begins_with_record(head);
  };
  format.gzip = true;
  read_through(format, [](const std::string& path, const ReadOptions& options) {
    const InputText text(path);
    return mesh_of(tecplot::is_tecplot_binary(text.text()) ? tecplot::read_tecplot_binary(text)
                                                           : tecplot::read_tecplot_text(text),
                   options, path);
  });
  return format;
}

}  // namespace hiac::formats
