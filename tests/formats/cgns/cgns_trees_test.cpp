// CGNS files written node by node, so that they can lack what the library always writes: what is
// said of it, and the nearest tree that is read.
#include <array>
#include <functional>

#include <cgns_io.h>

#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using TreeIntegers = std::vector<std::int64_t>;
using TreeReals = std::vector<double>;

/// A tree of nodes in the simpler of the two containers.
class CgnsTree {
 public:
  explicit CgnsTree(const std::string& path) {
    good(cgio_open_file(path.c_str(), CGIO_MODE_WRITE, CGIO_FILE_ADF, &file_));
    good(cgio_get_root_id(file_, &root));
  }
  ~CgnsTree() { good(cgio_close_file(file_)); }
  CgnsTree(const CgnsTree&) = delete;
  CgnsTree& operator=(const CgnsTree&) = delete;

  double node(double parent, const std::string& name, const std::string& label) {
    double id = 0;
    good(cgio_create_node(file_, parent, name.c_str(), &id));
    good(cgio_set_label(file_, id, label.c_str()));
    return id;
  }
  /// A node with data of a type; no extents: one of their own length.
  template <typename Number>
  double data(double parent, const std::string& name, const std::string& label, const char* type,
              const std::vector<Number>& values, std::vector<cgsize_t> shape = {}) {
    const double id = node(parent, name, label);
    if (shape.empty()) shape = {static_cast<cgsize_t>(values.size())};
    good(cgio_set_dimensions(file_, id, type, static_cast<int>(shape.size()), shape.data()));
    good(cgio_write_all_data(file_, id, values.data()));
    return id;
  }
  double integers(double parent, const std::string& name, const std::string& label,
                  const TreeIntegers& values, const std::vector<cgsize_t>& shape = {}) {
    return data(parent, name, label, "I8", values, shape);
  }
  double reals(double parent, const std::string& name, const TreeReals& values) {
    return data(parent, name, "DataArray_t", "R8", values);
  }
  double text(double parent, const std::string& name, const std::string& label,
              const std::string& text) {
    return data(parent, name, label, "C1", std::vector<char>(text.begin(), text.end()));
  }

  double root = 0;

 private:
  static void good(int status) { ASSERT_EQ(status, 0); }
  int file_ = 0;
};

double add_base(CgnsTree& tree, const std::string& name = "base") {
  return tree.integers(tree.root, name, "CGNSBase_t", {3, 3});
}

double add_zone(CgnsTree& tree, double base, const TreeIntegers& sizes = {4, 1, 0}) {
  const double zone = tree.integers(base, "zone", "Zone_t", sizes, {1, 3});
  tree.text(zone, "ZoneType", "ZoneType_t", "Unstructured");
  return zone;
}

void add_points(CgnsTree& tree, double zone) {
  const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
  tree.reals(grid, "CoordinateX", {0, 1, 0, 0});
  tree.reals(grid, "CoordinateY", {0, 0, 1, 0});
  tree.reals(grid, "CoordinateZ", {0, 0, 0, 1});
}

/// A section of elements of a type by its number in CGNS: TETRA_4 is 10.
double add_section(CgnsTree& tree, double zone, const TreeIntegers& nodes, std::int64_t type = 10,
                   const TreeIntegers& range = {1, 1}, const std::string& name = "cells") {
  const double section = tree.integers(zone, name, "Elements_t", {type, 0});
  if (!range.empty()) tree.integers(section, "ElementRange", "IndexRange_t", range);
  if (!nodes.empty()) tree.integers(section, "ElementConnectivity", "DataArray_t", nodes);
  return section;
}

template <typename Write>
std::string tree_refusal(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  {
    CgnsTree tree(path);
    write(tree);
  }
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

/// The complaint about a zone with points and whatever else is written into it.
template <typename Write>
std::string zone_refusal(const Write& write) {
  return tree_refusal([&](CgnsTree& tree) {
    const double zone = add_zone(tree, add_base(tree));
    add_points(tree, zone);
    write(tree, zone);
  });
}

template <typename Write>
Reading tree_reading(const Write& write) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  {
    CgnsTree tree(path);
    write(tree);
  }
  return read_any(path);
}

