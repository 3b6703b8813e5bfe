#include "hiac/check/overlap.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "hiac/base/collect.hpp"
#include "hiac/base/parallel_sort.hpp"
#include "hiac/check/box_tree.hpp"
#include "hiac/check/conformity.hpp"
#include "hiac/check/hull_overlap.hpp"
#include "hiac/check/interior_point.hpp"
#include "hiac/geometry/vector.hpp"

namespace hiac {
namespace {

constexpr std::size_t kOverlapGrain = 1 << 10;

// Bounds of the sums of the absolute values of the shape functions of the nodes between corners
// (tests sample them): tetrahedra attain them at their middle, and so do bricks; the other shapes
// lie in between.
constexpr std::array<double, kKindCount> kBetweenSums{0, 1.5, 3.4, 0, 3, 5, 0,  3,
                                                      5, 0,   3,   6, 0, 3, 5.5};

double size_of(const Hull& hull) {
  double size = 0;
  for (std::size_t i = 1; i < hull.count; ++i)
    for (std::size_t j = 0; j < i; ++j)
      size = std::max(size, length(minus(hull.at(i), hull.at(j))));
  return size;
}

bool share_a_node(const ZooMesh& mesh, CellId a, CellId b) {
  const auto of_b = mesh.cell_nodes(b);
  return std::ranges::any_of(
      mesh.cell_nodes(a), [&](NodeId node) { return std::ranges::find(of_b, node) != of_b.end(); });
}

// Returns whether a cell has all corners of another one's face, or nodes at their places.
bool has_corners_of(const ZooMesh& mesh, CellId cell, const ShapeFace& face, CellId other) {
  const auto nodes = mesh.cell_nodes(cell);
  const auto others = mesh.cell_nodes(other).first(corner_count(mesh.kinds[other]));
  return std::ranges::all_of(std::span(face.corners).first(face.corner_count), [&](auto corner) {
    return std::ranges::any_of(others, [&](NodeId node) {
      return std::ranges::equal(mesh.position(node), mesh.position(nodes[corner]));
    });
  });
}

// One of the two cells that are tested.
struct Asked {
  CellId cell;
  Hull hull;
  Turn turn;
  double size;
  double reach;  // of a curved cell
  bool curved;
};

class Question {
 public:
  Question(const ZooMesh& mesh, const CellShapes& shapes, double planarity)
      : mesh_(mesh), shapes_(shapes), planarity_(planarity) {}

  [[nodiscard]] CellOverlap answer(CellId a, CellId b) const {
    if (shapes_.turns[a] == Turn::flat || shapes_.turns[b] == Turn::flat) return {};
    const Hull p = hull_of_cell(mesh_, a), q = hull_of_cell(mesh_, b);
    const bool linear = is_linear(a) && is_linear(b);
    const bool separated = are_separated(p, q);
    if (separated && linear) return {};
    const Asked of_a = asked(a, p), of_b = asked(b, q);
    if (separated && !of_a.curved && !of_b.curved) return {};
    if (!has_interior(of_a) || !has_interior(of_b)) return {Overlap::possible, 0};
    if (of_a.curved || of_b.curved) return of_curved(of_a, of_b, separated);
    return of_linear(of_a, of_b);
  }

 private:
  [[nodiscard]] bool is_linear(CellId cell) const {
    return order_of(mesh_.kinds[cell]) == CellOrder::linear;
  }
  static bool has_interior(const Asked& asked) {
    return asked.turn == Turn::right || asked.turn == Turn::left;
  }
  static int sign_of(const Asked& asked) { return asked.turn == Turn::right ? 1 : -1; }

  [[nodiscard]] Asked asked(CellId cell, const Hull& hull) const {
    Asked asked{cell, hull, shapes_.turns[cell], size_of(hull), 0, false};
    if (is_linear(cell)) return asked;
    asked.reach = length(curved_reach(mesh_, cell));
    asked.curved = asked.reach > planarity_ * asked.size;
    return asked;
  }

  [[nodiscard]] bool counts_as_convex(const Asked& asked) const {
    return face_deviation(mesh_, asked.cell) <= planarity_ &&
           is_convex(mesh_, asked.cell, asked.turn, planarity_);
  }

  [[nodiscard]] CellOverlap certain(const Asked& a, const Asked& b) const {
    return {Overlap::certain, overlap_depth(a.hull, b.hull) / std::min(a.size, b.size)};
  }

  // Returns whether two cells share a face and lie on different sides of all faces that they share.
  [[nodiscard]] bool are_neighbors(const Asked& a, const Asked& b) const {
    bool any = false;
    const auto faces = topology_of(mesh_.kinds[a.cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!has_corners_of(mesh_, a.cell, faces[f], b.cell)) continue;
      if (is_folded(mesh_, shapes_, a.cell, f, b.cell)) return false;
      any = true;
    }
    return any;
  }

