// The DataItems of XDMF documents: slabs, joins, texts, files of every number type; what they are
// refused for.
#include "formats/xdmf/topologies.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"
#include "tests/formats/xdmf/xdmf_documents.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

/// A document with a field "p" on nodes from that item.
std::string with_item(const std::string& item) {
  return XdmfGrid{.attribute = "<Attribute Name=\"p\">" + item + "</Attribute>"}.text();
}

std::vector<double> item_values(const std::string& item) {
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("a.xmf", with_item(item))).mesh;
  const auto view = field_named(mesh, "p").values.view();
  return {view.begin(), view.end()};
}

/// The complaint on the item, which is the document's third.
void expect_item(const std::string& item, const std::string& message) {
  const ScratchFolder folder;
  const std::string text = with_item(item);
  const std::string path = folder.write("a.xmf", text);
  const std::size_t at = text.find("<DataItem", text.find("<Attribute"));
  EXPECT_EQ(refusal(path),
            message.empty() ? "" : fmt::format("{}: byte {}: DataItem: {}", path, at + 1, message))
      << item;
}

std::string slab(const std::string& selection, const std::string& source,
                 const std::string& dimensions = "4") {
  return xdmf_item(dimensions, selection + source, " ItemType=\"HyperSlab\"");
}

TEST(XdmfItems, SlabsSelectByStartStrideAndCount) {
  const std::string row = xdmf_item("9", "0 1 2 3 4 5 6 7 8");
  const auto of_row = [&](const std::string& numbers) {
    return slab(xdmf_item("3", numbers), row);
  };
  EXPECT_THAT(item_values(of_row("0 1 4")), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(item_values(of_row("5 1 4")), ElementsAre(5, 6, 7, 8));
  EXPECT_THAT(item_values(of_row("1 2 4")), ElementsAre(1, 3, 5, 7));
  EXPECT_THAT(item_values(of_row("2 2 4")), ElementsAre(2, 4, 6, 8));
  const std::string beyond = "reaches beyond its source";
  for (const std::string numbers : {"6 1 4", "3 2 4", "-1 1 4", "0 0 4", "0 -1 4", "0 1 0", "9 1 1",
                                    "0 1 -1", "9 2 1", "0 9223372036854775807 4"})
    expect_item(of_row(numbers), beyond);
  expect_item(slab(xdmf_item("2", "0 1"), row),
              "does not say start, stride and count of its source");
  expect_item(slab(xdmf_item("6", "0 1 4 0 1 4"), row),
              "does not say start, stride and count of its source");
  expect_item(of_row("0 1 3"), "holds 3 numbers (4 expected)");
  // 3 x 4 numbers: rows 0 and 2, columns 1 and 3
  const std::string table = xdmf_item("3 4", "0 1 2 3 10 11 12 13 20 21 22 23");
  EXPECT_THAT(item_values(slab(xdmf_item("3 2", "0 1 2 2 2 2"), table)), ElementsAre(1, 3, 21, 23));
  EXPECT_THAT(item_values(slab(xdmf_item("3 2", "1 0 1 1 1 4"), table, "1 4")),
              ElementsAre(10, 11, 12, 13));
  expect_item(slab(xdmf_item("3 2", "0 1 2 2 2 3"), table), beyond);
}

std::string function(const std::string& formula, const std::string& items,
                     const std::string& dimensions = "4") {
  return xdmf_item(dimensions, items, " ItemType=\"Function\" Function=\"" + formula + "\"");
}

TEST(XdmfItems, FunctionsJoinItems) {
  const std::string a = xdmf_item("4", "1 2 3 4");
  const std::string b = xdmf_item("4", "5 6 7 8");
  EXPECT_THAT(item_values(function("JOIN($0, $1)", a + b, "4 2")),
              ElementsAre(1, 5, 2, 6, 3, 7, 4, 8));
  EXPECT_THAT(item_values(function(" join($1; $0)", a + b, "4 2")),
              ElementsAre(5, 1, 6, 2, 7, 3, 8, 4));
  EXPECT_THAT(item_values(function("($1)", a + b)), ElementsAre(5, 6, 7, 8));
  EXPECT_THAT(item_values(function("$0", a)), ElementsAre(1, 2, 3, 4));
  for (const std::string formula : {"$0 + $1", "$0 $1", "", "JOIN()", "ABS($0)", "$0;", "-$0"})
    expect_item(function(formula, a + b),
                "the function '" + formula + "' is not computed (JOIN expected)");
  expect_item(function("JOIN($0, $x)", a + b), "'JOIN($0, $x)' is no function");
  expect_item(function("JOIN($0, $)", a + b), "'JOIN($0, $)' is no function");
  expect_item(function("JOIN($0, $2)", a + b, "4 2"), "has too few DataItems");
  expect_item(function("JOIN($0, $1)", a + xdmf_item("3", "1 2 3")),
              "joins items of different numbers of values");
}

TEST(XdmfItems, AreNestedUpToEightDeep) {
  const auto nested = [](int depth) {
    std::string item = xdmf_item("4", "1 2 3 4");
    for (int i = 1; i < depth; ++i) item = function("$0", item);
    return item;
  };
  EXPECT_THAT(item_values(nested(8)), ElementsAre(1, 2, 3, 4));
  const ScratchFolder folder;
  EXPECT_THAT(refusal(folder.write("a.xmf", with_item(nested(9)))),
              testing::EndsWith(": DataItem: is nested too deeply"));
}

TEST(XdmfItems, TextsAreNumbers) {
  EXPECT_THAT(item_values(xdmf_item("4", "1,+2\n\t-3.5e1 4", " Format=\"xml\"")),
              ElementsAre(1, 2, -35, 4));
  const std::string word = "holds a word that is no number of its type";
  expect_item(xdmf_item("4", "1 2 3 x"), word);
  expect_item(xdmf_item("4", "1 2 3 4x"), word);
  expect_item(xdmf_item("4", "1 2 3 ++4"), word);
  expect_item(xdmf_item("4", "1 2 3"), "holds 3 numbers (4 expected)");
  expect_item(xdmf_item("4", "1 2 3 4 5"), "holds 5 numbers (4 expected)");
  expect_item(xdmf_item("4", "1 2 3 4", " Format=\"CSV\""),
              "is in the format 'CSV' (XML, HDF or Binary expected)");
  expect_item(xdmf_item("4", "1 2 3 4", " ItemType=\"Tree\""),
              "is of the type 'Tree' (Uniform, HyperSlab or Function expected)");
  expect_item("<DataItem>1 2 3 4</DataItem>", "has no Dimensions");
  expect_item(xdmf_item("4 x", "1 2 3 4"), "has no Dimensions");
  expect_item(xdmf_item("4", "a.h5", " Format=\"HDF\""), "'a.h5' names no FILE:/DATASET");
  expect_item(xdmf_item("4", "a.h5", " Format=\"h5\""), "'a.h5' names no FILE:/DATASET");
}

// Without a type, numbers are floats of four bytes; the older name of the type is DataType.
TEST(XdmfItems, TypesOfNumbersAreListed) {
  const std::vector<std::pair<std::string, std::string>> rows{
      {"", "float"},
      {" Precision=\"8\"", "double"},
      {" NumberType=\"float\" Precision=\"4\"", "float"},
      {" NumberType=\"Char\" Precision=\"8\"", "int8"},
      {" NumberType=\"UChar\"", "uint8"},
      {" NumberType=\"Int\"", "int32"},
      {" NumberType=\"UInt\" Precision=\"8\"", "uint64"},
      {" DataType=\"Int\" Precision=\"2\"", "int16"},
      {" NumberType=\"UInt\" DataType=\"Float\"", "uint32"}};
  const ScratchFolder folder;
  for (const auto& [attributes, type] : rows) {
    const std::string path =
        folder.write("a.xmf", with_item(xdmf_item("4", "1 2 3 4", attributes)));
    const Inventory inventory = format_named("xdmf").inspect(path);
    ASSERT_EQ(inventory.fields.size(), 1U);
    EXPECT_EQ(inventory.fields[0].type, type) << attributes;
    EXPECT_EQ(inventory.fields[0].location, "node");
    EXPECT_EQ(inventory.fields[0].tuples, 4U);
  }
}

TEST(XdmfItems, BinaryFilesHaveNumbersOfEveryType) {
  const auto read = [](const std::string& bytes, const std::string& attributes) {
    const ScratchFolder folder;
    static_cast<void>(folder.write("v.bin", bytes));
    const std::string path = folder.write(
        "a.xmf", with_item(xdmf_item("4", " v.bin ", " Format=\"Binary\"" + attributes)));
    const ZooMesh mesh = read_any(path).mesh;
    const auto view = field_named(mesh, "p").values.view();
    return std::vector<double>(view.begin(), view.end());
  };
  const auto type = [](const std::string& name, int precision) {
    return fmt::format(" NumberType=\"{}\" Precision=\"{}\"", name, precision);
  };
  EXPECT_THAT(read(raw_bytes<float>({1, 2, 3, -4}), ""), ElementsAre(1, 2, 3, -4));
  EXPECT_THAT(read(raw_bytes<double>({1, 2, 3, -4}), " Precision=\"8\""), ElementsAre(1, 2, 3, -4));
  EXPECT_THAT(read("\1\2\3\xff", type("Char", 1)), ElementsAre(1, 2, 3, -1));
  EXPECT_THAT(read("\1\2\3\xff", type("uchar", 1)), ElementsAre(1, 2, 3, 255));
  EXPECT_THAT(read("\1\2\3\xff", type("Int", 1)), ElementsAre(1, 2, 3, -1));
  EXPECT_THAT(read("\1\2\3\xff", type("UInt", 1)), ElementsAre(1, 2, 3, 255));
  const std::string shorts = raw_bytes<std::int16_t>({1, 2, 3, -4});
  EXPECT_THAT(read(shorts, type("Int", 2)), ElementsAre(1, 2, 3, -4));
  EXPECT_THAT(read(shorts, type("UInt", 2)), ElementsAre(1, 2, 3, 65532));
  const std::string words = raw_bytes<std::int32_t>({1, 2, 3, -4});
  EXPECT_THAT(read(words, " DataType=\"Int\""), ElementsAre(1, 2, 3, -4));
  EXPECT_THAT(read(words, type("UInt", 4)), ElementsAre(1, 2, 3, 4294967292.0));
  const std::string wide = raw_bytes<std::int64_t>({1, 2, 3, -4});
  EXPECT_THAT(read(wide, type("Int", 8)), ElementsAre(1, 2, 3, -4));
  EXPECT_THAT(read(wide, type("UInt", 8)), ElementsAre(1, 2, 3, 18446744073709551612.0));
  EXPECT_THAT(read(std::string("\0\1\0\2\0\3\1\0", 8), type("Int", 2) + " Endian=\"Big\""),
              ElementsAre(1, 2, 3, 256));
  EXPECT_THAT(read(std::string("\1\0\2\0\3\0\0\1", 8), type("Int", 2) + " Endian=\"Little\""),
              ElementsAre(1, 2, 3, 256));
  EXPECT_THAT(read("xyz" + raw_bytes<float>({1, 2, 3, 4}) + "w", " Seek=\"3\""),
              ElementsAre(1, 2, 3, 4));
}

TEST(XdmfItems, BinaryFilesAreLongEnough) {
  const ScratchFolder folder;
  static_cast<void>(folder.write("v.bin", raw_bytes<float>({1, 2, 3, 4})));
  const auto said = [&](const std::string& attributes) {
    const std::string path = folder.write(
        "a.xmf", with_item(xdmf_item("4", "v.bin", " Format=\"Binary\"" + attributes)));
    const std::string message = refusal(path);
    const std::size_t at = message.find("DataItem: ");
    return at == std::string::npos ? message : message.substr(at + 10);
  };
  EXPECT_EQ(said(""), "");
  EXPECT_EQ(said(" Seek=\"1\""),
            "its binary file ends early (4 numbers from byte 1 on expected, 16 bytes found)");
  EXPECT_EQ(said(" Seek=\"17\""),
            "its binary file ends early (4 numbers from byte 17 on expected, 16 bytes found)");
  EXPECT_EQ(said(" Precision=\"8\""),
            "its binary file ends early (4 numbers from byte 0 on expected, 16 bytes found)");
  EXPECT_EQ(said(" NumberType=\"Int\" Precision=\"2\" Seek=\"8\""), "");
  EXPECT_EQ(said(" NumberType=\"Int\" Precision=\"2\" Seek=\"9\""),
            "its binary file ends early (4 numbers from byte 9 on expected, 16 bytes found)");
  EXPECT_EQ(said(" NumberType=\"Int\" Precision=\"3\""), "holds numbers of the unknown type int24");
}

TEST(XdmfItems, EntitiesStandForTextsUpToTenTimesTheFile) {
  const auto text = [](int uses) {
    std::string values;
    for (int i = 0; i < uses; ++i) values += "&many;";
    return "<!DOCTYPE Xdmf [<!ENTITY many '" + std::string(1000, ' ') + "'><!ENTITY four \"4\">]>" +
           with_item(xdmf_item("4", "1 2 3 &four;" + values));
  };
  expect_xdmf_file(text(1), "");
  expect_xdmf_file(text(12), "");
  expect_xdmf_file(text(40), "its entities make it more than ten times as large");
}

TEST(XdmfItems, EntitiesWithoutAValueAreNone) {
  const auto text = [](const std::string& declarations) {
    return "<!DOCTYPE Xdmf [" + declarations + "]>" + with_item(xdmf_item("4", "1 2 3 &four;"));
  };
  expect_xdmf_file(text("<!ENTITY four \"4\">"), "");
  expect_xdmf_file(text("<!ENTITY four><!ENTITY four \"4\">"), "");
}

TEST(XdmfTimes, MayBeFewerThanTheirGrids) {
  const ScratchFolder folder;
  const auto series = [&](const std::string& time) {
    std::string grids;
    for (int i = 0; i < 3; ++i)
      grids += XdmfGrid{.attribute = "<Attribute Name=\"p\" Center=\"Cell\">" +
                                     xdmf_item("1", std::to_string(i)) + "</Attribute>" +
                                     (i == 1 ? "<Time Value=\"0.25\"/>" : "")}
                   .grid();
    return folder.write(
        "a.xmf", "<Xdmf><Domain><Grid GridType=\"Collection\" CollectionType=\"temporal\">" + time +
                     grids + "</Grid></Domain></Xdmf>");
  };
  const auto times = [&](const std::string& path) {
    return format_named("xdmf").inspect(path).times;
  };
  EXPECT_THAT(times(series("")), ElementsAre(0, 0.25, 2));
  const std::string listed =
      series("<Time TimeType=\"List\">" + xdmf_item("1", "0.125") + "</Time>");
  EXPECT_THAT(times(listed), ElementsAre(0.125, 0.25, 2));
  EXPECT_EQ(read_any(listed).mesh.fields.at(0).values[0], 2);
  ReadOptions options;
  options.time = 0.25;
  EXPECT_EQ(read_any(listed, options).mesh.fields.at(0).values[0], 1);
  EXPECT_THAT(times(series("<Time TimeType=\"HyperSlab\">" + xdmf_item("3", "5 2 3") + "</Time>")),
              ElementsAre(0.25, 5, 9));
}

// As parallel programs write them: a series of each part, all of the same times.
TEST(XdmfTimes, OfSeveralSeriesAreOneList) {
  const ScratchFolder folder;
  std::string parts;
  for (const int part : {0, 1}) {
    parts += "<Grid GridType=\"Collection\" CollectionType=\"Temporal\">";
    for (const int time : {1, 3})
      parts += XdmfGrid{.attribute = "<Attribute Name=\"p\" Center=\"Cell\">" +
                                     xdmf_item("1", fmt::format("{}", 10 * time + part)) +
                                     "</Attribute>" + fmt::format("<Time Value=\"{}\"/>", time)}
                   .grid();
    parts += "</Grid>";
  }
  const std::string path = folder.write(
      "a.xmf", "<Xdmf><Domain><Grid GridType=\"Collection\" CollectionType=\"Spatial\">" + parts +
                   "</Grid></Domain></Xdmf>");
  EXPECT_THAT(format_named("xdmf").inspect(path).times, ElementsAre(1, 3));
  for (const std::size_t step : {0, 1}) {
    ReadOptions options;
    options.step = step;
    const ZooMesh mesh = read_any(path, options).mesh;
    ASSERT_EQ(mesh.cell_count(), 2U);
    EXPECT_THAT(field_named(mesh, "p").values.view(),
                step == 0 ? ElementsAre(10, 11) : ElementsAre(30, 31));
  }
}

TEST(XdmfTimes, GridsBelowASeriesAreNestedUpTo32Deep) {
  const auto nested = [](int trees) {
    std::string text = XdmfGrid{}.grid();
    for (int i = 0; i < trees; ++i) text = "<Grid GridType=\"Tree\">" + text + "</Grid>";
    return "<Xdmf><Domain><Grid GridType=\"Collection\" CollectionType=\"Temporal\">" + text +
           "</Grid></Domain></Xdmf>";
  };
  expect_xdmf_file(nested(31), "");
  expect_xdmf_file(nested(32), "its grids are nested too deeply");
}

TEST(XdmfTimes, FieldsMayBeOfSomeStepsOnly) {
  const ScratchFolder folder;
  const auto attribute = [](const std::string& name, int value) {
    return "<Attribute Name=\"" + name + "\" Center=\"Cell\">" +
           xdmf_item("1", std::to_string(value)) + "</Attribute>";
  };
  const auto step = [](double time, const std::string& attributes) {
    return XdmfGrid{.attribute = attributes + fmt::format("<Time Value=\"{}\"/>", time)}.grid();
  };
  const std::string path = folder.write(
      "a.xmf", "<Xdmf><Domain><Grid GridType=\"Collection\" CollectionType=\"Temporal\">" +
                   step(2, attribute("p", 12) + attribute("q", 22)) + step(1, attribute("p", 11)) +
                   "</Grid></Domain></Xdmf>");
  EXPECT_THAT(format_named("xdmf").inspect(path).times, ElementsAre(1, 2));
  EXPECT_EQ(read_any(path).mesh.fields.size(), 2U);
  EXPECT_EQ(field_named(read_any(path).mesh, "q").values[0], 22);
  ReadOptions options;
  options.step = 0;
  const Reading first = read_any(path, options);
  ASSERT_EQ(first.mesh.fields.size(), 1U);
  EXPECT_EQ(first.mesh.fields[0].values[0], 11);
  EXPECT_THAT(first.notes,
              ElementsAre("field 'q' is absent at step 0, time 1: it has values at step 1"));
}

// The XDMF Model and Format, "Topology"; the numbers of VTK's cells: vtkCellType.h.
TEST(XdmfTopologies, HaveNumbersNodesAndCellsOfVtk) {
  const std::vector<std::tuple<std::string, int, std::size_t, int>> rows{
      {"Polyvertex", 1, 0, 2},        {"Polyline", 2, 0, 4},
      {"Polygon", 3, 0, 7},           {"Triangle", 4, 3, 5},
      {"Quadrilateral", 5, 4, 9},     {"Tetrahedron", 6, 4, 10},
      {"Pyramid", 7, 5, 14},          {"Wedge", 8, 6, 13},
      {"Hexahedron", 9, 8, 12},       {"Edge_3", 34, 3, 21},
      {"Quadrilateral_9", 35, 9, 28}, {"Triangle_6", 36, 6, 22},
      {"Quadrilateral_8", 37, 8, 23}, {"Tetrahedron_10", 38, 10, 24},
      {"Pyramid_13", 39, 13, 27},     {"Wedge_15", 40, 15, 26},
      {"Wedge_18", 41, 18, 32},       {"Hexahedron_20", 48, 20, 25},
      {"Hexahedron_24", 49, 24, 33},  {"Hexahedron_27", 50, 27, 29},
      {"Tet_10", 0, 10, 24},          {"Tri_6", 0, 6, 22},
      {"Hex_20", 0, 20, 25},          {"Hex_24", 0, 24, 33},
      {"Hex_27", 0, 27, 29}};
  for (const auto& [name, number, nodes, vtk_type] : rows) {
    const auto topology = xdmf::topology_named(name);
    ASSERT_TRUE(topology) << name;
    EXPECT_EQ(topology->number, number) << name;
    EXPECT_EQ(topology->nodes, nodes) << name;
    EXPECT_EQ(topology->vtk_type, vtk_type) << name;
  }
  EXPECT_FALSE(xdmf::topology_named("Tetrahedron_1"));
}

}  // namespace
}  // namespace hiac::formats
