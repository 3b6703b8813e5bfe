// What XDMF documents are refused for, with the byte of the element, and what is just allowed:
// grids, topologies, geometries and attributes.
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/unit_tetrahedron.hpp"
#include "tests/formats/xdmf/xdmf_documents.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::StartsWith;

ZooMesh xdmf_mesh(const std::string& text) {
  const ScratchFolder folder;
  return read_any(folder.write("a.xmf", text)).mesh;
}

TEST(XdmfComplaints, DocumentsAreWholeAndHaveADomain) {
  const ScratchFolder folder;
  const std::string cut = "<Xdmf><Domain></Xdmf>";
  const std::string path = folder.write("a.xmf", cut);
  EXPECT_THAT(refusal(path), StartsWith(path + ": byte 16: is no whole XML ("));
  expect_xdmf_file("<Xdmf></Xdmf>", "has no Domain below Xdmf");
  expect_xdmf_file("<Xdmf><Grid><Domain/></Grid></Xdmf>", "has no Domain below Xdmf");
  expect_xdmf(XdmfGrid{}.text(), "", "");
}

TEST(XdmfComplaints, DocumentsAreToldByTheirRoot) {
  const Format& xdmf = format_named("xdmf");
  EXPECT_TRUE(xdmf.recognizes("<?xml?>\n<Xdmf Version=\"2\">"));
  EXPECT_FALSE(xdmf.recognizes("<xdmf>"));
}

TEST(XdmfComplaints, GridsAreUniformOrGroups) {
  for (const std::string type : {"Uniform", "uniform"})
    expect_unit_tetrahedron(
        xdmf_mesh(XdmfGrid{.grid_attributes = " GridType=\"" + type + "\""}.text()));
  for (const std::string type : {"Tree", "Collection", "collection"})
    expect_unit_tetrahedron(xdmf_mesh("<Xdmf><Domain><Grid GridType=\"" + type + "\">" +
                                      XdmfGrid{}.grid() + "</Grid></Domain></Xdmf>"));
  expect_xdmf(XdmfGrid{.grid_attributes = " GridType=\"Subset\""}.text(), "Grid",
              "Grid 'g': is of the type 'Subset' (Uniform, Collection or Tree expected)");
  expect_xdmf(XdmfGrid{.topology = ""}.text(), "Grid", "Grid 'g': has no Topology or no Geometry");
  expect_xdmf(XdmfGrid{.geometry = ""}.text(), "Grid", "Grid 'g': has no Topology or no Geometry");
}

TEST(XdmfComplaints, GridsAreNestedUpTo32Deep) {
  const auto nested = [](int depth) {
    std::string text = XdmfGrid{}.grid();
    for (int i = 0; i < depth; ++i) text = "<Grid GridType=\"Tree\">" + text + "</Grid>";
    return "<Xdmf><Domain>" + text + "</Domain></Xdmf>";
  };
  expect_xdmf_file(nested(32), "");
  expect_xdmf_file(nested(33), "its grids are nested too deeply");
}

TEST(XdmfComplaints, IncludesAreOfPartsOfTheSameFile) {
  const auto including = [](const std::string& attributes) {
    return XdmfGrid{.before = XdmfGrid{}.grid(),
                    .grid_attributes = "><xi:include " + attributes + "/"}
        .text();
  };
  expect_xdmf(including("href=\"b.xmf\""), "xi:include",
              "xi:include: includes another file (one file expected)");
  expect_xdmf(including("xpointer=\"xpointer(//[)\""), "xi:include",
              "xi:include: '//[' is no XPath that is understood");
  // by any XPath, with or without its name
  for (const std::string path : {"xpointer(//Grid[1]/Topology)", "//Grid[1]/Topology"}) {
    const std::string text =
        XdmfGrid{.topology = "<xi:include xpointer=\"" + path + "\"/>", .before = XdmfGrid{}.grid()}
            .text();
    EXPECT_EQ(xdmf_mesh(text).cell_count(), 2U) << path;
  }
}

