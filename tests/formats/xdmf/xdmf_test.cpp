// XDMF documents whose numbers stand in HDF5 files: series of times, functions that share a mesh,
// grids in space, and every way of telling points and cells (the XDMF Model and Format).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/hdf5_output.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string document(const std::string& domain) {
  return "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\" xmlns:xi=\"http://www.w3.org/2001/"
         "XInclude\"><Domain>" +
         domain + "</Domain></Xdmf>";
}

std::string item(const std::string& dimensions, const std::string& text,
                 const std::string& format = "XML") {
  return fmt::format("<DataItem Dimensions=\"{}\" Format=\"{}\">{}</DataItem>", dimensions, format,
                     text);
}

std::string attribute(const std::string& name, const std::string& center, const std::string& data) {
  return fmt::format("<Attribute Name=\"{}\" Center=\"{}\">{}</Attribute>", name, center, data);
}

// As FEniCS writes a function at several times: the first grid has the mesh, the others include it.
TEST(Xdmf, TimesShareAMeshWhoseNumbersAreInHdf5) {
  const ScratchFolder folder;
  {
    Hdf5Output file(folder.file("a.h5"));
    file.put("/Mesh/geometry", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
             {5, 3});
    file.put("/Mesh/topology", std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4}, {2, 4});
    for (const int step : {0, 1, 2}) {
      std::vector<float> f;
      for (int n = 0; n < 5; ++n) f.push_back(static_cast<float>(10 * step + n));
      file.put(fmt::format("/f/{}", step), f, {5, 1});
    }
  }
  std::string series = "<Grid Name=\"S\" GridType=\"Collection\" CollectionType=\"Temporal\">";
  for (const int step : {0, 1, 2}) {
    series += fmt::format("<Grid Name=\"g\" GridType=\"Uniform\">");
    if (step == 0)
      series += "<Topology NumberOfElements=\"2\" TopologyType=\"Tetrahedron\">" +
                item("2 4", "a.h5:/Mesh/topology", "HDF") +
                "</Topology><Geometry GeometryType=\"XYZ\">" +
                item("5 3", " a.h5:/Mesh/geometry ", "HDF") + "</Geometry>";
    else
      series +=
          "<xi:include xpointer=\"xpointer(//Grid[@Name=&quot;S&quot;]/Grid[1]/*[self::"
          "Topology or self::Geometry])\"/>";
    series += fmt::format("<Time Value=\"{}\"/>", 0.5 * step) +
              attribute("f", "Node", item("5 1", fmt::format("a.h5:/f/{}", step), "HDF")) +
              "</Grid>";
  }
  const std::string path = folder.write("a.xdmf", document(series + "</Grid>"));
  EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0, 0.5, 1));
  for (const std::size_t step : {0, 1, 2}) {
    ReadOptions options;
    options.time = 0.5 * static_cast<double>(step);
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.cell_count(), 2U);
    EXPECT_NEAR(volume_of(mesh, 0), 1.0 / 6, 1e-15);
    EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-15);
    const double first = 10 * static_cast<double>(step);
    EXPECT_THAT(field_named(mesh, "f").values.view(),
                ElementsAre(first, first + 1, first + 2, first + 3, first + 4));
  }
  EXPECT_EQ(field_named(read_any(path).mesh, "f").values[4], 24);
  static_cast<void>(folder.write("a.h5", text_of(folder.file("a.h5")).substr(0, 700)));
  EXPECT_NE(refusal(path), "");
}

TEST(Xdmf, NumbersHaveOneSign) {
  const ScratchFolder folder;
  const auto refused = [&](const std::string& nodes, const std::string& value) {
    return !refusal(
                folder.write("a.xdmf", document("<Grid><Topology TopologyType=\"Tetrahedron\">" +
                                                item("1 4", nodes) + "</Topology><Geometry>" +
                                                item("4 3", "0 0 0 1 0 0 0 1 0 0 0 " + value) +
                                                "</Geometry></Grid>")))
                .empty();
  };
  EXPECT_FALSE(refused("+0 +1 2 3", "+1"));
  EXPECT_TRUE(refused("+-0 1 2 3", "1"));
  EXPECT_TRUE(refused("0 1 2 3", "+-1"));
  EXPECT_TRUE(refused("0 1 2 3", "+"));
}

