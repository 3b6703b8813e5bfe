// What meshes and functions of MFEM are refused for, with the line, and what is just allowed; the
// names of spaces, and vertices between others.
#include <cmath>

#include <fmt/format.h>

#include "formats/mfem/dof_map.hpp"
#include "formats/mfem/mesh_file.hpp"
#include "tests/formats/complaints.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using mfem::Geometry;
using testing::ElementsAre;

const std::string kMfemElements = "MFEM mesh v1.0\ndimension\n3\nelements\n1\n7 4 0 1 2 3\n";
const std::string kMfemVertices = "vertices\n4\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kMfemMesh = kMfemElements + kMfemVertices;

mfem::MeshFile mfem_file(const std::string& text) {
  TextCursor cursor(text, "a.mesh");
  return mfem::read_mesh_file(cursor);
}

TEST(MfemComplaints, SectionsOfMeshes) {
  expect_complaints(
      "a.mesh",
      {{kMfemMesh, ""},
       {kMfemElements, ":7: ended before its vertices"},
       {kMfemElements + "vertices\n0\n3\n", ":10: ended before its vertices"},
       {kMfemElements + "attribute_sets\n1\n\"the core\" 1 7\n" + kMfemVertices, ""},
       {kMfemElements + "attribute_sets\n1\n\"the core 1 7\n" + kMfemVertices,
        ":9: a name without its end"},
       {kMfemElements + "faces\n", ":7: a section of an MFEM mesh expected ('faces' found)"},
       {kMfemElements + "rank\n0\n", ":7: a section of an MFEM mesh expected ('rank' found)"},
       {kMfemElements + "vertices\n4\n0\n", ":9: the dimension of the space, 1 to 3, expected"},
       {kMfemElements + "vertices\n4\n4\n", ":9: the dimension of the space, 1 to 3, expected"},
       {"MFEM mesh v2.0\n",
        ":1: 'MFEM mesh v1.x', 'MFEM NC mesh v1.x' or 'MFEM INLINE mesh v1.x' expected ('MFEM mesh "
        "v2.0' found)"}});
}

TEST(MfemComplaints, ElementsHaveAGeometryAndVertices) {
  const auto element = [](const std::string& line) {
    return "MFEM mesh v1.0\nelements\n2\n7 4 0 1 2 3\n" + line + "\n" + kMfemVertices;
  };
  expect_complaints("a.mesh",
                    {{element("1 0 3"), ""},
                     {element("1 8 0 1 2 3 3"), ":5: geometry 0 to 7 expected (8 found)"},
                     {element("1 -1 0 1 2 3 3"), ":5: geometry 0 to 7 expected (-1 found)"},
                     {element("1 4 0 1 2 4"), ": element 1 names vertex 4 (0 to 3 expected)"},
                     {element("1 4 0 1 -1 3"), ": element 1 names vertex -1 (0 to 3 expected)"},
                     {element("1 0 4"), ": element 1 names vertex 4 (0 to 3 expected)"}});
}

TEST(MfemVertices, OfFewerDimensionsLieOnAxesAndPlanes) {
  const auto line = mfem_file("MFEM mesh v1.0\nvertices\n2\n1\n5\n6\n");
  ASSERT_EQ(line.vertices.size(), 2U);
  EXPECT_THAT(line.vertices[1], ElementsAre(6, 0, 0));
  const auto plane = mfem_file("MFEM mesh v1.0\nvertices\n2\n2\n5 1\n6 2\n");
  EXPECT_THAT(plane.vertices.at(1), ElementsAre(6, 2, 0));
  EXPECT_EQ(plane.vertex_count, 2U);
}

