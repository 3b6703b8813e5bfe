#include "formats/vtk/cell_types.hpp"

#include <array>

#include <fmt/format.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>

namespace hiac::formats::vtk {
namespace {

/// A VTK type with a number of nodes for which the zoo has a kind.
struct ConvertedType {
  int type;
  std::size_t nodes;
  CellKind kind;
  std::span<const std::uint8_t> permutation;
};

/// A voxel counts its nodes along x, then y, then z; a brick goes round its bottom and its top.
constexpr std::array<std::uint8_t, 8> kVoxel{0, 1, 3, 2, 4, 5, 7, 6};

// Lagrange and Bezier cells of order 1 are the linear cells, whose node order they share. Lagrange
// tetrahedra of order 2 and 3 have their edge nodes in the edges' order, each edge from its first
// corner to its second, and of order 3 then one node a face in the order of vtkTetra's faces, which
// is the zoo's. (Bezier cells of higher order are a different basis: not converted.)
constexpr std::array<ConvertedType, 20> kTypes{{
    {VTK_TETRA, 4, CellKind::tetrahedron4, {}},
    {VTK_VOXEL, 8, CellKind::brick8, kVoxel},
    {VTK_HEXAHEDRON, 8, CellKind::brick8, {}},
    {VTK_WEDGE, 6, CellKind::prism6, {}},
    {VTK_PYRAMID, 5, CellKind::pyramid5, {}},
    {VTK_QUADRATIC_TETRA, 10, CellKind::tetrahedron10, {}},
    {VTK_QUADRATIC_HEXAHEDRON, 20, CellKind::brick20, {}},
    {VTK_QUADRATIC_WEDGE, 15, CellKind::prism15, {}},
    {VTK_QUADRATIC_PYRAMID, 13, CellKind::pyramid13, {}},
    {VTK_LAGRANGE_TETRAHEDRON, 4, CellKind::tetrahedron4, {}},
    {VTK_LAGRANGE_TETRAHEDRON, 10, CellKind::tetrahedron10, {}},
    {VTK_LAGRANGE_TETRAHEDRON, 20, CellKind::tetrahedron20, {}},
    {VTK_LAGRANGE_HEXAHEDRON, 8, CellKind::brick8, {}},
    {VTK_LAGRANGE_WEDGE, 6, CellKind::prism6, {}},
    {VTK_LAGRANGE_PYRAMID, 5, CellKind::pyramid5, {}},
    {VTK_BEZIER_TETRAHEDRON, 4, CellKind::tetrahedron4, {}},
    {VTK_BEZIER_HEXAHEDRON, 8, CellKind::brick8, {}},
    {VTK_BEZIER_WEDGE, 6, CellKind::prism6, {}},
    {VTK_BEZIER_PYRAMID, 5, CellKind::pyramid5, {}},
    {VTK_CONVEX_POINT_SET, 4, CellKind::tetrahedron4, {}},
}};

/// Some files give linear types to cells with as many nodes as quadratic ones; VTK uses the first
/// nodes.
struct MisnamedType {
  int type;
  std::size_t nodes;
  CellKind kind;
};

constexpr std::array<MisnamedType, 6> kMisnamed{{
    {VTK_TETRA, 10, CellKind::tetrahedron4},
    {VTK_HEXAHEDRON, 20, CellKind::brick8},
    {VTK_HEXAHEDRON, 27, CellKind::brick8},
    {VTK_WEDGE, 15, CellKind::prism6},
    {VTK_WEDGE, 18, CellKind::prism6},
    {VTK_PYRAMID, 13, CellKind::pyramid5},
}};

/// A VTK type whose first nodes are the corners of a shape, and which has more nodes than these but
/// not as many as one of the zoo's kinds.
struct CorneredType {
  int type;
  CellShape shape;
  bool any_order;  ///< any number of nodes from the corners on
};

constexpr std::array<CorneredType, 19> kCornered{{
    {VTK_TETRA, CellShape::tetrahedron, false},
    {VTK_VOXEL, CellShape::brick, false},
    {VTK_HEXAHEDRON, CellShape::brick, false},
    {VTK_WEDGE, CellShape::prism, false},
    {VTK_PYRAMID, CellShape::pyramid, false},
    {VTK_QUADRATIC_TETRA, CellShape::tetrahedron, false},
    {VTK_QUADRATIC_HEXAHEDRON, CellShape::brick, false},
    {VTK_QUADRATIC_WEDGE, CellShape::prism, false},
    {VTK_QUADRATIC_PYRAMID, CellShape::pyramid, false},
    {VTK_TRIQUADRATIC_HEXAHEDRON, CellShape::brick, true},
    {VTK_TRIQUADRATIC_PYRAMID, CellShape::pyramid, true},
    {VTK_QUADRATIC_LINEAR_WEDGE, CellShape::prism, true},
    {VTK_BIQUADRATIC_QUADRATIC_WEDGE, CellShape::prism, true},
    {VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, CellShape::brick, true},
    {VTK_LAGRANGE_TETRAHEDRON, CellShape::tetrahedron, true},
    {VTK_LAGRANGE_HEXAHEDRON, CellShape::brick, true},
    {VTK_LAGRANGE_WEDGE, CellShape::prism, true},
    {VTK_LAGRANGE_PYRAMID, CellShape::pyramid, true},
    {VTK_BEZIER_TETRAHEDRON, CellShape::tetrahedron, true},
}};

bool has_no_volume(int type) {
  switch (type) {
    case VTK_EMPTY_CELL:
    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_TRIANGLE:
    case VTK_TRIANGLE_STRIP:
    case VTK_POLYGON:
    case VTK_PIXEL:
    case VTK_QUAD:
    case VTK_QUADRATIC_EDGE:
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_POLYGON:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_CUBIC_LINE:
    case VTK_PARAMETRIC_CURVE:
    case VTK_PARAMETRIC_SURFACE:
    case VTK_PARAMETRIC_TRI_SURFACE:
    case VTK_PARAMETRIC_QUAD_SURFACE:
    case VTK_HIGHER_ORDER_EDGE:
    case VTK_HIGHER_ORDER_TRIANGLE:
    case VTK_HIGHER_ORDER_QUAD:
    case VTK_HIGHER_ORDER_POLYGON:
    case VTK_LAGRANGE_CURVE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_CURVE:
    case VTK_BEZIER_TRIANGLE:
    case VTK_BEZIER_QUADRILATERAL:
      return true;
    default:
      return false;
  }
}

}  // namespace

CellConversion conversion_of(int type, std::size_t nodes) {
  for (const ConvertedType& known : kTypes)
    if (known.type == type && known.nodes == nodes)
      return {CellFate::converted, known.kind, known.permutation, std::nullopt, false};
  for (const MisnamedType& known : kMisnamed)
    if (known.type == type && known.nodes == nodes)
      return {CellFate::converted, known.kind, {}, std::nullopt, true};
  if (has_no_volume(type)) return {CellFate::no_volume, {}, {}, std::nullopt, false};
  for (const CorneredType& known : kCornered) {
    if (known.type != type) continue;
    const CellKind corners = kind_of(known.shape, CellOrder::linear);
    if (!known.any_order || nodes < corner_count(corners))
      return {CellFate::wrong, {}, {}, std::nullopt, false};
    return {CellFate::unsupported, {}, {}, corners, false};
  }
  return {CellFate::unsupported, {}, {}, std::nullopt, false};
}

std::string cell_type_name(int type) {
  // "vtkQuadraticTetra"; VTK calls types that it does not know "UnknownClass"
  const std::string name = vtkCellTypes::GetClassNameFromTypeId(type);
  return name.starts_with("vtk") ? name.substr(3) : fmt::format("type {}", type);
}

}  // namespace hiac::formats::vtk
