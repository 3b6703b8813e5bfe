// Cells by their faces: turned outward whichever way the faces run, and recognized as one of the
// kinds, whatever their first nodes and their order.
#include "formats/common/cells/polyhedra.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "formats/common/cells/face_cells.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

/// A linear cell far from the origin; its node n has the number numbers[n].
struct NumberedCell {
  CellShape shape;
  std::vector<std::int64_t> numbers;
  std::vector<std::array<double, 3>> points;

  [[nodiscard]] std::span<const double> position(std::int64_t number) const {
    const auto at = std::ranges::find(numbers, number);
    return points.at(static_cast<std::size_t>(at - numbers.begin()));
  }
  [[nodiscard]] std::vector<FaceNodes> faces() const {
    std::vector<FaceNodes> all;
    for (const ShapeFace& face : topology_of(shape).faces) {
      all.emplace_back();
      for (std::size_t i = 0; i < face.corner_count; ++i)
        all.back().push_back(numbers[face.corners[i]]);
    }
    return all;
  }
};

NumberedCell numbered_cell(CellShape shape, std::mt19937& random) {
  NumberedCell cell{shape, {}, {}};
  const auto reference = reference_nodes(kind_of(shape, CellOrder::linear));
  for (const auto& [x, y, z] : reference) {
    cell.points.push_back({50 + 2 * x + 0.25 * y, y - 70 + 0.5 * z, 30 + z + 0.125 * x});
    cell.numbers.push_back(static_cast<std::int64_t>(cell.numbers.size()) * 3 + 1);
  }
  std::ranges::shuffle(cell.numbers, random);
  return cell;
}

/// The faces, each from its least node on, in rising order: what does not depend on how they are
/// written down.
std::vector<FaceNodes> in_order(std::vector<FaceNodes> faces) {
  for (FaceNodes& face : faces) std::ranges::rotate(face, std::ranges::min_element(face));
  std::ranges::sort(faces);
  return faces;
}

std::vector<FaceNodes> disordered(std::vector<FaceNodes> faces, std::mt19937& random, bool turn) {
  for (FaceNodes& face : faces) {
    std::ranges::rotate(face, face.begin() + static_cast<std::ptrdiff_t>(random() % face.size()));
    if (turn && random() % 2 == 0) std::ranges::reverse(face);
  }
  std::ranges::shuffle(faces, random);
  return faces;
}

constexpr std::array<CellShape, 5> kAllShapes{CellShape::tetrahedron, CellShape::pyramid,
                                              CellShape::prism, CellShape::wedge, CellShape::brick};

TEST(Polyhedra, FacesAreTurnedOutward) {
  std::mt19937 random(3);
  for (const CellShape shape : kAllShapes)
    for (int round = 0; round < 40; ++round) {
      const NumberedCell cell = numbered_cell(shape, random);
      const auto found = turned_outward(disordered(cell.faces(), random, true),
                                        [&](std::int64_t n) { return cell.position(n); });
      ASSERT_TRUE(found);
      // the shape's faces turn counter-clockwise seen from outside
      EXPECT_EQ(in_order(*found), in_order(cell.faces()));
    }
}

TEST(Polyhedra, CellsAreRecognizedByTheirFaces) {
  std::mt19937 random(4);
  for (const CellShape shape : kAllShapes)
    for (int round = 0; round < 60; ++round) {
      NumberedCell cell = numbered_cell(shape, random);
      const auto found = cell_of_faces(disordered(cell.faces(), random, false));
      ASSERT_TRUE(found);
      EXPECT_EQ(found->kind, kind_of(shape, CellOrder::linear));
      const std::vector<FaceNodes> faces = in_order(cell.faces());
      cell.numbers = found->nodes;
      EXPECT_EQ(in_order(cell.faces()), faces);
    }
}

