#include "formats/cgns/sections.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/cgns/element_types.hpp"
#include "formats/common/mesh/assemble.hpp"

namespace hiac::formats::cgns {
namespace {

using Lists = std::vector<std::vector<std::int64_t>>;

class Sections {
 public:
  /// `offset`: what makes a node's number its place in the mesh.
  Sections(const CgnsFile& file, std::int64_t offset, ForeignMesh& mesh)
      : file_(file), offset_(offset), mesh_(mesh) {}

  void add_all(Zone& zone) {
    std::vector<std::pair<std::int64_t, Node>> sections;
    for (const Node& section : file_.children(zone.node, "Elements_t")) {
      const auto range = file_.child(section, "ElementRange");
      const auto numbers = range ? file_.integers(*range) : std::vector<std::int64_t>();
      if (numbers.size() != 2) file_.fail(section, "has no ElementRange");
      sections.emplace_back(numbers[0], section);
    }
    std::sort(sections.begin(), sections.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [first, section] : sections) note_polygons(first, section);
    for (const auto& [first, section] : sections) {
      const std::size_t first_cell = mesh_.cell_count();
      add_section(section);
      const std::size_t count = mesh_.cell_count() - first_cell;
      for (std::size_t i = 0; i < count; ++i)
        zone.numbers.push_back(static_cast<std::size_t>(std::max<std::int64_t>(first, 1)) - 1 + i);
      if (sections.size() > 1)
        mesh_.blocks.push_back({section.name, {{first_cell, mesh_.cell_count()}}});
    }
  }

 private:
  void add_section(const Node& section) {
    const std::vector<std::int64_t> kind = file_.integers(section);
    const auto list = file_.child(section, "ElementConnectivity");
    if (kind.empty() || !list) file_.fail(section, "has no ElementConnectivity");
    const std::vector<std::int64_t> numbers = file_.integers(*list);
    if (kind[0] == kPolygons || kind[0] == kPolyhedra) {
      add_lists(section, kind[0] == kPolyhedra);
    } else if (kind[0] == kMixed) {
      for (std::size_t at = 0; at < numbers.size();) {
        const auto type = type_of(section, numbers[at++]);
        if (type.nodes > numbers.size() - at) file_.fail(*list, "ended in the middle of a cell");
        add_cells(type, std::span(numbers).subspan(at, type.nodes));
        at += type.nodes;
      }
    } else {
      const auto type = type_of(section, kind[0]);
      if (numbers.size() % type.nodes != 0)
        file_.fail(*list,
                   fmt::format("{} nodes make no whole number of {}", numbers.size(), type.name));
      add_cells(type, numbers);
    }
  }

  [[nodiscard]] ElementType type_of(const Node& section, std::int64_t number) const {
    const auto type = element_numbered(number);
    if (!type) file_.fail(section, fmt::format("has elements of the unknown type {}", number));
    return *type;
  }

  void add_cells(const ElementType& type, std::span<const std::int64_t> numbers) {
    mesh_.cell_types.insert(mesh_.cell_types.end(), numbers.size() / type.nodes,
                            mesh_.type_place(type.name, type.nodes, type.conversion));
    for (const std::int64_t number : numbers) mesh_.cell_nodes.push_back(number + offset_);
  }

  /// The lists of an NGON_n or NFACE_n section: delimited by offsets (CGNS 4), or each preceded by
  /// its length.
  [[nodiscard]] Lists lists_of(const Node& section) const {
    const auto connectivity = file_.child(section, "ElementConnectivity");
    if (!connectivity) file_.fail(section, "has no ElementConnectivity");
    const std::vector<std::int64_t> numbers = file_.integers(*connectivity);
    Lists lists;
    std::size_t at = 0;
    const auto take = [&](std::int64_t count) {
      if (count < 0 || static_cast<std::uint64_t>(count) > numbers.size() - at)
        file_.fail(*connectivity, "ended in the middle of a list");
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(at);
      lists.emplace_back(begin, begin + count);
      at += static_cast<std::size_t>(count);
    };
    if (const auto offsets = file_.child(section, "ElementStartOffset")) {
      const std::vector<std::int64_t> starts = file_.integers(*offsets);
      for (std::size_t i = 1; i < starts.size(); ++i) {
        if (starts[i] < starts[i - 1]) file_.fail(*offsets, "does not rise");
        take(starts[i] - starts[i - 1]);
      }
    } else {
      while (at < numbers.size()) {
        const std::int64_t count = numbers[at++];
        take(count);
      }
    }
    return lists;
  }

  /// The faces of polyhedra, by element number.
  void note_polygons(std::int64_t first, const Node& section) {
    const std::vector<std::int64_t> kind = file_.integers(section);
    if (kind.empty() || kind[0] != kPolygons) return;
    std::int64_t number = first;
    for (std::vector<std::int64_t>& polygon : lists_of(section)) {
      for (std::int64_t& node : polygon) node += offset_;
      polygons_[number++] = std::move(polygon);
    }
  }

  void add_lists(const Node& section, bool polyhedra) {
    const Lists lists = lists_of(section);
    if (!polyhedra) {
      mesh_.cell_types.insert(mesh_.cell_types.end(), lists.size(),
                              mesh_.type_place("NGON_n", 0, kNoVolume));
      return;
    }
    for (const std::vector<std::int64_t>& list : lists) {
      Lists faces;
      for (const std::int64_t signed_number : list) {
        // the sign gives the orientation of the face, which is determined later anyway
        const auto found = polygons_.find(signed_number < 0 ? -signed_number : signed_number);
        if (found == polygons_.end())
          file_.fail(section, fmt::format("names the face {}, which is in no NGON_n section",
                                          signed_number));
        // otherwise a small file could demand much memory
        if (++uses_[found->first] > 2)
          file_.fail(section, fmt::format("names the face {} more than twice", found->first));
        faces.push_back(found->second);
      }
      mesh_.add_polyhedron("NFACE_n (polyhedron)", faces);
    }
  }

  const CgnsFile& file_;
  std::int64_t offset_;
  ForeignMesh& mesh_;
  std::map<std::int64_t, std::vector<std::int64_t>> polygons_;  ///< of the zone, by their numbers
  std::map<std::int64_t, int> uses_;                            ///< of polygons, by cells
};

}  // namespace

void add_sections(const CgnsFile& file, std::size_t first_point, Zone& zone, ForeignMesh& mesh) {
  // nodes are numbered from 1
  Sections(file, static_cast<std::int64_t>(first_point) - 1, mesh).add_all(zone);
}

void number_volumes(const ForeignMesh& mesh, std::size_t first_cell, Zone& zone) {
  const auto has_volume = [&](std::size_t i) {
    const std::uint16_t type = mesh.cell_types[first_cell + i];
    return mesh.types[type].conversion.fate != CellFate::no_volume;
  };
  std::size_t volumes = 0;
  for (std::size_t i = 0; i < zone.numbers.size(); ++i) volumes += has_volume(i) ? 1 : 0;
  if (volumes != zone.numbered) return;
  std::size_t next = 0;
  for (std::size_t i = 0; i < zone.numbers.size(); ++i)
    zone.numbers[i] = has_volume(i) ? next++ : volumes;
}

}  // namespace hiac::formats::cgns
