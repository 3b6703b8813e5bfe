#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A field in one cell as the polynomial in x, y and z that takes its values at the cell's nodes:
/// the interpolation functions of Williams, Max and Stein (1998), section 3 and appendix C, as many
/// monomials as nodes.
///
///     tetrahedron   1, x, y, z; all of degree 2; all of degree 3           (1), (3)
///     prism6        1, x, y, z, xz, yz                                     (13)
///     brick8        1, x, y, z, xy, xz, yz, xyz                            (2)
///     brick20       degree 2; x2y, x2z, xy2, xz2, y2z, yz2, xyz, x2yz, xy2z, xyz2   (14)
///
/// Tetrahedra with straight edges have their isoparametric interpolant; so do bricks and prisms
/// that lie along the axes (prisms along z). In all other cells the function is another one: it
/// depends on how the cell lies in the world, neighbours differ on the face between them, and it
/// does not exist where the nodes do not determine it (a square brick turned by 45 degrees: xy
/// vanishes at its nodes).
class WorldPolynomial {
 public:
  static constexpr std::size_t kMostTerms = 20;
  using Point = std::array<double, 3>;

  /// Whether the paper has a function for the kind.
  static bool exists(CellKind kind);

  /// Of the values at the nodes of a cell of such a kind; nothing where they do not determine it: a
  /// pivot of the normalised equations is below 1e-10.
  static std::optional<WorldPolynomial> through(const ZooMesh& mesh, CellId cell,
                                                std::span<const double> values);

  /// At a point relative to the cell's first node.
  [[nodiscard]] double at(const Point& point) const;
  [[nodiscard]] Point gradient(const Point& point) const;

  /// Numbers between which it stays in the cell.
  [[nodiscard]] double least() const { return c_[0] - reach_; }
  [[nodiscard]] double most() const { return c_[0] + reach_; }

 private:
  CellKind kind_{};
  // of the cell's box, from its first node; coordinates run from -1 to 1 in it
  Point middle_{}, half_{};
  std::array<double, kMostTerms> c_{};
  double reach_ = 0;
};

}  // namespace hiac
