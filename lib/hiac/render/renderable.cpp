#include "hiac/render/renderable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/order/behind_relation.hpp"
#include "hiac/render/cell_field.hpp"

namespace hiac {
namespace {

constexpr std::size_t kGrain = std::size_t{1} << 14;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

// How many items fail a test, and the first of them.
struct Failures {
  std::size_t count = 0, first = kNone;
};

template <typename Fails>
Failures count_failures(std::size_t count, const Fails& fails) {
  Failures all;
  std::mutex mutex;
  parallel_for(count, kGrain, [&](IndexRange range) {
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

// What there is more of than the one that is named.
std::string others(const Failures& failures) {
  return failures.count == 1 ? "" : fmt::format("; {} cells in all", failures.count);
}

void check_scene(const Scene& scene) {
  if (scene.render.interpolation != Interpolation::isoparametric)
    throw InputError(
        "key `render.interpolation`: this version interpolates \"isoparametric\" alone");
}

// edge_deviation of a cell of the mesh.
double deviation_of_edges(const ZooMesh& mesh, std::size_t cell) {
  return edge_deviation(mesh.kinds[cell], cell_positions(mesh, static_cast<CellId>(cell)));
}

void check_edges(const ZooMesh& mesh, double straightness) {
  const Failures failures = count_failures(mesh.cell_count(), [&](std::size_t cell) {
    return !(deviation_of_edges(mesh, cell) <= straightness);
  });
  if (failures.count == 0) return;
  throw InputError(
      cell_name(mesh, failures.first),
      fmt::format("edges are curved: nodes between corners are off their places on straight edges "
                  "(by at most {:g} of the cell's size expected, `render.planarity`, {:g} found{}; "
                  "convert with --corners-only to neglect the nodes between corners)",
                  straightness, deviation_of_edges(mesh, failures.first), others(failures)));
}

// The largest deviation of a cell's quadrilateral faces from planes.
double largest_deviation(const ZooMesh& mesh, std::size_t cell) {
  const auto nodes = mesh.cell_nodes(static_cast<CellId>(cell));
  double largest = 0;
  for (const ShapeFace& face : topology_of(mesh.kinds[cell]).faces) {
    if (face.corner_count != 4) continue;
    const auto at = [&](std::size_t k) { return mesh.position(nodes[face.corners[k]]); };
    largest = std::max(largest, quadrilateral_deviation(at(0), at(1), at(2), at(3)));
  }
  return largest;
}

void check_faces(const ZooMesh& mesh, double planarity) {
  const Failures failures = count_failures(mesh.cell_count(), [&](std::size_t cell) {
    return !(largest_deviation(mesh, cell) <= planarity);
  });
  if (failures.count == 0) return;
  throw InputError(
      cell_name(mesh, failures.first),
      fmt::format("a quadrilateral face is not planar (deviation of at most {:g} of its size "
                  "expected, `render.planarity`, {:g} found{})",
                  planarity, largest_deviation(mesh, failures.first), others(failures)));
}

// For every corner of a shape, the corners at the other ends of its edges, in turn around it, seen
// alike from all corners.
struct CornerFan {
  std::size_t count = 0;
  std::array<std::uint8_t, 4> neighbors{};
};
using ShapeFans = std::array<CornerFan, 8>;

constexpr ShapeFans make_fans(CellShape shape) {
  ShapeFans fans{};
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    // every face at the corner leads from the neighbour after it to the one before it
    std::array<std::uint8_t, 8> next{};
    std::uint8_t start = 0;
    for (const ShapeFace& face : topology_of(shape).faces)
      for (std::size_t k = 0; k < face.corner_count; ++k) {
        if (face.corners[k] != corner) continue;
        start = face.corners[(k + 1) % face.corner_count];
        next[start] = face.corners[(k + face.corner_count - 1) % face.corner_count];
      }
    CornerFan& fan = fans[corner];
    std::uint8_t at = start;
    do {
      fan.neighbors[fan.count++] = at;
      at = next[at];
    } while (at != start);
  }
  return fans;
}

constexpr std::array<ShapeFans, kShapeCount> kFans{
    make_fans(CellShape::tetrahedron), make_fans(CellShape::pyramid), make_fans(CellShape::prism),
    make_fans(CellShape::wedge), make_fans(CellShape::brick)};

// Whether the cell's surface turns the other way at some corners than at others (the Jacobian
// changes its sign). A closed surface with convex planar faces that turns the same way at all
// corners bounds a convex body. Three edges in a plane turn no way.
bool turns_both_ways(const ZooMesh& mesh, std::size_t cell, double planarity) {
  const CellShape shape = shape_of(mesh.kinds[cell]);
  if (shape == CellShape::tetrahedron) return false;
  const auto nodes = mesh.cell_nodes(static_cast<CellId>(cell));
  bool left = false, right = false;
  for (std::size_t corner = 0; corner < topology_of(shape).corner_count; ++corner) {
    const CornerFan& fan = kFans[static_cast<std::size_t>(shape)][corner];
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

void check_convexity(const ZooMesh& mesh, double planarity) {
  const Failures failures = count_failures(mesh.cell_count(), [&](std::size_t cell) {
    return turns_both_ways(mesh, cell, planarity) || has_bent_face(mesh, cell, planarity);
  });
  if (failures.count == 0) return;
  throw InputError(cell_name(mesh, failures.first),
                   fmt::format("the cell is not convex, or turned inside out in part (corners that "
                               "all turn one way expected, both ways found{})",
                               others(failures)));
}

// The cells' values of a field, by entry of ZooMesh::nodes (nodes and corners) or by cell.
void check_field(const ZooMesh& mesh, const std::string& name) {
  const Field field = scalar_field(mesh, name);
  const auto values = field.values.view();
  const auto bad = [&](std::size_t i) { return !std::isfinite(values[i]); };
  Failures failures = count_failures(values.size(), bad);
  if (failures.count == 0) return;
  if (field.location == FieldLocation::node) {
    // nodes of no cell may hold anything
    std::vector<std::uint8_t> used(mesh.node_count(), 0);
    for (const NodeId node : mesh.nodes) used[node] = 1;
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

}  // namespace

void check_renderable(const ZooMesh& mesh, const Scene& scene) {
  check_scene(scene);
  check_edges(mesh, scene.render.planarity);
  check_faces(mesh, scene.render.planarity);
  check_convexity(mesh, scene.render.planarity);
  std::set<std::string> fields;
  if (scene.volume.color) fields.insert(scene.volume.color->field);
  if (scene.volume.extinction) fields.insert(scene.volume.extinction->field);
  for (const Isosurface& surface : scene.isosurfaces) fields.insert(surface.field);
  for (const std::string& field : fields) check_field(mesh, field);
}

}  // namespace hiac
