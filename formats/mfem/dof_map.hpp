#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/mfem/mesh_file.hpp"

namespace hiac::formats::mfem {

/// A continuous space of some order: "H1_3D_P2", "Quadratic" ...
struct Space {
  int order = 0;
  /// Degrees of freedom are at Gauss-Lobatto points, not evenly spaced (they are the same up to
  /// order 2).
  bool lobatto = false;
  /// The interior of a pyramid has (order - 1)^3 points, on a grid that narrows towards the apex
  /// (Fuentes et al. 2015, MFEM's default), and not the fewer of Bergot et al. (2010).
  bool narrowing = false;
  /// Degrees of freedom are the weights of Bernstein's polynomials, not values at points.
  bool bernstein = false;
};

/// The H1 space with a collection's name; none for other spaces and for orders above 8.
std::optional<Space> space_named(const std::string& collection);

/// Whether that is the name of a space of functions that are constant in every element.
bool is_piecewise_constant(const std::string& collection);

/// A point of an element: its coordinates along the element's axes, from 0 to the order, and the
/// corner, edge, face or interior that it belongs to.
struct LatticePoint {
  enum class Part : std::uint8_t { corner, edge, face, inside };
  std::array<int, 3> place;
  Part part;
  std::size_t number;  ///< of the corner, edge or face; in the interior, of the point
  /// The first two coordinates are along axes that narrow towards a pyramid's apex, as the section
  /// at the point's height does (Space::narrowing).
  bool narrowing = false;
};

/// The points of an element of that space: its corners in MFEM's order, then those of edges, of
/// faces and of the interior. The edges and faces of a tetrahedron are in the zoo's order.
std::vector<LatticePoint> lattice_points(Geometry geometry, const Space& space);

/// The position of an evenly spaced point in the reference cell.
std::array<double, 3> position_of(const LatticePoint& point, int order);

/// Whether elements of a geometry can be of that space: cubes up to order 8, tetrahedra and prisms
/// up to 3, pyramids up to 2 (and with Bernstein's polynomials of order 1).
bool can_be_of(Geometry geometry, const Space& space);

/// The degrees of freedom of a continuous space on every element of a mesh.
class DofMap {
 public:
  /// All geometries in the mesh must allow the space's order (can_be_of).
  DofMap(const MeshFile& mesh, const Space& space);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// The degrees of freedom of the element with that number, at its lattice_points. Throws
  /// InputError naming the mesh's file when they cannot be told, as the element has a vertex twice.
  [[nodiscard]] std::vector<std::size_t> of(std::size_t element) const;

 private:
  /// A face: its vertices as in the first element that has it, and its first degree of freedom.
  struct Face {
    std::array<std::int64_t, 4> vertices;
    std::size_t first;
  };
  [[nodiscard]] std::size_t on_edge(const Element& element, std::size_t edge,
                                    const LatticePoint& point,
                                    const std::array<std::size_t, 12>& edges) const;
  [[nodiscard]] std::size_t on_face(std::size_t element, const LatticePoint& point) const;

  const MeshFile& mesh_;
  int order_;
  std::size_t size_ = 0;
  std::vector<std::array<std::size_t, 12>> edges_;  ///< by element
  std::vector<std::array<std::size_t, 6>> faces_;   ///< by element, places in all_faces_
  std::vector<Face> all_faces_;
  std::vector<std::size_t> inside_;  ///< by element, the first inside
  std::size_t first_edge_ = 0;
  std::array<std::vector<LatticePoint>, 8> points_;  ///< by geometry
};

}  // namespace hiac::formats::mfem