TEST(Xdmf, TimesMayBeListedOrMadeByASlab) {
  const ScratchFolder folder;
  const std::string mesh = "<Topology TopologyType=\"Tetrahedron\">" + item("1 4", "0 1 2 3") +
                           "</Topology><Geometry>" + item("4 3", "0 0 0 1 0 0 0 1 0 0 0 1") +
                           "</Geometry>";
  std::string grids;
  for (const int step : {0, 1, 2})
    grids += "<Grid>" + mesh + attribute("c", "Cell", item("1", fmt::format("{}", 7 + step))) +
             "</Grid>";
  const auto series = [&](const std::string& time) {
    return document("<Grid GridType=\"Collection\" CollectionType=\"Temporal\">" + time + grids +
                    "</Grid>");
  };
  const std::vector<std::pair<std::string, std::vector<double>>> rows{
      {"<Time TimeType=\"List\">" + item("3", "0 3 4.5") + "</Time>", {0, 3, 4.5}},
      {"<Time TimeType=\"HyperSlab\">" + item("3", "2 0.25 3") + "</Time>", {2, 2.25, 2.5}},
      {"", {0, 1, 2}}};
  for (const auto& [time, expected] : rows) {
    const std::string path = folder.write("a.xdmf", series(time));
    EXPECT_EQ(format_to_read(path).inspect(path).times, expected);
    ReadOptions options;
    options.time = expected[1];
    EXPECT_EQ(field_named(read_any(path, options).mesh, "c").values[0], 8);
  }
}

TEST(Xdmf, GridsInSpaceAreBlocks) {
  const ScratchFolder folder;
  const auto grid = [](const std::string& name, double x, const std::string& field) {
    return fmt::format(
               "<Grid Name=\"{}\"><Topology TopologyType=\"Tetrahedron\" "
               "BaseOffset=\"1\">",
               name) +
           item("1 4", "1 2 3 4") + "</Topology><Geometry GeometryType=\"X_Y_Z\">" +
           item("4", fmt::format("{0} {1} {0} {0}", x, x + 1)) + item("4", "0 0 1 0") +
           item("4", "0 0 0 1") + "</Geometry>" + field + "</Grid>";
  };
  const std::string path = folder.write(
      "a.xdmf",
      document("<Grid GridType=\"Collection\" CollectionType=\"Spatial\">" +
               grid("left", 0, attribute("c", "Cell", item("1", "5"))) +
               grid("right", 4, attribute("d", "Cell", item("1 3", "6 7 8"))) + "</Grid>"));
  const ZooMesh mesh = read_any(path).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 6, 1e-15);
  EXPECT_EQ(field_named(mesh, "c").values[0], 5);
  EXPECT_TRUE(std::isnan(field_named(mesh, "c").values[1]));
  EXPECT_THAT(field_named(mesh, "d").values.view().subspan(3, 3), ElementsAre(6, 7, 8));
  ReadOptions options;
  options.block = "right";
  EXPECT_EQ(read_any(path, options).mesh.position(0)[0], 4);
}

/// The lattice of 3 x 2 x 2 points (i, 2 j, 3 k) in every way that XDMF has for one.
TEST(Xdmf, StructuredMeshesAreBricks) {
  const ScratchFolder folder;
  std::string xyz;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) xyz += fmt::format("{} {} {} ", i, 2 * j, 3 * k);
  const std::vector<std::pair<std::string, std::string>> rows{
      {"3DSMesh", "<Geometry GeometryType=\"XYZ\">" + item("2 2 3 3", xyz) + "</Geometry>"},
      {"3DRectMesh", "<Geometry GeometryType=\"VXVYVZ\">" + item("3", "0 1 2") + item("2", "0 2") +
                         item("2", "0 3") + "</Geometry>"},
      {"3DCoRectMesh", "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">" + item("3", "0 0 0") +
                           item("3", "3 2 1") + "</Geometry>"}};
  for (const auto& [type, geometry] : rows) {
    SCOPED_TRACE(type);
    const std::string path = folder.write(
        "a.xdmf",
        document("<Grid><Topology TopologyType=\"" + type + "\" Dimensions=\"2 2 3\"/>" + geometry +
                 attribute("s", "Node", item("2 2 3", "0 1 2 3 4 5 6 7 8 9 10 11")) +
                 attribute("c", "Cell", item("1 1 2", "7 8")) + "</Grid>"));
    const ZooMesh mesh = read_any(path).mesh;
    ASSERT_EQ(mesh.cell_count(), 2U);
    ASSERT_EQ(mesh.node_count(), 12U);
    EXPECT_NEAR(volume_of(mesh, 0), 6, 1e-14);
    EXPECT_THAT(field_named(mesh, "c").values.view(), ElementsAre(7, 8));
    for (NodeId node = 0; node < 12; ++node) {
      const auto x = mesh.position(node);
      EXPECT_EQ(field_named(mesh, "s").values[node], x[0] + 3 * (x[1] / 2 + 2 * x[2] / 3));
    }
  }
}

