#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "hiac/element/least_interpolant.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// A field in one cell as a polynomial in x, y and z that takes its values at the cell's nodes.
///
/// Where Williams, Max and Stein (1998), section 3 and appendix C, list monomials for the kind, as
/// many as nodes, it is the sum of these:
///
///     tetrahedron   1, x, y, z; all of degree 2; all of degree 3           (1), (3)
///     prism6        1, x, y, z, xz, yz                                     (13)
///     brick8        1, x, y, z, xy, xz, yz, xyz                            (2)
///     brick20       degree 2; x2y, x2z, xy2, xz2, y2z, yz2, xyz, x2yz, xy2z, xyz2   (14)
///
/// In all other kinds (pyramids, wedges, prisms of order 2 and 3, cubic bricks) it is the least
/// interpolant (least_interpolant.hpp) with all polynomials of complete_degree, of degree 2 in
/// pyramid5 and wedge7, 3 in pyramid13 and prism15, 3 or 4 in wedge18, 5 at most in the others.
///
/// Tetrahedra with straight edges have their isoparametric interpolant; so do bricks and prisms of
/// the paper's kinds that lie along the axes (prisms along z), and affine ones of the others. In
/// all other cells the function is another one, and neighbours differ on the face between them. The
/// paper's depends on how the cell lies in the world, and does not exist where the nodes do not
/// determine it (a square brick turned by 45 degrees: xy vanishes at its nodes); the least
/// interpolant goes with the cell. It does not stand in for the paper's: turned by a little less
/// such bricks have the paper's function, of values far beyond those at the nodes, so that a mesh
/// would be drawn well or badly by how single cells lie.
class WorldPolynomial {
 public:
  static constexpr std::size_t kMostTerms = LeastInterpolant::kMostTerms;
  using Point = std::array<double, 3>;

  /// Whether the paper lists monomials for the kind.
  static bool is_of_paper(CellKind kind);

  /// The degree up to which it has all polynomials: the kind's order, but 2 for pyramid21 and
  /// prism24, at whose nodes some cubic polynomials vanish.
  static std::size_t complete_degree(CellKind kind);

  /// Of the values at the nodes of a cell. Nothing where these do not determine it: a pivot of the
  /// normalised equations of the paper's kinds is below 1e-10; nodes of another cell coincide, or
  /// all lie in a plane.
  static std::optional<WorldPolynomial> through(const ZooMesh& mesh, CellId cell,
                                                std::span<const double> values);

  /// At a point relative to the cell's first node.
  [[nodiscard]] double at(const Point& point) const;
  [[nodiscard]] Point gradient(const Point& point) const;

  /// Of none of its monomials is the degree greater; nor is it along a line.
  [[nodiscard]] std::size_t degree() const { return degree_; }

  /// Numbers between which it stays in the cell.
  [[nodiscard]] double least() const { return c_[0] - reach_; }
  [[nodiscard]] double most() const { return c_[0] + reach_; }

 private:
  [[nodiscard]] Point in_box(const Point& point) const;
  bool set_paper(CellKind kind, std::span<const Point> nodes, std::span<const double> values);
  bool set_least(CellKind kind, std::span<const Point> nodes, std::span<const double> values);

  std::span<const Exponents> terms_;
  std::size_t degree_ = 0;
  // what becomes 0, and rows of a map to coordinates that run from -1 to 1 in the cell at most
  Point origin_{};
  std::array<Point, 3> to_box_{};
  std::array<double, kMostTerms> c_{};
  double reach_ = 0;
};

}  // namespace hiac