TEST(XdmfGrids, WithOneMeshShareIt) {
  const std::string attribute =
      "<Attribute Name=\"p\" Center=\"Cell\">" + xdmf_item("1", "7") + "</Attribute>";
  const std::string text =
      XdmfGrid{.topology = "<Topology Reference=\"//Grid[1]/Topology\"/>",
               .geometry = "<Geometry Reference=\"XML\"> //Grid[1]/Geometry </Geometry>",
               .attribute = attribute,
               .before = XdmfGrid{}.grid()}
          .text();
  const ZooMesh mesh = xdmf_mesh(text);
  expect_unit_tetrahedron(mesh);
  EXPECT_EQ(field_named(mesh, "p").values[0], 7);
  expect_xdmf(XdmfGrid{.topology = "<Topology Reference=\"//Grid[7]\"/>"}.text(), "Topology",
              "Topology: refers to '//Grid[7]', which is not there");
  expect_xdmf(XdmfGrid{.topology = "<Topology Reference=\"//[\"/>"}.text(), "Topology",
              "Topology: refers to '//[', which is not there");
  expect_xdmf(XdmfGrid{.topology = "<Topology Reference=\"//Topology\"/>"}.text(), "Topology",
              "Topology: refers to '//Topology', which is not there");
}

TEST(XdmfComplaints, TopologiesHaveATypeAndWholeCells) {
  const auto topology = [](const std::string& attributes, const std::string& item) {
    return XdmfGrid{.topology = "<Topology " + attributes + ">" + item + "</Topology>"}.text();
  };
  const std::string four = xdmf_item("4", "0 1 2 3");
  expect_xdmf(topology("Type=\"TETRAHEDRON\"", four), "Topology", "");
  expect_xdmf(topology("TopologyType=\"Tetra_hedron\"", four), "Topology", "");
  expect_xdmf(topology("TopologyType=\"Tetra\"", four), "Topology",
              "Topology: is of the unknown type 'Tetra'");
  expect_xdmf(topology("", four), "Topology", "Topology: is of the unknown type ''");
  expect_xdmf(topology("TopologyType=\"Tetrahedron\"", ""), "Topology",
              "Topology: has too few DataItems");
  expect_xdmf(topology("TopologyType=\"Pyramid\"", four), "Topology",
              "Topology: 4 nodes make no whole number of cells of 5");
  expect_xdmf(topology("TopologyType=\"Polyline\" NodesPerElement=\"3\"", four), "Topology",
              "Topology: 4 nodes make no whole number of cells of 3");
  expect_xdmf(topology("TopologyType=\"Polyline\" NodesPerElement=\"0\"", four), "Topology",
              "Topology: 4 nodes make no whole number of cells of 0");
  expect_xdmf(topology("TopologyType=\"Mixed\" BaseOffset=\"1\"", four), "Topology",
              "Topology: is mixed and has a BaseOffset");
  expect_xdmf(topology("TopologyType=\"Mixed\" BaseOffset=\"0\"", xdmf_item("5", "6 0 1 2 3")),
              "Topology", "");
}

TEST(XdmfComplaints, MixedTopologiesEndWithTheirLastCell) {
  const auto mixed = [](const std::string& numbers) {
    const auto count = std::count(numbers.begin(), numbers.end(), ' ') + 1;
    return XdmfGrid{.topology = "<Topology TopologyType=\"Mixed\">" +
                                xdmf_item(std::to_string(count), numbers) + "</Topology>"}
        .text();
  };
  const std::string early = "a mixed topology ended early (";
  expect_xdmf_file(mixed("6 0 1 2 3"), "");
  expect_xdmf_file(mixed("2 3 0 1 2 6 0 1 2 3 1 1 0"), "");
  expect_xdmf_file(mixed("6 0 1 2 3 2"), early + "a number of nodes expected)");
  expect_xdmf_file(mixed("6 0 1 2 3 6 0 1 2"), early + "4 nodes expected, 3 found)");
  expect_xdmf_file(mixed("6 0 1 2 3 2 4 0 1 2"), early + "4 nodes expected, 3 found)");
  expect_xdmf_file(mixed("6 0 1 2 3 2 -1 0 1 2"), early + "-1 nodes expected, 3 found)");
  expect_xdmf_file(mixed("6 0 1 2 3 16"), early + "the number of faces expected)");
  expect_xdmf_file(mixed("6 0 1 2 3 16 2 3 0 1 2"), early + "a number of nodes expected)");
  expect_xdmf_file(mixed("6 0 1 2 3 16 1 4 0 1 2"), early + "4 nodes expected, 3 found)");
  for (const std::string type : {"0", "10", "33", "51", "-1"})
    expect_xdmf_file(mixed("6 0 1 2 3 " + type + " 1"),
                     "a mixed topology has a cell of the unknown type " + type);
  const ZooMesh polyhedron = xdmf_mesh(mixed("16 4 3 0 2 1 3 0 1 3 3 1 2 3 3 0 3 2"));
  ASSERT_EQ(polyhedron.cell_count(), 1U);
  EXPECT_EQ(polyhedron.kinds[0], CellKind::tetrahedron4);
  EXPECT_NEAR(volume_of(polyhedron, 0), 1.0 / 6, 1e-15);
}