TEST(Polyhedra, CellsOfOtherFacesAreNoKind) {
  const auto is_kind = [](const std::vector<FaceNodes>& faces) {
    return cell_of_faces(faces).has_value();
  };
  const std::vector<FaceNodes> prism{
      {0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  EXPECT_TRUE(is_kind(prism));
  EXPECT_FALSE(is_kind({}));
  EXPECT_FALSE(is_kind({{0, 1}, {1, 2}, {2, 0}, {0, 1, 2}}));
  // a face less, a face twice, a node in another's place, faces of which one runs inward
  EXPECT_FALSE(is_kind({prism.begin(), prism.end() - 1}));
  const auto with = [&](std::size_t face, const FaceNodes& nodes) {
    std::vector<FaceNodes> faces = prism;
    faces[face] = nodes;
    return faces;
  };
  EXPECT_FALSE(is_kind(with(1, {0, 2, 1})));
  EXPECT_FALSE(is_kind(with(4, {1, 2, 5, 4})));
  EXPECT_FALSE(is_kind(with(4, {2, 0, 5, 3})));
  EXPECT_FALSE(is_kind(with(4, {5, 3, 0, 2})));
  EXPECT_FALSE(is_kind(with(4, {2, 0, 3, 5, 1})));
  // a pyramid over a pentagon
  EXPECT_FALSE(is_kind({{4, 3, 2, 1, 0}, {0, 1, 5}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 0, 5}}));
}

TEST(Polyhedra, SurfacesThatDoNotCloseAreNone) {
  const auto closes = [](const std::vector<FaceNodes>& faces) {
    std::vector<std::array<double, 3>> points;
    for (int n = 0; n < 12; ++n) points.push_back({n * 1.0, n * n * 1.0, n * n * n * 1.0});
    return turned_outward(faces,
                          [&](std::int64_t n) -> std::span<const double> {
                            return points.at(static_cast<std::size_t>(n));
                          })
        .has_value();
  };
  const std::vector<FaceNodes> tetrahedron{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  EXPECT_TRUE(closes(tetrahedron));
  EXPECT_FALSE(closes({tetrahedron.begin(), tetrahedron.end() - 1}));
  // a fifth face at the edges of the four
  std::vector<FaceNodes> more = tetrahedron;
  more.push_back({0, 1, 4});
  EXPECT_FALSE(closes(more));
  // two faces on one another
  EXPECT_FALSE(closes({{0, 1, 2}, {0, 1, 2}}));
  // two surfaces, each closed
  more = tetrahedron;
  for (FaceNodes face : tetrahedron) {
    for (std::int64_t& node : face) node += 4;
    more.push_back(face);
  }
  EXPECT_FALSE(closes(more));
  // an edge from a node to itself
  EXPECT_FALSE(closes({{0, 0, 1, 2}, {0, 0, 3, 1}, {1, 3, 2}, {2, 3, 0}}));
  // the projective plane of six vertices: every edge has two faces, but it has one side
  EXPECT_FALSE(closes({{1, 2, 5},
                       {1, 2, 6},
                       {1, 3, 4},
                       {1, 3, 6},
                       {1, 4, 5},
                       {2, 3, 4},
                       {2, 3, 5},
                       {2, 4, 6},
                       {3, 5, 6},
                       {4, 5, 6}}));
}

TEST(Polyhedra, FacesAreReadFromTheirList) {
  ForeignPolyhedra list{{5, 9}, {4, 13}, {3, 1, 2, 3, 4, 4, 5, 6, 7, 3, 8, 9, 1}};
  EXPECT_THAT(faces_of(list, 0, "f"), ElementsAre(FaceNodes{1, 2, 3}));
  EXPECT_THAT(faces_of(list, 1, "f"), ElementsAre(FaceNodes{4, 5, 6, 7}, FaceNodes{8, 9, 1}));
  const auto said = [&](std::size_t entry, std::int64_t count) {
    ForeignPolyhedra other = list;
    other.faces[entry] = count;
    try {
      faces_of(other, 1, "f");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto of = [](int count) {
    return "f: cell 9: a face of " + std::to_string(count) +
           " nodes (3 and more expected, as many as there are)";
  };
  EXPECT_EQ(said(0, -7), "");
  EXPECT_EQ(said(4, 2), of(2));
  EXPECT_EQ(said(4, -1), of(-1));
  EXPECT_EQ(said(4, 8), "");
  EXPECT_EQ(said(4, 9), of(9));
  EXPECT_EQ(said(9, 4), of(4));
  list.ends = {4, 4};
  EXPECT_TRUE(faces_of(list, 1, "f").empty());
}

}  // namespace
}  // namespace hiac::formats