TEST(CgnsTrees, BasesAndZones) {
  EXPECT_EQ(tree_refusal([](CgnsTree&) {}), "holds no CGNSBase_t");
  EXPECT_EQ(tree_refusal([](CgnsTree& tree) { add_base(tree); }), "holds no cells");
  EXPECT_EQ(zone_refusal([](CgnsTree& tree, double zone) {
              add_section(tree, zone, {1, 2, 3, 4});
            }),
            "");
  const Reading reading = tree_reading([](CgnsTree& tree) {
    const double zone = add_zone(tree, add_base(tree));
    add_points(tree, zone);
    add_section(tree, zone, {1, 2, 3, 4});
    add_base(tree, "second");
  });
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_THAT(reading.notes, Contains("read the base 'base' alone of 2"));
}

TEST(CgnsTrees, ZonesSayHowLargeTheyAre) {
  const auto structured = [](const TreeIntegers& sizes, const std::vector<cgsize_t>& shape) {
    return tree_refusal([&](CgnsTree& tree) {
      const double zone = tree.integers(add_base(tree), "zone", "Zone_t", sizes, shape);
      const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
      TreeReals x, y, z;
      for (int i = 0; i < 8; ++i) {
        x.push_back(i % 2);
        y.push_back(i / 2 % 2);
        z.push_back(i / 4);
      }
      tree.reals(grid, "CoordinateX", x);
      tree.reals(grid, "CoordinateY", y);
      tree.reals(grid, "CoordinateZ", z);
    });
  };
  // without a type of the zone it is a structured one
  EXPECT_EQ(structured({2, 2, 2, 1, 1, 1, 0, 0, 0}, {3, 3}), "");
  EXPECT_EQ(structured({2, 2, 2}, {3}), "Zone_t 'zone': does not say how large it is");
  EXPECT_EQ(structured({2, 2, 2, 1, 1, 1}, {3, 2}), "Zone_t 'zone': does not say how large it is");
  EXPECT_EQ(structured({3, 2, 2, 2, 1, 1, 0, 0, 0}, {3, 3}),
            "DataArray_t 'CoordinateX': holds 8 values (12 expected)");
}

TEST(CgnsTrees, PointsHaveCartesianCoordinates) {
  EXPECT_EQ(tree_refusal([](CgnsTree& tree) { add_zone(tree, add_base(tree)); }),
            "Zone_t 'zone': has no GridCoordinates");
  const auto axes = [](const std::vector<const char*>& names, std::size_t count = 4) {
    return tree_refusal([&](CgnsTree& tree) {
      const double zone = add_zone(tree, add_base(tree));
      const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
      for (const char* name : names) tree.reals(grid, name, TreeReals(count, 1));
      add_section(tree, zone, {1, 2, 3}, 5);
    });
  };
  EXPECT_EQ(axes({"CoordinateR", "CoordinateY"}),
            "GridCoordinates_t 'GridCoordinates': has no CoordinateX (Cartesian coordinates "
            "expected)");
  EXPECT_EQ(axes({"CoordinateX", "CoordinateTheta"}),
            "GridCoordinates_t 'GridCoordinates': has no CoordinateY (Cartesian coordinates "
            "expected)");
  // a plane is read: it has no cells
  EXPECT_THAT(axes({"CoordinateX", "CoordinateY"}), HasSubstr("no volume cells"));
  EXPECT_EQ(axes({"CoordinateX", "CoordinateY", "CoordinateZ"}, 5),
            "DataArray_t 'CoordinateX': holds 5 values (4 expected)");
  EXPECT_EQ(axes({"CoordinateX", "CoordinateY", "CoordinateZ"}, 3),
            "DataArray_t 'CoordinateX': holds 3 values (4 expected)");
}

