#include "hiac/frame/renderable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/collect.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/element/cell_field.hpp"
#include "hiac/element/world_polynomial.hpp"
#include "hiac/frame/surfaces/skin.hpp"
#include "hiac/frame/surfaces/surface_look.hpp"
#include "hiac/geometry/box.hpp"
#include "hiac/geometry/face_form.hpp"
#include "hiac/geometry/jacobian_sign.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/mesh/corner_fan.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"

namespace hiac {
namespace {

constexpr std::size_t kRenderableGrain = std::size_t{1} << 14;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// How many items fail a test, and the first of them.
struct Failures {
  std::size_t count = 0, first = kNone;
};

template <typename Fails>
Failures count_failures(std::size_t count, const Fails& fails) {
  Failures all;
  std::mutex mutex;
  parallel_for(count, kRenderableGrain, [&](IndexRange range) {
    Failures some;
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (!fails(i)) continue;
      if (some.count++ == 0) some.first = i;
    }
    if (some.count == 0) return;
    const std::lock_guard lock(mutex);
    all.count += some.count;
    all.first = std::min(all.first, some.first);
  });
  return all;
}

std::string cell_name(const ZooMesh& mesh, std::size_t cell) {
  return fmt::format("cell {} ({})", cell, kind_name(mesh.kinds[cell]));
}

// The message's addition about failures other than the first.
std::string others(const Failures& failures) {
  return failures.count == 1 ? "" : fmt::format("; {} cells in all", failures.count);
}

// Whether the cell's surface turns the other way at some corners than at others (the Jacobian
// changes its sign). A closed surface with convex planar faces that turns the same way at all
// corners bounds a convex body. Three edges in a plane have no orientation.
bool turns_both_ways(const ZooMesh& mesh, std::size_t cell, double planarity) {
  const CellShape shape = shape_of(mesh.kinds[cell]);
  if (shape == CellShape::tetrahedron) return false;
  const auto nodes = mesh.cell_nodes(static_cast<CellId>(cell));
  bool left = false, right = false;
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    const CornerFan& fan = corner_fan(shape, corner);
    std::array<Vector, 4> edge;
    for (std::size_t k = 0; k < fan.count; ++k)
      edge[k] = minus(mesh.position(nodes[fan.neighbors[k]]), mesh.position(nodes[corner]));
    for (std::size_t k = 0; k < (fan.count == 3 ? 1 : fan.count); ++k) {
      const Vector &a = edge[k], &b = edge[(k + 1) % fan.count], &c = edge[(k + 2) % fan.count];
      const double volume = dot(a, cross(b, c));
      const double box = std::sqrt(dot(a, a) * dot(b, b) * dot(c, c));
      left = left || volume > planarity * box;
      right = right || volume < -planarity * box;
    }
  }
  return left && right;
}

// Whether a planar quadrilateral face turns both ways: dented or crossed.
bool has_bent_face(const ZooMesh& mesh, std::size_t cell, double planarity) {
  const auto nodes = mesh.cell_nodes(static_cast<CellId>(cell));
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
    if (face.corner_count != 4) continue;
    const auto at = [&](std::size_t k) { return mesh.position(nodes[face.corners[k % 4]]); };
    std::array<Vector, 4> normal;
    std::array<double, 4> size;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector next = minus(at(k + 1), at(k)), before = minus(at(k + 3), at(k));
      normal[k] = cross(next, before);
      size[k] = dot(next, next) * dot(before, before);
    }
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t j = 0; j < k; ++j)
        if (dot(normal[j], normal[k]) < -planarity * std::sqrt(size[j] * size[k])) return true;
  }
  return false;
}