TEST(XdmfComplaints, GeometriesHaveWholePoints) {
  const auto geometry = [](const std::string& attributes, const std::string& items) {
    return XdmfGrid{.geometry = "<Geometry" + attributes + ">" + items + "</Geometry>"}.text();
  };
  const std::string x = xdmf_item("4", "0 1 0 0");
  const std::string y = xdmf_item("4", "0 0 1 0");
  const std::string z = xdmf_item("4", "0 0 0 1");
  expect_unit_tetrahedron(xdmf_mesh(geometry(" Type=\"x_y_z\"", x + y + z)));
  expect_xdmf(geometry("", xdmf_item("13", "0 0 0 1 0 0 0 1 0 0 0 1 2")), "Geometry",
              "Geometry: has an incomplete point");
  expect_xdmf(geometry(" GeometryType=\"XY\"", xdmf_item("9", "0 0 1 0 0 1 0 0 1")), "Geometry",
              "Geometry: has an incomplete point");
  const std::string apart = "Geometry: its axes have different numbers of points";
  const std::string three = xdmf_item("3", "0 0 1");
  expect_xdmf(geometry(" GeometryType=\"X_Y_Z\"", three + y + z), "Geometry", apart);
  expect_xdmf(geometry(" GeometryType=\"X_Y_Z\"", x + three + z), "Geometry", apart);
  expect_xdmf(geometry(" GeometryType=\"X_Y_Z\"", x + y + three), "Geometry", apart);
  expect_xdmf(geometry(" GeometryType=\"X_Y\"", x + three), "Geometry", apart);
  expect_xdmf(geometry(" GeometryType=\"X_Y_Z\"", x + y), "Geometry",
              "Geometry: has too few DataItems");
  expect_xdmf(geometry(" GeometryType=\"polar\"", x), "Geometry",
              "Geometry: is of the type 'POLAR' (XYZ, XY or X_Y_Z expected)");
}

TEST(XdmfGeometries, InAPlaneHaveNoThirdCoordinate) {
  // a solid beside plane cells keeps the document readable
  const std::string plane =
      "<Topology TopologyType=\"Triangle\">" + xdmf_item("1 3", "0 1 2") + "</Topology>";
  for (const std::string& geometry :
       {"<Geometry GeometryType=\"XY\">" + xdmf_item("3 2", "5 6 7 8 9 10") + "</Geometry>",
        "<Geometry GeometryType=\"X_Y\">" + xdmf_item("3", "5 7 9") + xdmf_item("3", "6 8 10") +
            "</Geometry>"}) {
    const ScratchFolder folder;
    const std::string path = folder.write(
        "a.xmf",
        XdmfGrid{.before = XdmfGrid{.topology = plane, .geometry = geometry}.grid()}.text());
    EXPECT_EQ(format_named("xdmf").inspect(path).points, 7U);
    const Reading reading = read_any(path);
    expect_unit_tetrahedron(reading.mesh);
    EXPECT_THAT(reading.notes, Contains("dropped 3 points that no converted cell uses"));
  }
}

/// The mesh of a structured type with those dimensions, geometry and attribute.
std::string xdmf_lattice(const std::string& type, const std::string& dimensions,
                         const std::string& geometry, const std::string& attribute) {
  return XdmfGrid{
      .topology = "<Topology TopologyType=\"" + type + "\" " + dimensions + "/>",
      .geometry = "<Geometry>" + geometry + "</Geometry>",
      .attribute = attribute.empty() ? "" : "<Attribute Name=\"p\">" + attribute + "</Attribute>"}
      .text();
}