TEST(CgnsTrees, NodesWithoutDataOrOfOtherTypes) {
  const auto coordinate = [](const std::function<void(CgnsTree&, double)>& first) {
    return tree_refusal([&](CgnsTree& tree) {
      const double zone = add_zone(tree, add_base(tree));
      first(tree, tree.node(zone, "GridCoordinates", "GridCoordinates_t"));
    });
  };
  EXPECT_EQ(coordinate(
                [](CgnsTree& tree, double grid) { tree.node(grid, "CoordinateX", "DataArray_t"); }),
            "DataArray_t 'CoordinateX': holds data of type 'MT' (numbers or text expected)");
  EXPECT_EQ(coordinate([](CgnsTree& tree, double grid) {
              tree.data(grid, "CoordinateX", "DataArray_t", "X4", TreeReals{1, 2, 3, 4});
            }),
            "DataArray_t 'CoordinateX': holds data of type 'X4' (numbers or text expected)");
  EXPECT_EQ(tree_refusal([](CgnsTree& tree) {
              tree.data(add_base(tree), "zone", "Zone_t", "R8", TreeReals{2, 2, 2});
            }),
            "Zone_t 'zone': is of type 'R8' (whole numbers expected)");
  EXPECT_EQ(
      tree_refusal([](CgnsTree& tree) {
        const double zone = tree.integers(add_base(tree), "zone", "Zone_t", {4, 1, 0}, {1, 3});
        tree.integers(zone, "ZoneType", "ZoneType_t", {3});
      }),
      "ZoneType_t 'ZoneType': is of type 'I8' (text expected)");
}

TEST(CgnsTrees, NumbersOfEveryType) {
  const auto written = [](const auto& write) {
    return tree_reading([&](CgnsTree& tree) {
             const double zone = add_zone(tree, add_base(tree));
             const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
             write(tree, grid);
             tree.reals(grid, "CoordinateY", {0, 0, 1, 0});
             tree.reals(grid, "CoordinateZ", {0, 0, 0, 1});
             add_section(tree, zone, {1, 2, 3, 4});
           })
        .mesh;
  };
  const std::string x = "CoordinateX";
  const std::string array = "DataArray_t";
  expect_unit_tetrahedron(written([&](CgnsTree& tree, double grid) {
    tree.data(grid, x, array, "R4", std::vector<float>{0, 1, 0, 0});
  }));
  expect_unit_tetrahedron(written([&](CgnsTree& tree, double grid) {
    tree.data(grid, x, array, "I4", std::vector<std::int32_t>{0, 1, 0, 0});
  }));
  expect_unit_tetrahedron(written([&](CgnsTree& tree, double grid) {
    tree.data(grid, x, array, "U4", std::vector<std::uint32_t>{0, 1, 0, 0});
  }));
  expect_unit_tetrahedron(written([&](CgnsTree& tree, double grid) {
    tree.data(grid, x, array, "U8", std::vector<std::uint64_t>{0, 1, 0, 0});
  }));
  const ZooMesh large = written([&](CgnsTree& tree, double grid) {
    tree.data(grid, x, array, "U4", std::vector<std::uint32_t>{0, 4294967295U, 0, 0});
  });
  EXPECT_EQ(large.position(1)[0], 4294967295.0);
}