// Mixed topologies name each cell's type by its number; of lines and points also the nodes' count.
TEST(Xdmf, MixedTopologies) {
  const ScratchFolder folder;
  const auto mixed = [&](const std::string& cells) {
    std::istringstream text(cells);
    const auto words = std::distance(std::istream_iterator<std::string>(text),
                                     std::istream_iterator<std::string>());
    return folder.write(
        "a.xdmf",
        document("<Grid><Topology TopologyType=\"Mixed\" NumberOfElements=\"6\">" +
                 item(fmt::format("{}", words), cells) + "</Topology><Geometry>" +
                 item("12 3",
                      "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 .5 .5 2 2 0 0 2 0 1 "
                      "9 9 9") +
                 "</Geometry>" + attribute("c", "Cell", item("6", "1 2 3 4 5 6")) + "</Grid>"));
  };
  const Reading reading =
      read_any(mixed("9 0 1 2 3 4 5 6 7  4 0 1 2  7 4 5 6 7 8  2 2 0 1  8 1 2 9 5 6 10  1 1 11"));
  EXPECT_THAT(std::vector<CellKind>(reading.mesh.kinds.begin(), reading.mesh.kinds.end()),
              ElementsAre(CellKind::brick8, CellKind::pyramid5, CellKind::prism6));
  EXPECT_NEAR(volume_of(reading.mesh, 0), 1, 1e-15);
  EXPECT_NEAR(volume_of(reading.mesh, 1), 1.0 / 3, 1e-15);
  EXPECT_NEAR(volume_of(reading.mesh, 2), 0.5, 1e-15);
  EXPECT_THAT(field_named(reading.mesh, "c").values.view(), ElementsAre(1, 3, 5));
  EXPECT_EQ(reading.mesh.node_count(), 11U);
  EXPECT_NE(refusal(mixed("9 0 1 2 3 4 5 6")), "");
  EXPECT_NE(refusal(mixed("99 0 1 2 3")), "");
}

// FEniCS sorts the nodes of tetrahedra, whichever hand that gives them.
TEST(Xdmf, TetrahedraWithSortedNodesAreTurned) {
  const ScratchFolder folder;
  std::string points;
  std::string cells;
  for (int t = 0; t < 24; ++t) {
    // along x and y, or along y and x
    const char* const second = t % 2 == 0 ? "{1} 0 0 {0} 1 0" : "{0} 1 0 {1} 0 0";
    points += fmt::format("{0} 0 0 ", 3 * t) + fmt::format(fmt::runtime(second), 3 * t, 3 * t + 1) +
              fmt::format(" {0} 0 1 ", 3 * t);
    cells += fmt::format("{} {} {} {} ", 4 * t, 4 * t + 1, 4 * t + 2, 4 * t + 3);
  }
  const Reading reading = read_any(folder.write(
      "a.xdmf", document("<Grid><Topology TopologyType=\"Tetrahedron\">" + item("24 4", cells) +
                         "</Topology><Geometry>" + item("96 3", points) + "</Geometry></Grid>")));
  ASSERT_EQ(reading.mesh.cell_count(), 24U);
  for (CellId cell = 0; cell < 24; ++cell)
    EXPECT_NEAR(volume_of(reading.mesh, cell), 1.0 / 6, 1e-12) << cell;
  EXPECT_THAT(reading.notes,
              testing::Contains(HasSubstr("numbered 12 of 24 tetrahedra right-handed")));
}

// A path may stand without the word xpointer, and end with a bracket all the same.
TEST(Xdmf, PathsOfInclusions) {
  const ScratchFolder folder;
  const auto said = [&](const std::string& path) {
    return refusal(folder.write(
        "a.xdmf", document("<Grid Name=\"first\"><Topology TopologyType=\"Tetrahedron\">" +
                           item("1 4", "0 1 2 3") + "</Topology><Geometry>" +
                           item("4 3", "0 0 0 1 0 0 0 1 0 0 0 1") +
                           "</Geometry></Grid><Grid Name=\"second\"><xi:include xpointer=\"" +
                           path + "\"/></Grid>")));
  };
  EXPECT_EQ(said("xpointer(//Grid[1]/Topology | //Grid[1]/Geometry)"), "");
  EXPECT_EQ(said("(//Grid[1]/Topology | //Grid[1]/Geometry)"), "");
  EXPECT_EQ(said("//Grid[1]/Topology | //Grid[1]/Geometry"), "");
  EXPECT_THAT(said("xpointer(//Grid[1]/Topology"), HasSubstr("is no XPath that is understood"));
}

}  // namespace
}  // namespace hiac::formats