// What is wrong with a cell's geometry, as the words for expected and found; null if nothing is.
const char* fault_of(const ZooMesh& mesh, std::size_t cell, double planarity) {
  if (!has_curved_faces(mesh, static_cast<CellId>(cell), planarity)) {
    const bool bent =
        turns_both_ways(mesh, cell, planarity) || has_bent_face(mesh, cell, planarity);
    return bent ? "the cell is not convex, or turned inside out in part (corners that all turn one "
                  "way expected, both ways found"
                : nullptr;
  }
  const auto at = cell_positions(mesh, static_cast<CellId>(cell));
  const auto nodes = std::span(at).first(node_count(mesh.kinds[cell]));
  switch (jacobian_sign(mesh.kinds[cell], nodes, planarity)) {
    case JacobianSign::mixed:
      return "the cell is turned inside out in part (a Jacobian determinant of one sign expected, "
             "both signs found";
    case JacobianSign::undecided:
      return "the cell may be turned inside out in part (a Jacobian determinant of one sign "
             "expected, which could not be proven";
    case JacobianSign::positive:
    case JacobianSign::negative:
    case JacobianSign::flat:
      break;
  }
  return nullptr;
}

// Checks that every cell's nodes determine the polynomial that interpolates fields. `skip_invalid`:
// except for cells that are left out.
void check_polynomials(const ZooMesh& mesh, double planarity, bool skip_invalid) {
  const std::array<double, kMaxNodesPerCell> any{};
  const Failures failures = count_failures(mesh.cell_count(), [&](std::size_t cell) {
    return !WorldPolynomial::through(mesh, static_cast<CellId>(cell), any) &&
           !(skip_invalid && fault_of(mesh, cell, planarity) != nullptr);
  });
  if (failures.count == 0) return;
  const char* fault =
      WorldPolynomial::is_of_paper(mesh.kinds[failures.first])
          ? "the nodes do not determine the paper's function, which depends on how the cell lies "
            "(independent equations expected, a pivot below 1e-10 found"
          : "the nodes do not determine a polynomial (nodes that are apart and not in one plane "
            "expected, others found";
  throw InputError(
      cell_name(mesh, failures.first),
      fmt::format("`render.interpolation` = \"polynomial\": {}{})", fault, others(failures)));
}

// Checks the values of a field that cells use, by entry of ZooMesh::nodes (nodes and corners) or by
// cell.
void check_field(const ZooMesh& mesh, const std::string& name) {
  const Field field = scalar_field(mesh, name);
  const auto values = field.values.view();
  const auto bad = [&](std::size_t i) { return !std::isfinite(values[i]); };
  Failures failures = count_failures(values.size(), bad);
  if (failures.count == 0) return;
  if (field.location == FieldLocation::node) {
    // nodes that belong to no cell may have any value
    const auto used = mark_used_nodes(mesh.nodes.view(), mesh.node_count());
    failures = count_failures(values.size(), [&](std::size_t i) { return used[i] != 0 && bad(i); });
    if (failures.count == 0) return;
  }
  const auto entry_cell = [&] {
    return std::upper_bound(mesh.elems.begin(), mesh.elems.end(), failures.first) -
           mesh.elems.begin() - 1;
  };
  const std::string place = field.location == FieldLocation::node ? "node"
                            : field.location == FieldLocation::cell
                                ? "cell"
                                : fmt::format("a corner of cell {}, entry", entry_cell());
  throw InputError(fmt::format("field '{}'", name),
                   fmt::format("values are not finite (finite numbers expected, {} others found, "
                               "first {} at {} {})",
                               failures.count, values[failures.first], place, failures.first));
}

// Checks that differences and products of values do not overflow.
void check_size(const std::string& name, std::span<const double> values) {
  const Failures failures = count_failures(values.size(), [&](std::size_t i) {
    return std::isfinite(values[i]) && std::abs(values[i]) > kLargestNumber;
  });
  if (failures.count == 0) return;
  throw InputError(
      fmt::format("field '{}'", name),
      fmt::format("values are too large (at most {} in magnitude expected, {} others found, first "
                  "{})",
                  kLargestNumber, failures.count, values[failures.first]));
}