TEST(MfemVertices, BetweenOthersArePlacedWhenTheirParentsAre) {
  const std::string head = "MFEM NC mesh v1.0\nelements\n0\n";
  const std::string corners = "coordinates\n2\n3\n0 0 0\n8 4 0\n";
  const auto file = mfem_file(head + "vertex_parents\n3\n4 3 0\n3 2 0\n2 0 1\n" + corners);
  ASSERT_EQ(file.vertex_count, 5U);
  EXPECT_TRUE(file.refined);
  EXPECT_THAT(file.vertices[2], ElementsAre(4, 2, 0));
  EXPECT_THAT(file.vertices[3], ElementsAre(2, 1, 0));
  EXPECT_THAT(file.vertices[4], ElementsAre(1, 0.5, 0));
  const auto parents = [&](const std::string& lines) {
    return head + "vertex_parents\n" + lines + corners;
  };
  expect_complaints(
      "a.mesh",
      {{parents("1\n2 0 3\n"), ":12: vertex_parents name vertex 3 (0 to 2 expected)"},
       {parents("1\n3 0 1\n"), ":12: vertex_parents name vertex 3 (0 to 2 expected)"},
       {parents("1\n2 7 1\n"), ":12: vertex_parents name vertex 7 (0 to 2 expected)"},
       {parents("1\n2 -1 1\n"), ":12: vertex_parents name vertex -1 (0 to 2 expected)"},
       {parents("1\n2 1 -4\n"), ":12: vertex_parents name vertex -4 (0 to 2 expected)"},
       {parents("1\n-3 0 1\n"), ":12: vertex_parents name vertex -3 (0 to 2 expected)"},
       {parents("1\n2 2 1\n"), ":12: vertex_parents: the places of 1 vertices do not follow"},
       {parents("2\n2 3 1\n3 2 1\n"),
        ":13: vertex_parents: the places of 2 vertices do not follow"}});
}

TEST(MfemComplaints, BoxesHaveCellsAlongThreeSides) {
  const auto box = [](const std::string& words) {
    return "MFEM INLINE mesh v1.0\ntype = hex\n" + words;
  };
  const std::string counted = ": 1 to 1000 cells expected (";
  expect_complaints("a.mesh", {{box("nx=1 ny = 1\nnz= 1\n"), ""},
                               {box("nx = 1 ny = 1 nz = 1 name = x sx = 2.5\n"), ""},
                               {box("nx = 1\nny = 1\n"), ":5: nx, ny and nz expected"},
                               {box("ny = 1\nnz = 1\n"), ":5: nx, ny and nz expected"},
                               {box("nx = 1\nnz = 1\n"), ":5: nx, ny and nz expected"},
                               {box("nx 1\n"), ":3: NAME = VALUE expected"},
                               {box("nx = 0\n"), ":3: nx" + counted + "'0' found)"},
                               {box("ny=1001\n"), ":3: ny" + counted + "'1001' found)"},
                               {box("nz = x\n"), ":3: nz" + counted + "'x' found)"},
                               {box("sx = wide\n"), ":3: sx: a length expected ('wide' found)"},
                               {box("nx = 1000 ny = 251 nz = 1\n"),
                                ":4: 251000 bricks are made (250000 at most expected)"},
                               {box("nx = 1000 ny = 1000 nz = 1000\n"),
                                ":4: 1000000000 bricks are made (250000 at most expected)"}});
  const auto most = mfem_file(box("nx = 1000 ny = 250 nz = 1 sx = 2 sy = 3 sz = 4\n"));
  EXPECT_EQ(most.elements.size(), 250000U);
  EXPECT_EQ(most.vertex_count, 1001U * 251 * 2);
  EXPECT_THAT(most.vertices.back(), ElementsAre(2, 3, 4));
}

