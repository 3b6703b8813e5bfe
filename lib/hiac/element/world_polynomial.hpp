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
/// For the kinds for which Williams, Max and Stein (1998), section 3 and appendix C, list
/// monomials, as many as nodes, it is a sum of these:
///
///     tetrahedron   1, x, y, z; all of degree 2; all of degree 3           (1), (3)
///     prism6        1, x, y, z, xz, yz                                     (13)
///     brick8        1, x, y, z, xy, xz, yz, xyz                            (2)
///     brick20       degree 2; x2y, x2z, xy2, xz2, y2z, yz2, xyz, x2yz, xy2z, xyz2   (14)
///
/// For all other kinds (pyramids, wedges, prisms of order 2 and 3, cubic bricks) it is the least
/// interpolant (least_interpolant.hpp), which contains all polynomials of complete_degree. Its
/// degree is 2 in pyramid5 and wedge7, 3 in pyramid13 and prism15, 3 or 4 in wedge18, and at most 5
/// in the others.
///
/// The function equals the isoparametric interpolant in tetrahedra with straight edges, in bricks
/// and prisms of the paper's kinds that lie along the axes (prisms along z), and in affine cells of
/// the other kinds. In all other cells it differs from that interpolant, and neighbours differ on
/// the face between them. The paper's function depends on the orientation of the cell in the world,
/// and does not exist if the nodes do not determine it (a square brick turned by 45 degrees: xy
/// vanishes at its nodes); the least interpolant moves with the cell. It is not used as a
/// substitute where the paper's function does not exist: for bricks turned by slightly less that
/// function exists, with values far beyond those at the nodes, so that the quality of a picture
/// would depend on the orientation of single cells.
class WorldPolynomial {
 public:
  static constexpr std::size_t kMostTerms = LeastInterpolant::kMostTerms;
  using Point = std::array<double, 3>;

  /// Whether the paper lists monomials for the kind.
  static bool is_of_paper(CellKind kind);

  /// The degree up to which the function reproduces all polynomials: the kind's order, but 2 for
  /// pyramid21 and prism24, at whose nodes some cubic polynomials vanish.
  static std::size_t complete_degree(CellKind kind);

  /// The polynomial through the values at the nodes of a cell. Nothing if the nodes do not
  /// determine it: for the paper's kinds, if a pivot of the normalised equations is below 1e-10;
  /// for the others, if nodes coincide or all lie in a plane.
  static std::optional<WorldPolynomial> through(const ZooMesh& mesh, CellId cell,
                                                std::span<const double> values);

  /// The value at a point, which is relative to the cell's first node.
  [[nodiscard]] double at(const Point& point) const;
  [[nodiscard]] Point gradient(const Point& point) const;

  /// A bound of the degree of its monomials, and of its degree along a line.
  [[nodiscard]] std::size_t degree() const { return degree_; }

  /// Bounds of its values in the cell.
  [[nodiscard]] double least() const { return c_[0] - reach_; }
  [[nodiscard]] double most() const { return c_[0] + reach_; }

 private:
  [[nodiscard]] Point in_box(const Point& point) const;
  bool set_paper(CellKind kind, std::span<const Point> nodes, std::span<const double> values);
  bool set_least(CellKind kind, std::span<const Point> nodes, std::span<const double> values);

  std::span<const Exponents> terms_;
  std::size_t degree_ = 0;
  // origin and rows of a map to coordinates that stay within [-1, 1] in the cell
  Point origin_{};
  std::array<Point, 3> to_box_{};
  std::array<double, kMostTerms> c_{};
  double reach_ = 0;
};

}  // namespace hiac
