#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "formats/mfem/mesh_file.hpp"

namespace hiac::formats::mfem {

/// A continuous space of some order: "H1_3D_P2", "Quadratic" ...
struct Space {
  int order = 0;
  /// Degrees of freedom inside edges are at Gauss-Lobatto points, not evenly spaced (of order 3).
  bool lobatto = false;
};

/// The H1 space that a collection's name says. Throws InputError(subject, ...) for other spaces
/// and orders above 3.
Space space_named(const std::string& collection, const std::string& subject);

/// Whether the name is of a space of values constant in every element.
bool is_piecewise_constant(const std::string& collection);

/// The degrees of freedom of every tetrahedron of a mesh, of a space of order 1 to 3.
class DofMap {
 public:
  DofMap(const MeshFile& mesh, const Space& space);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Of the element with that number: its vertices; two or one a zoo edge, from its first corner to
  /// its second; the faces' in the zoo's order.
  [[nodiscard]] std::vector<std::size_t> of(std::size_t element) const;

 private:
  const MeshFile& mesh_;
  Space space_;
  std::size_t size_ = 0;
  std::vector<std::size_t> edges_;  ///< by element, six each
  std::vector<std::size_t> faces_;  ///< by element, four each
  std::size_t first_edge_ = 0;
  std::size_t first_face_ = 0;
};

}  // namespace hiac::formats::mfem