TEST(XdmfComplaints, StructuredMeshesHaveThreeDimensions) {
  const std::string cube = xdmf_item("8 3", "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1");
  const std::string values = xdmf_item("8", "1 2 3 4 5 6 7 8");
  const std::string d222 = "Dimensions=\"2 2 2\"";
  expect_xdmf(xdmf_lattice("3DSMesh", d222, cube, ""), "Topology", "");
  expect_xdmf(xdmf_lattice("3dsmesh", "NumberOfElements=\"2 2 2\"", cube, ""), "Topology", "");
  expect_xdmf(xdmf_lattice("3DSMesh", "Dimensions=\"2 4\"", cube, ""), "Topology",
              "Topology: does not have three Dimensions");
  expect_xdmf(xdmf_lattice("3DSMesh", "", cube, ""), "Topology",
              "Topology: does not have three Dimensions");
  expect_xdmf(xdmf_lattice("3DSMesh", "Dimensions=\"1 2 2\"", cube, ""), "Geometry",
              "Geometry: has 8 points (4 expected)");
  expect_xdmf(xdmf_lattice("4DMesh", d222, cube, ""), "Topology",
              "Topology: is of the unknown type '4DMesh'");
  const std::string axis = xdmf_item("2", "0 1");
  const std::string long_axis = xdmf_item("3", "0 1 2");
  expect_xdmf(xdmf_lattice("3DRectMesh", d222, axis + axis + axis, values), "Topology", "");
  expect_xdmf(xdmf_lattice("3DRectMesh", d222, axis + axis + long_axis, values), "Geometry",
              "Geometry: has 3 places along an axis (2 expected)");
  // a field on the one cell is as large as the mesh
  expect_xdmf(
      XdmfGrid{.topology = "<Topology TopologyType=\"3DRectMesh\" " + d222 + "/>",
               .geometry = "<Geometry>" + axis + axis + axis + "</Geometry>",
               .attribute = "<Attribute Center=\"Cell\">" + xdmf_item("1", "7") + "</Attribute>"}
          .text(),
      "Topology", "");
  expect_xdmf(xdmf_lattice("3DRectMesh", d222, axis + axis + axis, ""), "Topology",
              "Topology: has no attribute over its points or cells");
  const std::string origin = xdmf_item("3", "0 0 0");
  expect_xdmf(xdmf_lattice("3DCoRectMesh", d222, origin + origin.substr(0), values), "Topology",
              "");
  expect_xdmf_file(
      xdmf_lattice("3DCoRectMesh", "Dimensions=\"2 65536 65536\"", origin + origin, values),
      "a structured block of 65536 x 65536 x 2 points is more than the file can hold");
  expect_xdmf(xdmf_lattice("3DCoRectMesh", d222, origin + axis, values), "Geometry",
              "Geometry: does not have an origin and a spacing of three numbers");
  expect_xdmf(xdmf_lattice("3DCoRectMesh", d222, axis + origin, values), "Geometry",
              "Geometry: does not have an origin and a spacing of three numbers");
}

TEST(XdmfComplaints, AttributesHaveWholeTuplesUpTo1000) {
  const auto attribute = [](const std::string& center, const std::string& dimensions) {
    // the values themselves are asked for only where the sizes fit
    return XdmfGrid{.attribute = "<Attribute Name=\"p\" Center=\"" + center + "\">" +
                                 xdmf_item(dimensions, "&v;") + "</Attribute>"}
        .text();
  };
  const auto said = [](const std::string& size, const std::string& what) {
    return "Attribute 'p': has " + size + " numbers for " + what;
  };
  expect_xdmf(attribute("Node", "5"), "Attribute", said("5", "4 points"));
  expect_xdmf(attribute("Node", "0"), "Attribute", said("0", "4 points"));
  expect_xdmf(attribute("Cell", "1001"), "Attribute", said("1001", "1 cells"));
  expect_xdmf(attribute("Node", "4 1001"), "Attribute", said("4004", "4 points"));
  expect_xdmf(attribute("Node", "4294967296 4294967296"), "Attribute",
              said("18446744073709551615", "4 points"));
  std::string thousand;
  for (int i = 0; i < 1000; ++i) thousand += std::to_string(i) + " ";
  const ZooMesh mesh =
      xdmf_mesh(XdmfGrid{.attribute = "<Attribute Name=\"p\" Center=\"cell\">" +
                                      xdmf_item("1 10 100", thousand) + "</Attribute>"}
                    .text());
  EXPECT_EQ(mesh.fields.at(0).components, 1000U);
  EXPECT_EQ(mesh.fields[0].values[999], 999);
}

TEST(XdmfAttributes, OfOtherPlacesAreLeftOut) {
  const ScratchFolder folder;
  const std::string values = xdmf_item("4", "1 2 3 4");
  const Reading reading = read_any(folder.write(
      "a.xmf", XdmfGrid{.attribute = "<Attribute Name=\"f\" Center=\"Face\">" + values +
                                     "</Attribute><Attribute Name=\"e\" ItemType=\""
                                     "FiniteElementFunction\">" +
                                     values + "</Attribute><Attribute>" + values + "</Attribute>"}
                   .text()));
  EXPECT_THAT(reading.notes, ElementsAre("left out 'f', which lives on Face",
                                         "left out 'e', which lives on degrees of freedom"));
  ASSERT_EQ(reading.mesh.fields.size(), 1U);
  EXPECT_EQ(reading.mesh.fields[0].name, "attribute");
  EXPECT_EQ(reading.mesh.fields[0].location, FieldLocation::node);
}

}  // namespace
}  // namespace hiac::formats