TEST(CgnsTrees, SectionsNeedTheirRangeAndTheirNodes) {
  const auto section = [](const TreeIntegers& nodes, std::int64_t type, const TreeIntegers& range) {
    return zone_refusal(
        [&](CgnsTree& tree, double zone) { add_section(tree, zone, nodes, type, range); });
  };
  EXPECT_EQ(section({1, 2, 3, 4}, 10, {}), "Elements_t 'cells': has no ElementRange");
  EXPECT_EQ(section({1, 2, 3, 4}, 10, {1}), "Elements_t 'cells': has no ElementRange");
  EXPECT_EQ(section({1, 2, 3, 4}, 10, {1, 1, 1}), "Elements_t 'cells': has no ElementRange");
  EXPECT_EQ(section({}, 10, {1, 1}), "Elements_t 'cells': has no ElementConnectivity");
  EXPECT_EQ(section({}, 22, {1, 1}), "Elements_t 'cells': has no ElementConnectivity");
  EXPECT_EQ(section({}, 20, {1, 1}), "Elements_t 'cells': has no ElementConnectivity");
  EXPECT_EQ(section({1, 2, 3, 4, 1}, 10, {1, 1}),
            "DataArray_t 'ElementConnectivity': 5 nodes make no whole number of TETRA_4");
  EXPECT_EQ(section({1, 2, 3, 4}, 999, {1, 1}),
            "Elements_t 'cells': has elements of the unknown type 999");
  EXPECT_EQ(section({10, 1, 2, 3, 4}, 20, {1, 1}), "");
  EXPECT_EQ(section({10, 1, 2, 3}, 20, {1, 1}),
            "DataArray_t 'ElementConnectivity': ended in the middle of a cell");
  EXPECT_EQ(section({10, 1, 2, 3, 4, 999}, 20, {1, 2}),
            "Elements_t 'cells': has elements of the unknown type 999");
  EXPECT_THAT(section({1, 2, 3, 5}, 10, {1, 1}), HasSubstr("there is no node"));
  EXPECT_THAT(section({0, 2, 3, 4}, 10, {1, 1}), HasSubstr("there is no node"));
}

const TreeIntegers kTreeFaces{1, 3, 2, 1, 2, 4, 2, 3, 4, 3, 1, 4};

/// A polyhedron of four triangles, faces 1 to 4.
std::string polyhedron_refusal(const TreeIntegers& faces, const TreeIntegers& face_starts,
                               const TreeIntegers& cell, const TreeIntegers& cell_starts) {
  return zone_refusal([&](CgnsTree& tree, double zone) {
    const double polygons = add_section(tree, zone, faces, 22, {1, 4}, "faces");
    if (!face_starts.empty())
      tree.integers(polygons, "ElementStartOffset", "DataArray_t", face_starts);
    const double polyhedra = add_section(tree, zone, cell, 23, {5, 5}, "cells");
    if (!cell_starts.empty())
      tree.integers(polyhedra, "ElementStartOffset", "DataArray_t", cell_starts);
  });
}

TEST(CgnsTrees, FacesOfPolyhedra) {
  const TreeIntegers starts{0, 3, 6, 9, 12};
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, starts, {1, -2, 3, -4}, {0, 4}), "");
  // no cell uses the last face, which has no nodes
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, {0, 3, 6, 9, 12, 12}, {1, 2, 3, 4}, {0, 4}), "");
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, {0, 3, 2, 9, 12}, {1, 2, 3, 4}, {0, 4}),
            "DataArray_t 'ElementStartOffset': does not rise");
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, {0, 3, 6, 9, 13}, {1, 2, 3, 4}, {0, 4}),
            "DataArray_t 'ElementConnectivity': ended in the middle of a list");
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, starts, {1, 2, 3, 5}, {0, 4}),
            "Elements_t 'cells': names the face 5, which is in no NGON_n section");
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, starts, {1, 2, 3, 0}, {0, 4}),
            "Elements_t 'cells': names the face 0, which is in no NGON_n section");
  EXPECT_EQ(polyhedron_refusal(kTreeFaces, starts, {1, 2, 3, 4, -3, 3}, {0, 6}),
            "Elements_t 'cells': names the face 3 more than twice");
  // before version 4 each list begins with its length
  const TreeIntegers counted{3, 1, 3, 2, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 1, 4};
  EXPECT_EQ(polyhedron_refusal(counted, {}, {4, 1, 2, 3, 4}, {}), "");
  EXPECT_EQ(polyhedron_refusal(counted, {}, {5, 1, 2, 3, 4}, {}),
            "DataArray_t 'ElementConnectivity': ended in the middle of a list");
  EXPECT_EQ(polyhedron_refusal(counted, {}, {-1, 1, 2, 3, 4}, {}),
            "DataArray_t 'ElementConnectivity': ended in the middle of a list");
}