  // Returns whether the faces of `a` that it does not share with `b` are separated from `b`.
  [[nodiscard]] bool faces_are_separated(const Asked& a, const Asked& b) const {
    const auto faces = topology_of(mesh_.kinds[a.cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (!has_corners_of(mesh_, a.cell, faces[f], b.cell) &&
          !are_separated(hull_of_face(mesh_, a.cell, f), b.hull))
        return false;
    return true;
  }

  [[nodiscard]] bool are_separated_neighbors(const Asked& a, const Asked& b) const {
    return are_neighbors(a, b) && faces_are_separated(a, b) && faces_are_separated(b, a);
  }

  [[nodiscard]] CellOverlap of_linear(const Asked& a, const Asked& b) const {
    if (are_separated_neighbors(a, b)) return {};
    if (counts_as_convex(a) && counts_as_convex(b)) return certain(a, b);
    if (common_point(a.hull, sign_of(a), 0, b.hull, sign_of(b), 0)) return certain(a, b);
    return by_maps(a, b);
  }

  // Decides by the cells' own maps, whatever their faces.
  [[nodiscard]] CellOverlap by_maps(const Asked& a, const Asked& b) const {
    const auto point = common_interior_point(mesh_, a.cell, b.cell);
    if (!point) return {Overlap::possible, 0};
    return {Overlap::certain, 2 * point->depth};
  }

  [[nodiscard]] CellOverlap of_curved(const Asked& a, const Asked& b, bool separated) const {
    if (share_a_node(mesh_, a.cell, b.cell)) {
      if (separated || are_separated_neighbors(a, b)) return {};
    } else if (gap_between(a.hull, b.hull) > a.reach + b.reach) {
      return {};
    }
    if (common_point(a.hull, sign_of(a), a.reach, b.hull, sign_of(b), b.reach))
      return certain(a, b);
    return by_maps(a, b);
  }

  const ZooMesh& mesh_;
  const CellShapes& shapes_;
  double planarity_;
};

Box box_of(const ZooMesh& mesh, CellId cell, std::span<const NodeId> corners) {
  Box box = Box::empty();
  for (const NodeId node : corners) box.include(mesh.position(node));
  if (order_of(mesh.kinds[cell]) == CellOrder::linear) return box;
  const auto reach = curved_reach(mesh, cell);
  for (std::size_t c = 0; c < 3; ++c) {
    box.low[c] -= reach[c];
    box.high[c] += reach[c];
  }
  return box;
}

Box box_of_cell(const ZooMesh& mesh, CellId cell) {
  return box_of(mesh, cell, mesh.cell_nodes(cell).first(corner_count(mesh.kinds[cell])));
}

struct OverlappingPair {
  CellId a, b;
  CellOverlap found;

  bool operator<(const OverlappingPair& other) const {
    return std::pair(a, b) < std::pair(other.a, other.b);
  }
};

// Tests a pair and stores it unless the cells do not overlap.
void keep(const Question& question, CellId a, CellId b, std::vector<OverlappingPair>& found) {
  const CellOverlap answer = question.answer(a, b);
  if (answer.overlap != Overlap::none) found.push_back({a, b, answer});
}

// Tests the cells with a face without neighbour, with the cells that this face may reach.
std::vector<OverlappingPair> overlaps_at_boundary(const ZooMesh& mesh,
                                                  const std::vector<FreeFace>& faces,
                                                  const Question& question, std::uint64_t& asked) {
  std::vector<Box> boxes(faces.size());
  parallel_for(faces.size(), kOverlapGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      boxes[i] =
          box_of(mesh, faces[i].cell, std::span(faces[i].nodes).first(faces[i].corner_count));
  });
  const BoxTree tree(std::move(boxes));
  using CellPair = std::pair<CellId, CellId>;
  auto candidates =
      collect<CellPair>(mesh.cell_count(), kOverlapGrain, [&](std::size_t i, auto& found) {
        const auto cell = static_cast<CellId>(i);
        tree.for_each_meeting(box_of_cell(mesh, cell), [&](std::uint32_t f) {
          const CellId other = faces[f].cell;
          if (other != cell) found.emplace_back(std::min(cell, other), std::max(cell, other));
        });
      });
  parallel_sort(candidates, std::less<>());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  asked = candidates.size();
  return collect<OverlappingPair>(
      candidates.size(), kOverlapGrain, [&](std::size_t i, auto& found) {
        keep(question, candidates[i].first, candidates[i].second, found);
      });
}

std::vector<OverlappingPair> overlaps_everywhere(const ZooMesh& mesh, const Question& question,
                                                 std::uint64_t& asked) {
  std::vector<Box> boxes(mesh.cell_count());
  parallel_for(boxes.size(), kOverlapGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      boxes[i] = box_of_cell(mesh, static_cast<CellId>(i));
  });
  const BoxTree tree(std::move(boxes));
  std::atomic<std::uint64_t> count{0};
  auto pairs =
      collect<OverlappingPair>(mesh.cell_count(), kOverlapGrain, [&](std::size_t i, auto& found) {
        const auto cell = static_cast<CellId>(i);
        std::uint64_t here = 0;
        tree.for_each_meeting(tree.box(cell), [&](std::uint32_t other) {
          if (other <= cell) return;
          ++here;
          keep(question, cell, other, found);
        });
        count.fetch_add(here, std::memory_order_relaxed);
      });
  parallel_sort(pairs, std::less<>());
  asked = count;
  return pairs;
}

}  // namespace

std::array<double, 3> curved_reach(const ZooMesh& mesh, CellId cell) {
  const CellKind kind = mesh.kinds[cell];
  const ShapeTopology& shape = topology_of(kind);
  const auto nodes = mesh.cell_nodes(cell);
  const std::size_t per_edge = static_cast<std::size_t>(order_of(kind)) - 1;
  std::array<double, 3> largest{};
  const auto include = [&](NodeId node, std::size_t c, double straight) {
    largest[c] = std::max(largest[c], std::abs(mesh.position(node)[c] - straight));
  };
  std::size_t next = shape.corner_count;
  for (const auto& [from, to] : shape.edges)
    for (std::size_t i = 1; i <= per_edge; ++i, ++next)
      for (std::size_t c = 0; c < 3; ++c) {
        const double a = mesh.position(nodes[from])[c], b = mesh.position(nodes[to])[c];
        const double t = static_cast<double>(i) / static_cast<double>(per_edge + 1);
        include(nodes[next], c, (1 - t) * a + t * b);
      }
  for (std::size_t f = 0; next < nodes.size(); ++f, ++next)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += mesh.position(nodes[shape.faces[f].corners[k]])[c];
      include(nodes[next], c, sum / 3);
    }
  for (double& x : largest) x *= kBetweenSums[static_cast<std::size_t>(kind)];
  return largest;
}

