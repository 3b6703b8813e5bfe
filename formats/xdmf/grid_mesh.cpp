#include "formats/xdmf/grid_mesh.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/xdmf/topologies.hpp"

namespace hiac::formats::xdmf {
namespace {

class GridMesh {
 public:
  GridMesh(DataItems& items, ForeignMesh& mesh) : items_(items), mesh_(mesh) {}

  void add(const UniformGrid& grid) {
    std::string type = grid.topology.attribute("TopologyType").as_string();
    if (type.empty()) type = grid.topology.attribute("Type").as_string();
    if (type.size() > 4 && same_word(std::string_view(type).substr(type.size() - 4), "Mesh"))
      add_structured(grid, type);
    else
      add_unstructured(grid, type);
  }

 private:
  void add_unstructured(const UniformGrid& grid, const std::string& type) {
    const auto first_point = static_cast<std::int64_t>(mesh_.point_count());
    add_points(grid.geometry);
    const pugi::xml_node item = items_.item_in(grid.topology);
    std::vector<std::int64_t> numbers = items_.integers(item);
    // Fortran programs number from 1
    const std::int64_t offset = grid.topology.attribute("BaseOffset").as_llong(0);
    if (same_word(type, "Mixed")) {
      if (offset != 0) items_.fail(grid.topology, "is mixed and has a BaseOffset");
      add_mixed_cells(numbers, first_point, items_.path(), mesh_);
      return;
    }
    const auto topology = topology_named(type);
    if (!topology) items_.fail(grid.topology, fmt::format("is of the unknown type '{}'", type));
    std::size_t nodes = topology->nodes;
    if (nodes == 0) nodes = grid.topology.attribute("NodesPerElement").as_uint(1);
    if (nodes == 0 || numbers.size() % nodes != 0)
      items_.fail(grid.topology, fmt::format("{} nodes make no whole number of cells of {}",
                                             numbers.size(), nodes));
    add_cells(*topology, nodes, numbers, first_point - offset, mesh_);
  }

  void add_points(const pugi::xml_node& geometry) {
    std::string type = geometry.attribute("GeometryType").as_string();
    if (type.empty()) type = geometry.attribute("Type").as_string("XYZ");
    for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    if (type == "XYZ" || type == "XY") {
      const std::vector<double> values = items_.reals(items_.item_in(geometry));
      const std::size_t width = type.size();
      if (values.size() % width != 0) items_.fail(geometry, "has an incomplete point");
      for (std::size_t i = 0; i < values.size(); i += width)
        for (std::size_t d = 0; d < 3; ++d) mesh_.xyz.push_back(d < width ? values[i + d] : 0);
    } else if (type == "X_Y_Z" || type == "X_Y") {
      const std::size_t width = type == "X_Y" ? 2 : 3;
      std::vector<std::vector<double>> axes(3);
      for (std::size_t d = 0; d < width; ++d) axes[d] = items_.reals(items_.item_in(geometry, d));
      axes[2].resize(width == 2 ? axes[0].size() : axes[2].size());
      if (axes[1].size() != axes[0].size() || axes[2].size() != axes[0].size())
        items_.fail(geometry, "its axes have different numbers of points");
      for (std::size_t i = 0; i < axes[0].size(); ++i)
        for (std::size_t d = 0; d < 3; ++d) mesh_.xyz.push_back(axes[d][i]);
    } else {
      items_.fail(geometry, fmt::format("is of the type '{}' (XYZ, XY or X_Y_Z expected)", type));
    }
  }

  /// A structured mesh: points as a list, from three axes, or from an origin and a spacing. XDMF
  /// gives all its parts in the order z, y, x.
  void add_structured(const UniformGrid& grid, const std::string& type) {
    const pugi::xml_attribute dimensions = grid.topology.attribute("Dimensions")
                                               ? grid.topology.attribute("Dimensions")
                                               : grid.topology.attribute("NumberOfElements");
    std::array<long long, 3> zyx{1, 1, 1};
    if (std::sscanf(dimensions.as_string(), "%lld %lld %lld", &zyx[0], &zyx[1], &zyx[2]) != 3)
      items_.fail(grid.topology, "does not have three Dimensions");
    const std::size_t first_point = mesh_.point_count();
    const std::array<std::int64_t, 3> xyz{zyx[2], zyx[1], zyx[0]};
    if (same_word(type, "3DSMesh")) {
      add_points(grid.geometry);
      const StructuredBlock block =
          structured_block(xyz, mesh_.point_count() - first_point, items_.path());
      if (block.point_count() != mesh_.point_count() - first_point)
        items_.fail(grid.geometry,
                    fmt::format("has {} points ({} expected)", mesh_.point_count() - first_point,
                                block.point_count()));
      add_bricks(mesh_, block, first_point, {}, "");
      return;
    }
    std::array<std::vector<double>, 3> axes = axes_of(grid, type, xyz);
    const StructuredBlock block = structured_block(xyz, std::size_t{1} << 31, items_.path());
    require_field(grid, block);
    for (const double z : axes[2])
      for (const double y : axes[1])
        for (const double x : axes[0]) mesh_.xyz.insert(mesh_.xyz.end(), {x, y, z});
    add_bricks(mesh_, block, first_point, {}, "");
  }

  /// A grid declared by its axes takes few bytes: a field on it proves its size.
  void require_field(const UniformGrid& grid, const StructuredBlock& block) {
    for (const pugi::xml_node attribute : grid.attributes)
      if (items_.reals(items_.item_in(attribute)).size() >= block.cell_count()) return;
    items_.fail(grid.topology, "has no attribute over its points or cells");
  }

  std::array<std::vector<double>, 3> axes_of(const UniformGrid& grid, const std::string& type,
                                             const std::array<std::int64_t, 3>& counts) {
    std::array<std::vector<double>, 3> axes;
    if (same_word(type, "3DRectMesh")) {
      for (std::size_t d = 0; d < 3; ++d) axes[d] = items_.reals(items_.item_in(grid.geometry, d));
    } else if (same_word(type, "3DCoRectMesh")) {
      const std::vector<double> origin = items_.reals(items_.item_in(grid.geometry, 0));
      const std::vector<double> spacing = items_.reals(items_.item_in(grid.geometry, 1));
      if (origin.size() != 3 || spacing.size() != 3)
        items_.fail(grid.geometry, "does not have an origin and a spacing of three numbers");
      for (std::size_t d = 0; d < 3; ++d)
        for (std::int64_t i = 0; i < std::min<std::int64_t>(counts[d], 1 << 24); ++i)
          axes[d].push_back(origin[2 - d] + static_cast<double>(i) * spacing[2 - d]);
    } else {
      items_.fail(grid.topology, fmt::format("is of the unknown type '{}'", type));
    }
    for (std::size_t d = 0; d < 3; ++d)
      if (static_cast<std::int64_t>(axes[d].size()) != counts[d])
        items_.fail(grid.geometry, fmt::format("has {} places along an axis ({} expected)",
                                               axes[d].size(), counts[d]));
    return axes;
  }

  DataItems& items_;
  ForeignMesh& mesh_;
};

}  // namespace

void add_grid_mesh(DataItems& items, UniformGrid& grid, ForeignMesh& mesh) {
  const std::size_t first_point = mesh.point_count();
  const std::size_t first_cell = mesh.cell_count();
  GridMesh(items, mesh).add(grid);
  grid.points = mesh.point_count() - first_point;
  grid.cells = mesh.cell_count() - first_cell;
}

}  // namespace hiac::formats::xdmf
