// Blocks of all kinds of cells that touch in a common plane, each with nodes of its own there that
// are moved within the plane: every ray that passes through a point of both faces leaves the one
// cell there and enters the other.

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/order/gaps/gap_relation.hpp"
#include "hiac/order/verify_order.hpp"
#include "hiac/order/visibility_order.hpp"
#include "tests/order/brute_force_order.hpp"
#include "tests/order/order_meshes.hpp"
#include "tests/render/truth/general_meshes.hpp"
#include "tests/support/instrumented.hpp"

namespace hiac::test {
namespace {

constexpr double kPlanarity = 1e-10;
constexpr double kUlp = -1;  // an offset of one unit in the last place

ZooMesh block_of(CellKind kind) {
  const ZooMesh linear = [&] {
    switch (shape_of(kind)) {
      case CellShape::tetrahedron:
        return structured(2, Cut::tetrahedra);
      case CellShape::pyramid:
        return structured(1, Cut::pyramids);
      case CellShape::prism:
        return structured(2, Cut::prisms);
      case CellShape::wedge:
        return wedge_grid(2);
      case CellShape::brick:
        break;
    }
    return structured(2, Cut::bricks);
  }();
  return hiac::order_of(kind) == CellOrder::linear ? linear
                                                   : of_order(linear, hiac::order_of(kind));
}

double off_by(double x, double offset, double along) {
  if (offset == kUlp) return std::nextafter(x, along < 0 ? -2 : 2);
  return x + offset * along;
}

// What is moved of a block's rim: nodes along it, or so that it bulges.
enum class Rim { straight, bulging };

// The block with the nodes in the plane z = `height` moved within it: those that are no corners,
// and corners inside the block's outline. The plane comes to lie at z = 0.
ZooMesh slid_block(CellKind kind, double height, double offset, std::uint64_t seed,
                   Rim rim = Rim::straight) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle(0, 6.28);
  const ZooMesh block = block_of(kind);
  std::vector<bool> is_corner(block.node_count(), false);
  for (CellId cell = 0; cell < block.cell_count(); ++cell)
    for (const NodeId node : block.cell_nodes(cell).first(corner_count(block.kinds[cell])))
      is_corner[node] = true;
  std::size_t node = 0;
  return moved(block, [&](const Position& p) -> Position {
    const double turn = angle(random);
    const bool inside = p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1;
    const bool moves = p[2] == height && (inside || !is_corner[node]);
    ++node;
    if (!moves || offset == 0) return {p[0], p[1], p[2] - height};
    const auto slid = [&](double x, double along) {
      const bool on_rim = x == 0 || x == 1;
      return on_rim && rim == Rim::straight ? x : off_by(x, offset, along);
    };
    return {slid(p[0], std::cos(turn)), slid(p[1], std::sin(turn)), 0};
  });
}

// A face in the plane z = 0: its points by two numbers in [0, 1], for triangles of a sum up to 1.
struct ContactFace {
  CellId cell;
  CellKind kind;
  std::size_t corners;
  std::vector<Position> nodes;                  // of the cell
  std::array<std::array<double, 3>, 4> places;  // of the corners, reference coordinates