CellOverlap cells_overlap(const ZooMesh& mesh, const CellShapes& shapes, CellId a, CellId b,
                          double planarity) {
  return Question(mesh, shapes, planarity).answer(a, b);
}

OverlapReport find_overlaps(const ZooMesh& mesh, const FaceAdjacency& adjacency,
                            const CellShapes& shapes, bool folded, double planarity) {
  const Question question(mesh, shapes, planarity);
  OverlapReport report;
  std::vector<OverlappingPair> pairs;
  report.by_boundary = shapes.uniform && !folded;
  if (report.by_boundary) {
    const auto faces = free_faces(mesh, adjacency, FaceNumbering(mesh), shapes);
    pairs = overlaps_at_boundary(mesh, faces, question, report.pairs);
    report.by_boundary = pairs.empty();
  }
  if (!report.by_boundary) pairs = overlaps_everywhere(mesh, question, report.pairs);
  std::vector<Offender> certain, grazing, possible;
  for (const auto& [a, b, found] : pairs) {
    const bool deep = found.depth > planarity || planarity == 0;
    auto& list = found.overlap == Overlap::possible ? possible : deep ? certain : grazing;
    list.push_back({a, b, found.depth});
  }
  add_finding(report.findings, Defect::overlap, std::move(certain));
  add_finding(report.findings, Defect::grazing_overlap, std::move(grazing));
  add_finding(report.findings, Defect::possible_overlap, std::move(possible));
  return report;
}

std::vector<std::array<CellId, 2>> overlapping_cells(const OrderBasis& basis, double planarity) {
  // two cells on the same side of a face that they share have not been settled
  const bool folded = !basis.unsettled.empty();
  const OverlapReport report = find_overlaps(
      *basis.mesh, basis.adjacency, judge_cells(*basis.mesh, planarity), folded, planarity);
  std::vector<std::array<CellId, 2>> pairs;
  for (const Finding& finding : report.findings) {
    if (finding.defect == Defect::grazing_overlap) continue;
    for (const Offender& pair : finding.offenders)
      pairs.push_back({static_cast<CellId>(pair.id), static_cast<CellId>(pair.other)});
  }
  return pairs;
}

}  // namespace hiac