TEST(CgnsTrees, LayersRoundAZone) {
  // one brick in a field of values with layers around it
  const auto brick = [](const TreeIntegers& rind, std::size_t values) {
    return tree_refusal([&](CgnsTree& tree) {
      const double zone =
          tree.integers(add_base(tree), "zone", "Zone_t", {2, 2, 2, 1, 1, 1, 0, 0, 0}, {3, 3});
      const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
      tree.reals(grid, "CoordinateX", {0, 1, 0, 1, 0, 1, 0, 1});
      tree.reals(grid, "CoordinateY", {0, 0, 1, 1, 0, 0, 1, 1});
      tree.reals(grid, "CoordinateZ", {0, 0, 0, 0, 1, 1, 1, 1});
      const double solution = tree.node(zone, "s", "FlowSolution_t");
      tree.text(solution, "GridLocation", "GridLocation_t", "CellCenter");
      tree.integers(solution, "Rind", "Rind_t", rind);
      tree.reals(solution, "p", TreeReals(values, 7));
    });
  };
  EXPECT_EQ(brick({0, 0, 0, 0, 0, 0}, 1), "");
  EXPECT_EQ(brick({1, 0, 0, 1, 0, 0}, 4), "");
  EXPECT_EQ(brick({1000, 0, 0, 0, 0, 0}, 1001), "");
  EXPECT_EQ(brick({0, 0, 0, 0, 0, 1000}, 1), "DataArray_t 'p': holds 1 values (1001 expected)");
  EXPECT_EQ(brick({0, 0, 0, 1001, 0, 0}, 1), "Rind_t 'Rind': has no sensible layers");
  EXPECT_EQ(brick({0, 0, 0, 0, -1, 0}, 1), "Rind_t 'Rind': has no sensible layers");
}

// Layers before and behind the values along every axis.
TEST(CgnsTrees, ValuesBetweenTheLayers) {
  for (std::size_t round = 0; round < 27; ++round) {
    const std::array<std::size_t, 6> rind{round % 3,       (round + 1) % 3, round / 3 % 3,
                                          (round + 2) % 3, round / 9,       round % 2};
    const std::array<std::size_t, 3> all{2 + rind[0] + rind[1], 1 + rind[2] + rind[3],
                                         3 + rind[4] + rind[5]};
    const ZooMesh mesh =
        tree_reading([&](CgnsTree& tree) {
          const double zone =
              tree.integers(add_base(tree), "zone", "Zone_t", {3, 2, 4, 2, 1, 3, 0, 0, 0}, {3, 3});
          const double grid = tree.node(zone, "GridCoordinates", "GridCoordinates_t");
          std::array<TreeReals, 3> axes;
          for (int n = 0; n < 24; ++n) {
            axes[0].push_back(n % 3);
            axes[1].push_back(n / 3 % 2);
            axes[2].push_back(n / 6);
          }
          tree.reals(grid, "CoordinateX", axes[0]);
          tree.reals(grid, "CoordinateY", axes[1]);
          tree.reals(grid, "CoordinateZ", axes[2]);
          const double solution = tree.node(zone, "s", "FlowSolution_t");
          tree.text(solution, "GridLocation", "GridLocation_t", "CellCenter");
          tree.integers(solution, "Rind", "Rind_t", {rind.begin(), rind.end()});
          TreeReals values;
          for (std::size_t k = 0; k < all[2]; ++k)
            for (std::size_t j = 0; j < all[1]; ++j)
              for (std::size_t i = 0; i < all[0]; ++i)
                values.push_back(static_cast<double>(100 * k + 10 * j + i));
          tree.reals(solution, "p", values);
        }).mesh;
    std::vector<double> expected;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 2; ++i)
        expected.push_back(static_cast<double>(100 * (k + rind[4]) + 10 * rind[2] + i + rind[0]));
    EXPECT_THAT(field_named(mesh, "p").values.view(), testing::ElementsAreArray(expected)) << round;
  }
}

