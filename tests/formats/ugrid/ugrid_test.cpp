// UGRID meshes of every kind of cell with both kinds of boundary faces, as text and in each binary
// variant, told by the name or by the size; what they are refused for.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/complaints.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

constexpr std::array<std::array<double, 3>, 12> kUgridPoints{{{0, 0, 0},
                                                              {1, 0, 0},
                                                              {1, 1, 0},
                                                              {0, 1, 0},
                                                              {0, 0, 1},
                                                              {1, 0, 1},
                                                              {1, 1, 1},
                                                              {0, 1, 1},
                                                              {0.5, 0.5, 2},
                                                              {2, 0, 0},
                                                              {2, 0, 1},
                                                              {2, 1, 0}}};
/// Nodes, triangles, quadrilaterals, tetrahedra, pyramids, prisms, hexahedra.
const std::vector<std::int32_t> kUgridCounts{12, 3, 2, 1, 2, 1, 1};
/// The faces' nodes and then their numbers; a tetrahedron, two pyramids (the apex of the first is
/// node 9), a prism and a brick.
const std::vector<std::int32_t> kUgridFaces{1, 2, 3, 2, 3, 4, 3, 4, 1, 1, 2,
                                            3, 4, 5, 6, 7, 8, 7, 7, 7, 8, 8};
const std::vector<std::int32_t> kUgridCells{10, 12, 3, 11, 5,  8, 9, 6, 7, 1, 4, 9, 2, 3,
                                            2,  10, 3, 6,  11, 7, 1, 2, 3, 4, 5, 6, 7, 8};

/// One of the binary variants, as its name says: l little-endian, r with Fortran's marks.
std::string ugrid_bytes(const std::string& variant) {
  const bool swapped = (variant.front() == 'l') != (std::endian::native == std::endian::little);
  std::string text;
  const auto put = [&](auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    if (swapped) std::reverse(std::begin(raw), std::end(raw));
    text.append(raw, sizeof raw);
  };
  const bool marked = variant.find('r') != std::string::npos;
  const bool wide = variant.back() == '8';
  const auto body = static_cast<std::int32_t>(36 * (wide ? 8 : 4) +
                                              4 * (kUgridFaces.size() + kUgridCells.size()));
  if (marked) put(std::int32_t{28});
  for (const std::int32_t count : kUgridCounts) put(count);
  if (marked) put(std::int32_t{28});
  if (marked) put(body);
  for (const auto& point : kUgridPoints)
    for (const double x : point) wide ? put(x) : put(static_cast<float>(x));
  for (const std::int32_t number : kUgridFaces) put(number);
  for (const std::int32_t number : kUgridCells) put(number);
  if (marked) put(body);
  return text;
}

std::string ugrid_words() {
  std::string text;
  for (const std::int32_t count : kUgridCounts) text += fmt::format("{} ", count);
  for (const auto& [x, y, z] : kUgridPoints) text += fmt::format("\n{} {} {}", x, y, z);
  for (const std::int32_t number : kUgridFaces) text += fmt::format("\n{}", number);
  for (const std::int32_t number : kUgridCells) text += fmt::format("\n{}", number);
  return text + "\n";
}

void expect_ugrid_cells(const Reading& reading) {
  const ZooMesh& mesh = reading.mesh;
  EXPECT_THAT(std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
              ElementsAre(CellKind::tetrahedron4, CellKind::pyramid5, CellKind::pyramid5,
                          CellKind::prism6, CellKind::brick8));
  const std::array<double, 5> volumes{1.0 / 6, 1.0 / 3, 2.0 / 3, 0.5, 1};
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
    EXPECT_NEAR(volume_of(mesh, cell), volumes[cell], 1e-15) << cell;
  EXPECT_THAT(mesh.position(mesh.cell_nodes(1)[4]), ElementsAre(0.5, 0.5, 2));
  EXPECT_THAT(reading.notes, ElementsAre("dropped cells without volume: 3 triangles, 2 "
                                         "quadrilaterals of the boundary"));
}