// Checks that no pixel can be brighter than colours may be.
void check_brightness(const ZooMesh& mesh, const Scene& scene) {
  const auto refuse = [](const std::string& key, double most) {
    throw InputError(fmt::format("key `{}`", key),
                     fmt::format("pixels may become too bright (at most {} expected, {} found)",
                                 kLargestColor, most));
  };
  for (std::size_t s = 0; s < scene.isosurfaces.size(); ++s) {
    const double most = largest_light(look_of(scene.isosurfaces[s]), scene.lights);
    if (!(most <= kLargestColor)) refuse(fmt::format("isosurface.{}", s), most);
  }
  if (scene.skin) {
    const double most = largest_light(*scene.skin, scene.lights);
    if (!(most <= kLargestColor)) refuse("skin", most);
  }
  if (!scene.volume.color || scene.volume.glow != Glow::emission) return;
  double brightest = 0;
  for (const auto& point : scene.volume.color->points)
    for (const double component : point.value) brightest = std::max(brightest, component);
  const double most = brightest * box_of_nodes(mesh).diagonal();
  if (!(most <= kLargestColor)) refuse("volume.color.points", most);
}

}  // namespace

std::vector<CellId> invalid_cells(const ZooMesh& mesh, double planarity) {
  return collect<CellId>(mesh.cell_count(), kRenderableGrain, [&](std::size_t cell, auto& found) {
    if (fault_of(mesh, cell, planarity) != nullptr) found.push_back(static_cast<CellId>(cell));
  });
}

void require_valid_cells(const ZooMesh& mesh, double planarity) {
  const std::vector<CellId> invalid = invalid_cells(mesh, planarity);
  if (invalid.empty()) return;
  const Failures failures{invalid.size(), invalid.front()};
  throw InvalidCellError(
      cell_name(mesh, failures.first),
      fmt::format("{}{})", fault_of(mesh, failures.first, planarity), others(failures)));
}

VisibilityOrder without_cells(const VisibilityOrder& order, std::span<const CellId> cells) {
  const auto leave = [&](CellId cell) { return !std::ranges::binary_search(cells, cell); };
  std::vector<CellId> kept;
  std::vector<CellGroup> groups;
  auto group = order.groups.begin();
  const CellGroup* of_group = nullptr;  // the group whose remaining cells form the last of `groups`
  for (std::uint32_t rank = 0; rank < order.cells.size(); ++rank) {
    for (; group != order.groups.end() && rank >= group->first + group->count; ++group) {
    }
    if (!leave(order.cells[rank])) continue;
    if (group != order.groups.end() && rank >= group->first) {
      const bool known = !groups.empty() && of_group == &*group;
      if (!known) groups.push_back({static_cast<std::uint32_t>(kept.size()), 0});
      of_group = &*group;
      ++groups.back().count;
    }
    kept.push_back(order.cells[rank]);
  }
  std::erase_if(groups, [](const CellGroup& g) { return g.count < 2; });
  return {std::move(kept), std::move(groups), order.algorithm};
}

void check_renderable(const ZooMesh& mesh, const Scene& scene, InvalidCells invalid) {
  if (invalid == InvalidCells::refused) require_valid_cells(mesh, scene.render.planarity);
  if (scene.render.interpolation == Interpolation::polynomial)
    check_polynomials(mesh, scene.render.planarity, invalid == InvalidCells::skipped);
  std::set<std::string> fields;
  if (scene.volume.color) fields.insert(scene.volume.color->field);
  if (scene.volume.extinction) fields.insert(scene.volume.extinction->field);
  for (const Isosurface& surface : scene.isosurfaces) fields.insert(surface.field);
  if (scene.skin && scene.skin->color_by) fields.insert(scene.skin->color_by->field);
  for (const std::string& field : fields) {
    check_field(mesh, field);
    check_size(field, scalar_field(mesh, field).values.view());
  }
  check_brightness(mesh, scene);
}

}  // namespace hiac