TEST(MfemComplaints, FunctionsAreTuplesOfTheirSpace) {
  const auto read = [](const std::string& text) {
    TextCursor cursor(text, "f.gf");
    try {
      static_cast<void>(mfem::read_grid_function(cursor));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string space = "FiniteElementSpace\n# c\nFiniteElementCollection: H1_3D_P1\n";
  EXPECT_EQ(read(space + "VDim: 2\nOrdering: 1\n\n1 2\n-3 +4\n.5 6\nmfem_mesh_end\n"), "");
  EXPECT_EQ(read("FiniteElementSpaces\n"),
            "f.gf:1: 'FiniteElementSpace' expected ('FiniteElementSpaces' found)");
  EXPECT_EQ(read(space + "Dim: 1\n"), "f.gf:4: 'VDim:' expected ('Dim:' found)");
  EXPECT_EQ(read(space + "VDim: 1\nOrder: 1\n"), "f.gf:5: 'Ordering:' expected ('Order:' found)");
  EXPECT_EQ(read(space + "VDim: 0\n"), "f.gf:4: 1 to 1000 components expected");
  EXPECT_EQ(read(space + "VDim: 1001\n"), "f.gf:4: 1 to 1000 components expected");
  EXPECT_EQ(read(space + "VDim: 1000\nOrdering: 0\n"),
            "f.gf:6: a multiple of 1000 values expected (0 found)");
  EXPECT_EQ(read(space + "VDim: 2\nOrdering: 0\n1\n2\n3\n"),
            "f.gf:9: a multiple of 2 values expected (3 found)");
}

TEST(MfemFunctions, ValuesAreByNodesOrByVectorDimensions) {
  const ScratchFolder folder;
  const auto values = [&](int ordering, const std::string& space = "H1_3D_P1") {
    static_cast<void>(folder.write(
        "a.gf", fmt::format("FiniteElementSpace\nFiniteElementCollection: {}\nVDim: 2\nOrdering: "
                            "{}\n\n1 2 3 4 5 6 7 8\n",
                            space, ordering)));
    const ZooMesh mesh = read_any(folder.write("a.mesh", kMfemMesh)).mesh;
    const auto view = field_named(mesh, "a").values.view();
    return std::vector<double>(view.begin(), view.end());
  };
  EXPECT_THAT(values(1), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(values(0), ElementsAre(1, 5, 2, 6, 3, 7, 4, 8));
  EXPECT_THAT(values(1, "Linear"), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  // other programs' results lie beside their meshes under one name
  static_cast<void>(folder.write("sol.gf",
                                 "FiniteElementSpace\nFiniteElementCollection: H1_3D_P1\nVDim: 1\n"
                                 "Ordering: 0\n\n9 8 7 6\n"));
  for (const std::string name : {"refined.mesh", "displaced.mesh"})
    EXPECT_THAT(field_named(read_any(folder.write(name, kMfemMesh)).mesh, "sol").values.view(),
                ElementsAre(9, 8, 7, 6));
  EXPECT_EQ(read_any(folder.write("other.mesh", kMfemMesh)).mesh.fields.size(), 1U);
}

TEST(MfemComplaints, FunctionsFitTheMesh) {
  const ScratchFolder folder;
  const std::string path = folder.write("a.mesh", kMfemMesh);
  const auto said = [&](const std::string& space, int count) {
    std::string text =
        "FiniteElementSpace\nFiniteElementCollection: " + space + "\nVDim: 1\nOrdering: 0\n\n";
    for (int i = 0; i < count; ++i) text += "1\n";
    static_cast<void>(folder.write("a.gf", text));
    return refusal(path);
  };
  EXPECT_EQ(said("H1_3D_P1", 4), "");
  EXPECT_EQ(said("H1_3D_P1", 5), path +
                                     ": a function of the space 'H1_3D_P1' does not fit the "
                                     "mesh (4 degrees of freedom expected, 5 found)");
  EXPECT_EQ(said("H1_3D_P2", 10), "");
  EXPECT_EQ(said("H1_3D_P2", 9), path +
                                     ": a function of the space 'H1_3D_P2' does not fit the "
                                     "mesh (10 degrees of freedom expected, 9 found)");
  EXPECT_EQ(said("H1_3D_P3", 20), "");
  EXPECT_EQ(said("L2_3D_P0", 1), "");
  EXPECT_EQ(said("L2_T1_3D_P0", 2), path +
                                        ": a function of the space 'L2_T1_3D_P0' does not fit "
                                        "the mesh (1 values expected, 2 found)");
}

TEST(MfemComplaints, NodesAreOfASpaceThatCells) {
  const auto nodes = [](const std::string& element, int vertices, const std::string& space,
                        int width, int count) {
    std::string text = fmt::format(
        "MFEM mesh v1.0\nelements\n1\n{}\nvertices\n{}\nnodes\nFiniteElementSpace\n"
        "FiniteElementCollection: {}\nVDim: {}\nOrdering: 1\n",
        element, vertices, space, width);
    for (int i = 0; i < width * count; ++i) text += "0\n";
    return text;
  };
  const std::string cube = "1 5 0 1 2 3 4 5 6 7";
  const std::string prism = "1 6 0 1 2 3 4 5";
  expect_complaints(
      "a.mesh",
      {{nodes(cube, 8, "H1_3D_P9", 3, 8),
        ": its nodes are in the space 'H1_3D_P9', which cannot be held (H1_3D_P1 to H1_3D_P8, "
        "H1Pos_3D_P1 to H1Pos_3D_P8, Linear, Quadratic or Cubic expected)"},
       {nodes(prism, 6, "H1_3D_P4", 3, 6), ": has nodes of order 4 on prisms, which are not read"},
       {nodes("1 4 0 1 2 3", 4, "H1_3D_P4", 3, 4),
        ": has nodes of order 4 on tetrahedrons, which are not read"},
       {nodes("1 7 0 1 2 3 4", 5, "H1_3D_P3", 3, 5),
        ": has nodes of order 3 on pyramids, which are not read"},
       {nodes("1 2 0 1 2", 3, "H1_3D_P2", 3, 3),
        ": has nodes of order 2 on triangles, which are not read"},
       {nodes(cube, 8, "H1_3D_P1", 2, 8), ": its nodes have 2 coordinates (3 expected)"},
       {nodes(cube, 8, "H1_3D_P2", 3, 26),
        ": a function of the space 'H1_3D_P2' does not fit the mesh (27 degrees of freedom "
        "expected, 26 found)"}});
}

TEST(MfemComplaints, CurvedCellsHaveEachVertexOnce) {
  const std::string cube = "1 5 0 1 2 3 4 5 6 6\n";
  std::string nodes =
      "vertices\n7\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 3\n"
      "Ordering: 1\n";
  for (int i = 0; i < 26; ++i) nodes += "0 0 0\n";
  expect_complaints("a.mesh", {{"MFEM mesh v1.0\nelements\n1\n" + cube + nodes,
                                ": element 0 has one vertex twice"},
                               {"MFEM mesh v1.0\nelements\n2\n1 4 0 1 2 3\n" + cube + nodes,
                                ": element 1 has one vertex twice"}});
}

TEST(MfemFunctions, OfHigherOrdersThanTheirCellsAreLeftOut) {
  const ScratchFolder folder;
  const auto notes = [&](const std::string& mesh, const std::string& space) {
    static_cast<void>(folder.write("a.gf", "FiniteElementSpace\nFiniteElementCollection: " + space +
                                               "\nVDim: 1\nOrdering: 0\n\n1\n"));
    return read_any(folder.write("a.mesh", mesh)).notes;
  };
  EXPECT_THAT(notes(kMfemMesh, "H1_3D_P4"),
              ElementsAre("left out 'a' of order 4 on cells of order 1"));
  const std::string prism =
      "MFEM mesh v1.0\nelements\n1\n1 6 0 1 2 3 4 5\nvertices\n6\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "1 0 1\n0 1 1\n";
  EXPECT_THAT(notes(prism, "H1_3D_P2"), ElementsAre("left out 'a' of order 2 on cells of order 1"));
  EXPECT_THAT(notes(prism, "RT_3D_P0"),
              ElementsAre("left out 'a' of the space 'RT_3D_P0' (H1_3D_P1 to H1_3D_P8, H1Pos_3D_P1 "
                          "to H1Pos_3D_P8, Linear, Quadratic, Cubic or L2 of order 0 are read)"));
  static_cast<void>(folder.write("b.gf",
                                 "FiniteElementSpace\nFiniteElementCollection: L2_3D_P0\nVDim: 2\n"
                                 "Ordering: 0\n\n7 8\n"));
  const ZooMesh mesh = read_any(folder.write("b.mesh", prism)).mesh;
  EXPECT_EQ(field_named(mesh, "b").location, FieldLocation::cell);
  EXPECT_THAT(field_named(mesh, "b").values.view(), ElementsAre(7, 8));
}

TEST(MfemComplaints, RefinedMeshesAreStraight) {
  const auto refined = [](const std::string& space, int count) {
    std::string text =
        "MFEM NC mesh v1.0\nelements\n1\n0 1 4 0 0 1 2 3\nvertex_parents\n0\ncoordinates\n4\n"
        "nodes\nFiniteElementSpace\nFiniteElementCollection: " +
        space + "\nVDim: 3\nOrdering: 1\n";
    const std::string corners = "0 0 0 1 0 0 0 1 0 0 0 1 ";
    for (int i = 0; i < count; i += 4) text += corners;
    return text;
  };
  const std::string both = ": has nodes of order 2 and hanging nodes, which are not read together";
  expect_complaints("a.mesh", {{refined("H1_3D_P1", 4), ""}, {refined("H1_3D_P2", 12), both}});
  // a title tells so, too, and so do parents of vertices under another title
  const auto without_parents = [&](std::string text) {
    const std::string parents = "vertex_parents\n0\ncoordinates\n";
    return text.replace(text.find(parents), parents.size(), "vertices\n");
  };
  const auto plain = [](std::string text) {
    text.erase(text.find("NC "), 3);
    return text.replace(text.find("\n0 1 4 0 "), 9, "\n1 4 ");
  };
  expect_complaints("a.mesh", {{without_parents(refined("H1_3D_P1", 4)), ""},
                               {without_parents(refined("H1_3D_P2", 12)), both},
                               {plain(refined("H1_3D_P1", 4)), ""},
                               {plain(refined("H1_3D_P2", 12)), both}});
}

TEST(MfemSpaces, AreToldByTheirNames) {
  const auto order = [](const std::string& name) {
    const auto space = mfem::space_named(name);
    return space ? space->order : 0;
  };
  EXPECT_EQ(order("Linear"), 1);
  EXPECT_EQ(order("Quadratic"), 2);
  EXPECT_EQ(order("Cubic"), 3);
  for (const std::string family : {"H1_3D_P", "H1@G_3D_P", "H1@U_3D_P", "H1Pos_3D_P"})
    for (int p = 0; p <= 10; ++p) {
      EXPECT_EQ(order(fmt::format("{}{}", family, p)), p >= 1 && p <= 8 ? p : 0) << family << p;
      if (p < 1 || p > 8) continue;
      const mfem::Space space = *mfem::space_named(fmt::format("{}{}", family, p));
      EXPECT_EQ(space.bernstein, family == "H1Pos_3D_P");
      EXPECT_EQ(space.lobatto, p >= 3 && (family == "H1_3D_P" || family == "H1@G_3D_P"));
      EXPECT_FALSE(space.narrowing);
    }
  EXPECT_EQ(order("H1_2D_P2"), 0);
  EXPECT_EQ(order("ND_3D_P1"), 0);
  EXPECT_TRUE(mfem::is_piecewise_constant("L2_3D_P0"));
  EXPECT_FALSE(mfem::is_piecewise_constant("L2_3D_P1"));
  EXPECT_FALSE(mfem::is_piecewise_constant("RT_3D_P0"));
}

TEST(MfemSpaces, HaveAnOrderThatTheirCellsCanHave) {
  const auto most = [](Geometry geometry, bool bernstein) {
    int order = 0;
    while (mfem::can_be_of(geometry, {order + 1, false, false, bernstein})) ++order;
    return order;
  };
  for (const bool bernstein : {false, true}) {
    EXPECT_EQ(most(Geometry::cube, bernstein), 8);
    EXPECT_EQ(most(Geometry::tetrahedron, bernstein), 3);
    EXPECT_EQ(most(Geometry::prism, bernstein), 3);
    EXPECT_EQ(most(Geometry::pyramid, bernstein), bernstein ? 1 : 2);
    EXPECT_EQ(most(Geometry::square, bernstein), 1);
    EXPECT_EQ(most(Geometry::point, bernstein), 1);
  }
}

// The dimension of the polynomials: P_n, Q_n, P_n x Q_n; of pyramids that of Bergot or Fuentes.
TEST(MfemSpaces, HaveAsManyPointsAsTheirPolynomials) {
  const auto count = [](Geometry geometry, int order, bool narrowing = false) {
    return static_cast<int>(mfem::lattice_points(geometry, {order, false, narrowing}).size());
  };
  for (int n = 1; n <= 3; ++n) {
    EXPECT_EQ(count(Geometry::tetrahedron, n), (n + 1) * (n + 2) * (n + 3) / 6) << n;
    EXPECT_EQ(count(Geometry::cube, n), (n + 1) * (n + 1) * (n + 1)) << n;
    EXPECT_EQ(count(Geometry::prism, n), (n + 1) * (n + 1) * (n + 2) / 2) << n;
    EXPECT_EQ(count(Geometry::pyramid, n), (n + 1) * (n + 2) * (2 * n + 3) / 6) << n;
    EXPECT_EQ(count(Geometry::pyramid, n, true) - count(Geometry::pyramid, n),
              (n - 1) * (n - 1) * (n - 1) - (n - 2) * (n - 1) * (2 * n - 3) / 6)
        << n;
  }
}

TEST(MfemGeometries, HaveNamesAndVertices) {
  const std::vector<std::pair<std::string, std::size_t>> rows{
      {"point", 1},       {"segment", 2}, {"triangle", 3}, {"square", 4},
      {"tetrahedron", 4}, {"cube", 8},    {"prism", 6},    {"pyramid", 5}};
  for (std::size_t g = 0; g < rows.size(); ++g) {
    EXPECT_EQ(mfem::geometry_name(static_cast<Geometry>(g)), rows[g].first);
    EXPECT_EQ(mfem::vertex_count(static_cast<Geometry>(g)), rows[g].second);
  }
}

}  // namespace
}  // namespace hiac::formats