TEST(Ugrid, CellsAndBoundaryFacesOfEveryKind) {
  const ScratchFolder folder;
  expect_ugrid_cells(read_any(folder.write("a.ugrid", ugrid_words())));
  for (const std::string variant : {"b8", "lb8", "b4", "lb4", "r8", "lr8", "r4", "lr4"})
    for (const std::string& name : {"a." + variant + ".ugrid", std::string("a.ugrid")}) {
      SCOPED_TRACE(variant + " " + name);
      expect_ugrid_cells(read_any(folder.write(name, ugrid_bytes(variant))));
    }
}

TEST(Ugrid, BytesBehindTheMeshAreToldWhereTheNameTellsTheVariant) {
  const ScratchFolder folder;
  for (const std::string variant : {"b8", "lr4"}) {
    const std::string text = ugrid_bytes(variant) + "abc";
    EXPECT_THAT(read_any(folder.write("a." + variant + ".ugrid", text)).notes,
                ElementsAre("3 bytes behind the end of the mesh are not read",
                            "dropped cells without volume: 3 triangles, 2 quadrilaterals of the "
                            "boundary"));
    EXPECT_THAT(refusal(folder.write("a.ugrid", text)),
                testing::HasSubstr("none of the binary variants fits (b8, lb8, b4, lb4, r8, lr8, "
                                   "r4 or lr4 before .ugrid expected)"));
  }
}

TEST(Ugrid, FilesHoldWhatTheirCountsSay) {
  const auto said = [](const std::string& variant, std::string text) {
    const ScratchFolder folder;
    const std::string path = folder.write("a." + variant + ".ugrid", text);
    return refusal(path).substr(path.size());
  };
  const std::string whole = ugrid_bytes("lb8");
  EXPECT_EQ(
      said("lb8", whole.substr(0, whole.size() - 1)),
      fmt::format(": at byte 28: the counts do not fit a lb8 file of {} bytes", whole.size() - 1));
  const std::string marked = ugrid_bytes("r4");
  EXPECT_EQ(
      said("r4", marked.substr(0, marked.size() - 1)),
      fmt::format(": at byte 32: the counts do not fit a r4 file of {} bytes", marked.size() - 1));
  // another variant's file, a count below zero, another first mark, no room for counts
  EXPECT_NE(said("b8", whole), "");
  std::string negative = whole;
  negative[27] = '\x80';
  EXPECT_NE(said("lb8", negative), "");
  std::string other = marked;
  other[3] = '\x1d';
  EXPECT_EQ(said("r4", other),
            fmt::format(": at byte 4: the counts do not fit a r4 file of {} bytes", other.size()));
  EXPECT_EQ(said("lb8", std::string(35, '\0')),
            ": at byte 0: the counts do not fit a lb8 file of 35 bytes");
  EXPECT_EQ(said("lb8", std::string(36, '\0')),
            ": holds no volume cells (8 bytes behind the end of the mesh are not read)");
}

TEST(Ugrid, TextsHoldWhatTheirCountsSay) {
  const std::string words = ugrid_words();
  const std::size_t last = words.rfind("\n8");
  expect_complaints(
      "a.ugrid",
      {{words, ""},
       {words.substr(0, last + 1), ":63: the file ends too early (a node expected)"},
       {words.substr(0, last) + "\nx\n", ":63: not understood (a node expected, 'x' found)"},
       {"9999 0 0 1 0 0 0\n", ":1: a count: impossible (0 to 17 expected, 9999 found)"},
       {"4 0 0 1 0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 x\n",
        ":5: not understood (a coordinate expected, 'x' found)"},
       {"4 1 0 1 0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3\n",
        ":7: the file ends too early (a boundary face expected)"}});
}

}  // namespace
}  // namespace hiac::formats