  [[nodiscard]] Position point(double u, double v) const {
    std::array<double, 3> at{};
    for (std::size_t c = 0; c < 3; ++c)
      at[c] = corners == 3 ? (1 - u - v) * places[0][c] + u * places[1][c] + v * places[2][c]
                           : (1 - v) * ((1 - u) * places[0][c] + u * places[1][c]) +
                                 v * ((1 - u) * places[3][c] + u * places[2][c]);
    std::array<double, kMaxNodesPerCell> shape;
    shape_functions<double>(kind, at, shape);
    Position p{};
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) p[c] += shape[k] * nodes[k][c];
    return p;
  }
  [[nodiscard]] bool inside(double u, double v, double margin) const {
    return u > margin && v > margin &&
           (corners == 3 ? u + v < 1 - margin : u < 1 - margin && v < 1 - margin);
  }
  // Whether a point of the plane is well inside, by Newton's iteration.
  [[nodiscard]] bool holds(const Position& p) const {
    double u = 0.4, v = 0.4;
    for (int step = 0; step < 30; ++step) {
      constexpr double kStep = 1e-5;
      const Position at = point(u, v), by_u = point(u + kStep, v), by_v = point(u, v + kStep);
      const double a = (by_u[0] - at[0]) / kStep, b = (by_v[0] - at[0]) / kStep;
      const double c = (by_u[1] - at[1]) / kStep, d = (by_v[1] - at[1]) / kStep;
      const double x = p[0] - at[0], y = p[1] - at[1], determinant = a * d - b * c;
      if (std::abs(x) + std::abs(y) < 1e-9) return inside(u, v, 1e-4);
      u += (d * x - b * y) / determinant;
      v += (a * y - c * x) / determinant;
      if (!(std::abs(u) + std::abs(v) < 50)) return false;
    }
    return false;
  }
};

std::vector<ContactFace> contact_faces(const ZooMesh& mesh) {
  std::vector<ContactFace> faces;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    for (const ShapeFace& shape : topology_of(mesh.kinds[cell]).faces) {
      ContactFace face{cell, mesh.kinds[cell], shape.corner_count, {}, {}};
      bool in_plane = true;
      for (const NodeId node : mesh.cell_nodes(cell)) {
        const auto p = mesh.position(node);
        face.nodes.push_back({p[0], p[1], p[2]});
      }
      for (std::size_t k = 0; k < shape.corner_count; ++k) {
        in_plane = in_plane && face.nodes[shape.corners[k]][2] == 0;
        face.places[k] = reference_nodes(face.kind)[shape.corners[k]];
      }
      if (in_plane) faces.push_back(std::move(face));
    }
  return faces;
}

// Every pair of a cell of the lower block and one of the upper (its number in its own block) whose
// faces have points in common.
Arrows contacts(const ZooMesh& lower, const ZooMesh& upper) {
  Arrows pairs;
  for (const ContactFace& f : contact_faces(lower))
    for (const ContactFace& g : contact_faces(upper)) {
      bool meet = false;
      for (double u = 0.05; u < 1; u += 0.15)
        for (double v = 0.05; v < 1; v += 0.15)
          meet = meet || (f.inside(u, v, 0.01) && g.holds(f.point(u, v)));
      if (meet) pairs.emplace_back(f.cell, g.cell);
    }
  return pairs;
}

using Map = std::function<Position(const Position&)>;

struct ContactView {
  NamedView named;
  int from;  // -1: the eye is below the plane z = 0, 1: above
};

std::vector<ContactView> contact_views() {
  std::vector<ContactView> views;
  for (const int side : {-1, 1}) {
    const double s = side;
    views.push_back({along("straight", {0, 0, -s}), side});
    views.push_back({along("oblique", {0.3, 0.2, -s}), side});
    views.push_back({along("grazing", {1, 0.3, -1e-3 * s}), side});
    views.push_back({from_eye("outside", {0.4, 0.3, 3 * s}), side});
    views.push_back({from_eye("beside", {-2.4, 0.3, 0.2 * s}), side});
    views.push_back({from_eye("inside", {0.31, 0.37, 0.4 * s}), side});
  }
  return views;
}

View mapped(const View& view, const Map& map) {
  View there = view;
  there.eye = map(view.eye);
  const Position tip = map(view.direction), origin = map({0, 0, 0});
  for (std::size_t c = 0; c < 3; ++c) there.direction[c] = tip[c] - origin[c];
  return there;
}

Position stay(const Position& p) { return p; }
Position permuted(const Position& p) { return {p[2], -p[0], p[1]}; }

// Arrows between the blocks.
struct Tally {
  std::size_t along = 0, against = 0;  // the rays
};

