#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/common/io/text_cursor.hpp"

namespace hiac::formats::mfem {

/// The geometries of elements, with MFEM's numbers.
enum class Geometry : std::uint8_t {
  point,
  segment,
  triangle,
  square,
  tetrahedron,
  cube,
  prism,
  pyramid
};

struct Element {
  Geometry geometry;
  std::int64_t attribute;
  std::array<std::int64_t, 8> vertices{};
};

/// A grid function: its space, and its values by degree of freedom and component.
struct GridFunction {
  std::string collection;
  std::size_t components = 1;
  bool by_vdim = false;  ///< a tuple after the other
  std::vector<double> values;

  [[nodiscard]] std::size_t dofs() const { return values.size() / components; }
  [[nodiscard]] double value(std::size_t dof, std::size_t component) const {
    return by_vdim ? values[dof * components + component] : values[component * dofs() + dof];
  }
};

struct MeshFile {
  std::string path;
  std::vector<Element> elements;
  std::vector<std::array<double, 3>> vertices;  ///< empty when the nodes give the geometry
  std::size_t vertex_count = 0;
  bool refined = false;  ///< it may have hanging nodes
  GridFunction nodes;    ///< without values when the mesh is straight
  std::vector<std::string> notes;
};

std::size_t vertex_count(Geometry geometry);
std::string_view geometry_name(Geometry geometry);

/// Throws InputError with the line.
MeshFile read_mesh_file(TextCursor& text);
/// Reads from the line "FiniteElementSpace" on.
GridFunction read_grid_function(TextCursor& text);

}  // namespace hiac::formats::mfem