TEST(CgnsTrees, ValuesOfCellsByTheirNumbers) {
  const auto values = [](std::int64_t numbered, const TreeReals& stored) {
    return tree_reading([&](CgnsTree& tree) {
             const double zone = add_zone(tree, add_base(tree), {4, numbered, 0});
             add_points(tree, zone);
             add_section(tree, zone, {1, 2, 3}, 5, {2, 2}, "wall");
             add_section(tree, zone, {1, 2, 3, 4}, 10, {1, 1}, "front");
             add_section(tree, zone, {1, 2, 3, 4}, 10, {3, 3}, "back");
             const double solution = tree.node(zone, "s", "FlowSolution_t");
             tree.text(solution, "GridLocation", "GridLocation_t", "CellCenter");
             tree.reals(solution, "p", stored);
           })
        .mesh;
  };
  // as many as volumes: the wall between them has no value; as many as elements: it has one
  EXPECT_THAT(field_named(values(2, {5, 6}), "p").values.view(), ElementsAre(5, 6));
  EXPECT_THAT(field_named(values(3, {5, 9, 6}), "p").values.view(), ElementsAre(5, 6));
}

/// The complaint about the unit tetrahedron with other bytes in a node: behind its tag stand its
/// name and label of 32 bytes each, from 64 on three numbers of 28 digits together, which lead to
/// its children, its type of 32 bytes, from 124 on how many extents it has, in two digits, and from
/// 126 on the extents, in eight digits each.
std::string damaged_node_refusal(const std::string& name, std::size_t at,
                                 const std::string& digits) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.cgns");
  {
    CgnsTree tree(path);
    const double zone = add_zone(tree, add_base(tree));
    add_points(tree, zone);
    add_section(tree, zone, {1, 2, 3, 4});
  }
  std::string text = text_of(path);
  const std::size_t node = text.find("NoDe" + name + " ");
  EXPECT_NE(node, std::string::npos);
  static_cast<void>(folder.write("a.cgns", text.replace(node + 4 + at, digits.size(), digits)));
  const std::string message = refusal(path);
  return message.empty() ? message : message.substr(path.size() + 2);
}

TEST(CgnsTrees, NodesThatAreDamaged) {
  EXPECT_EQ(damaged_node_refusal("CoordinateX", 126, "00000004"), "");
  EXPECT_EQ(damaged_node_refusal("CoordinateX", 126, "00000005"),
            "DataArray_t 'CoordinateX': cannot be read");
  EXPECT_THAT(damaged_node_refusal("CoordinateX", 126, "0FFFFFFF"),
              testing::MatchesRegex("DataArray_t 'CoordinateX': declares more than a file of "
                                    "[0-9]+ bytes can hold"));
  EXPECT_EQ(damaged_node_refusal("CoordinateX", 126, "FFFFFFFF"), "has a damaged node");
  EXPECT_EQ(damaged_node_refusal("CoordinateX", 124, "0D"), "has a damaged node");
  EXPECT_EQ(damaged_node_refusal("CoordinateX", 64, "ZZZZZZZZ"), "has a damaged node");
  // more children than there are, more than there may be, and a place where none are
  for (const auto& [at, digits] :
       {std::pair<std::size_t, const char*>{64, "00000005"}, {64, "00FFFFFF"}, {80, "00000FFF"}})
    EXPECT_EQ(damaged_node_refusal("zone", at, digits), "Zone_t 'zone': cannot be listed")
        << digits;
}

TEST(CgnsTrees, FilesThatTheLibraryCannotOpen) {
  const ScratchFolder folder;
  const std::string path =
      folder.write("a.cgns", std::string("@(#)ADF Database Version B02012>") + "and no more");
  EXPECT_EQ(refusal(path), path + ": is no whole CGNS file (the library cannot open it)");
}

}  // namespace
}  // namespace hiac::formats