// Contacts are crossed from the eye's side. (Faces that touch along curved edges alone may have an
// arrow against the rays: that of the hulls that stand for them.)
void expect_crossed(const ZooMesh& mesh, CellId lower_cells, const Arrows& pairs,
                    const ContactView& contact, const Map& map, Tally& tally) {
  const View view = mapped(contact.named.view, map);
  const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  const GapRelation relation = gap_relation(basis, view, kPlanarity);
  const bool lower_first = contact.from < 0;
  for (CellId front = 0; front < mesh.cell_count(); ++front)
    for (const CellId behind : relation.behind_cell(front)) {
      if ((front < lower_cells) == (behind < lower_cells)) continue;
      ++((front < lower_cells) == lower_first ? tally.along : tally.against);
    }
  const auto rank = group_ranks(exact_order(basis, view, kPlanarity).order);
  for (const auto& [lower, upper] : pairs) {
    const CellId above = lower_cells + upper;
    const CellId front = lower_first ? lower : above, behind = lower_first ? above : lower;
    const auto to = relation.behind_cell(front);
    ASSERT_TRUE(std::ranges::find(to, behind) != to.end()) << front << " " << behind;
    ASSERT_LE(rank[front], rank[behind]) << front << " " << behind;
  }
}

TEST(SlidingContact, IsCrossedFromTheEyesSide) {
  const std::vector<CellKind> kinds{
      CellKind::tetrahedron4, CellKind::brick8,  CellKind::tetrahedron10, CellKind::tetrahedron20,
      CellKind::brick20,      CellKind::prism15, CellKind::wedge18,       CellKind::pyramid13};
  const auto views = contact_views();
  std::size_t which = 0;
  Tally tally;
  for (const CellKind lower_kind : kinds)
    for (const CellKind upper_kind : kinds)
      for (const double offset : {0.0, kUlp, 1e-12, 1e-10, 1e-8, 1e-5, 1e-2}) {
        if (kInstrumented && ++which % 16 != 0) continue;
        SCOPED_TRACE(std::string(kind_name(lower_kind)) + " below " +
                     std::string(kind_name(upper_kind)) + ", off by " + fmt::format("{}", offset));
        const ZooMesh lower = slid_block(lower_kind, 1, offset, 1);
        const ZooMesh upper = slid_block(upper_kind, 0, offset, 2);
        const Arrows pairs = contacts(lower, upper);
        ASSERT_GE(pairs.size(), 1U);
        const auto cells = static_cast<CellId>(lower.cell_count());
        const ZooMesh mesh = side_by_side(lower, upper);
        for (const auto& [name, map] : {std::pair<std::string, Map>{"as it is", stay},
                                        {"permuted", permuted},
                                        {"turned", turned}}) {
          const ZooMesh there = moved(mesh, map);
          for (std::size_t v = 0; v < views.size(); ++v) {
            // each view with every seventh mesh
            if ((which + v) % 7 != 0 && name != "as it is") continue;
            SCOPED_TRACE(name + ", " + views[v].named.name + " " + std::to_string(views[v].from));
            expect_crossed(there, cells, pairs, views[v], map, tally);
            if (testing::Test::HasFatalFailure()) return;
          }
        }
        ++which;
      }
  EXPECT_LT(1000 * tally.against, tally.along);
}

// Rims that bulge over those of the other block.
TEST(SlidingContact, BulgingRimsAreInOrder) {
  Tally tally;
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::brick20, CellKind::tetrahedron20})
    for (const double offset : {kUlp, 1e-8, 1e-2}) {
      SCOPED_TRACE(fmt::format("{}, off by {}", kind_name(kind), offset));
      const ZooMesh lower = slid_block(CellKind::tetrahedron10, 1, offset, 1, Rim::bulging);
      const ZooMesh upper = slid_block(kind, 0, offset, 2, Rim::bulging);
      const Arrows pairs = contacts(lower, upper);
      const auto cells = static_cast<CellId>(lower.cell_count());
      for (const ContactView& view : contact_views()) {
        SCOPED_TRACE(fmt::format("{} {}", view.named.name, view.from));
        expect_crossed(side_by_side(lower, upper), cells, pairs, view, stay, tally);
      }
    }
}

