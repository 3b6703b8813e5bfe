#include "formats/common/cells/face_cells.hpp"

#include <algorithm>
#include <set>

namespace hiac::formats {
namespace {

using Face = std::vector<std::int64_t>;
using Faces = std::span<const Face>;

Face turned(Face face) {
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

/// A face that begins with that node.
Face beginning_with(const Face& face, std::int64_t node) {
  Face result = face;
  std::rotate(result.begin(), std::find(result.begin(), result.end(), node), result.end());
  return result;
}

bool has(const Face& face, std::int64_t node) {
  return std::find(face.begin(), face.end(), node) != face.end();
}

/// The neighbour of `node` along an edge that is not in `base`; -1 when there is not exactly one.
std::int64_t partner(Faces faces, std::int64_t node, const Face& base) {
  std::int64_t found = -1;
  for (const Face& face : faces) {
    const auto at = std::find(face.begin(), face.end(), node);
    if (at == face.end()) continue;
    const auto i = static_cast<std::size_t>(at - face.begin());
    for (const std::size_t j : {(i + 1) % face.size(), (i + face.size() - 1) % face.size()}) {
      if (has(base, face[j]) || face[j] == found) continue;
      if (found >= 0) return -1;
      found = face[j];
    }
  }
  return found;
}

/// A base and the nodes above it.
std::optional<Face> with_partners(Faces faces, Face base, std::size_t above) {
  Face nodes = base;
  for (std::size_t i = 0; i < above; ++i) {
    const std::int64_t node = partner(faces, base[i], base);
    if (node < 0) return std::nullopt;
    nodes.push_back(node);
  }
  return nodes;
}

const Face* first_of_size(Faces faces, std::size_t size) {
  for (const Face& face : faces)
    if (face.size() == size) return &face;
  return nullptr;
}

/// Two triangles with one node in common, the wedge's node 6; they are 6 2 3 and 6 4 5.
std::optional<Face> wedge_nodes(Faces faces) {
  std::vector<const Face*> triangles;
  for (const Face& face : faces)
    if (face.size() == 3) triangles.push_back(&face);
  if (triangles.size() != 2) return std::nullopt;
  for (const std::int64_t shared : *triangles[0]) {
    if (!has(*triangles[1], shared)) continue;
    const Face a = beginning_with(*triangles[0], shared);
    const Face b = beginning_with(*triangles[1], shared);
    const std::int64_t zero = partner(faces, b[1], {shared, b[2]});
    const std::int64_t one = partner(faces, b[2], {shared, b[1]});
    if (zero < 0 || one < 0) return std::nullopt;
    return Face{zero, one, a[1], a[2], b[1], b[2], shared};
  }
  return std::nullopt;
}

/// The nodes in the order of the shape, as far as one face and its edges determine it.
std::optional<Face> numbered(Faces faces, CellShape shape) {
  const Face* triangle = first_of_size(faces, 3);
  const Face* quadrilateral = first_of_size(faces, 4);
  Face base;
  switch (shape) {
    case CellShape::tetrahedron:
    case CellShape::prism:
      base = *triangle;
      break;
    case CellShape::pyramid:
    case CellShape::brick:
      base = *quadrilateral;
      break;
    case CellShape::wedge:
      return wedge_nodes(faces);
  }
  // the zoo's base turns counter-clockwise seen from inside, except the prism's
  if (shape != CellShape::prism) std::reverse(base.begin(), base.end());
  const bool pointed = shape == CellShape::tetrahedron || shape == CellShape::pyramid;
  return with_partners(faces, base, pointed ? 1 : base.size());
}

bool has_faces(CellShape shape, const Face& nodes, Faces faces) {
  std::vector<Face> expected;
  for (const ShapeFace& face : topology_of(shape).faces) {
    Face polygon;
    for (std::size_t i = 0; i < face.corner_count; ++i) polygon.push_back(nodes[face.corners[i]]);
    expected.push_back(turned(std::move(polygon)));
  }
  std::vector<Face> found;
  for (const Face& face : faces) found.push_back(turned(face));
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  return expected == found;
}

}  // namespace

std::optional<FaceCell> cell_of_faces(Faces faces) {
  std::set<std::int64_t> distinct;
  std::size_t triangles = 0;
  for (const Face& face : faces) {
    if (face.size() < 3 || face.size() > 4) return std::nullopt;
    triangles += face.size() == 3 ? 1 : 0;
    distinct.insert(face.begin(), face.end());
  }
  for (std::size_t s = 0; s < kShapeCount; ++s) {
    const auto shape = static_cast<CellShape>(s);
    const auto& topology = topology_of(shape);
    const auto of_shape = static_cast<std::size_t>(
        std::count_if(topology.faces.begin(), topology.faces.end(),
                      [](const ShapeFace& face) { return face.corner_count == 3; }));
    if (topology.corner_count != distinct.size() || topology.faces.size() != faces.size() ||
        of_shape != triangles)
      continue;
    const auto nodes = numbered(faces, shape);
    if (!nodes || !has_faces(shape, *nodes, faces)) return std::nullopt;
    return FaceCell{kind_of(shape, CellOrder::linear), *nodes};
  }
  return std::nullopt;
}

}  // namespace hiac::formats