// Every lower cell before or after every upper one, which is right or wrong as a whole.
VisibilityOrder blocks_in_order(const ZooMesh& mesh, const View& view, CellId lower_cells,
                                bool lower_first) {
  const VisibilityOrder exact =
      exact_order(order_basis(mesh, build_face_adjacency(mesh)), view, kPlanarity).order;
  std::vector<CellId> cells(exact.cells.begin(), exact.cells.end());
  std::ranges::stable_partition(cells,
                                [&](CellId cell) { return (cell < lower_cells) == lower_first; });
  return {std::move(cells), {}, exact.algorithm};
}

// How many of the wrong pairs that are named are of both blocks. (A block's own cycles are no
// groups in these orders, and wrong.)
std::size_t across(const OrderCheck& check, CellId lower_cells) {
  return static_cast<std::size_t>(std::ranges::count_if(check.wrong, [&](const auto& pair) {
    return (pair.first < lower_cells) != (pair.second < lower_cells);
  }));
}

TEST(SlidingContact, AWrongOrderIsFound) {
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::tetrahedron20, CellKind::brick20,
                              CellKind::prism15, CellKind::pyramid13}) {
    for (const double offset : {1e-8, 1e-3}) {
      SCOPED_TRACE(fmt::format("{} {}", kind_name(kind), offset));
      const ZooMesh lower = slid_block(CellKind::brick8, 1, 0, 1);
      const auto cells = static_cast<CellId>(lower.cell_count());
      const ZooMesh mesh = side_by_side(lower, slid_block(kind, 0, offset, 2));
      const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
      for (const View& view : {along("", {0.3, 0.2, 1}).view, from_eye("", {0.4, 0.3, -3}).view}) {
        const OrderCheck right =
            verify_pairs(mesh, view, blocks_in_order(mesh, view, cells, true), kPlanarity);
        EXPECT_EQ(right.wrong_count, 0U);
        EXPECT_EQ(right.left_out, 0U);
        const VisibilityOrder backwards = blocks_in_order(mesh, view, cells, false);
        const OrderCheck wrong = verify_pairs(mesh, view, backwards, kPlanarity);
        EXPECT_GE(across(wrong, cells), 4U);
        EXPECT_FALSE(verify_order(basis, view, backwards, kPlanarity).right());
        EXPECT_TRUE(
            verify_order(basis, view, exact_order(basis, view, kPlanarity).order, kPlanarity)
                .right());
      }
    }
  }
}

// A tetrahedron with edges so curved that nothing is left of it but what its arrows say.
TEST(SlidingContact, CellsLeftOutAreCheckedByTheirArrows) {
  const ZooMesh lower = slid_block(CellKind::brick8, 1, 0, 1);
  const auto cells = static_cast<CellId>(lower.cell_count());
  const ZooMesh upper =
      moved(slid_block(CellKind::tetrahedron10, 0, 1e-8, 2), [](const Position& p) -> Position {
        return {p[0] + 0.6 * p[2] * p[2], p[1], p[2]};
      });
  const ZooMesh mesh = side_by_side(lower, upper);
  const OrderBasis basis = order_basis(mesh, build_face_adjacency(mesh));
  const View view = along("", {0.3, 0.2, 1}).view;
  const VisibilityOrder backwards = blocks_in_order(mesh, view, cells, false);
  const OrderCheck pairs = verify_pairs(mesh, view, backwards, kPlanarity);
  const OrderCheck both = verify_order(basis, view, backwards, kPlanarity);
  EXPECT_GT(pairs.left_out, 0U);
  EXPECT_EQ(both.left_out, pairs.left_out);
  EXPECT_GT(both.wrong_count, pairs.wrong_count);
}

}  // namespace
}  // namespace hiac::test
