// What binary files of Tecplot are refused for, with the byte, and what is just allowed; values of
// every format and neighbours of every kind (Tecplot 360 Data Format Guide, "Binary data").
#include <array>

#include <fmt/format.h>

#include "tests/formats/complaints.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/solver_files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;

/// What the head of a zone of one tetrahedron says.
struct PltZone {
  std::int32_t strand = -1;
  double time = 0;
  std::int32_t type = 4;
  std::int32_t nodes = 4;
  std::int32_t elements = 1;
  std::int32_t raw_neighbours = 0;
  std::int32_t neighbours = 0;
  std::int32_t mode = 0;
};

void put_names(Bytes& out, const std::vector<std::string>& names) {
  out.whole(static_cast<std::int32_t>(names.size()));
  for (const std::string& name : names) out.text(name);
}
void put_zone(Bytes& out, const PltZone& zone) {
  out.mark(299).text("z").wholes({-1, zone.strand}).real(zone.time).wholes({-1, zone.type, 0});
  out.wholes({zone.raw_neighbours, zone.neighbours});
  if (zone.neighbours != 0) out.wholes({zone.mode, 0});
  out.wholes({zone.nodes, zone.elements, 0, 0, 0, 0});
}
/// The coordinates of the unit tetrahedron, and a fourth variable in the given format.
void put_data(Bytes& out, std::int32_t format, const std::string& values) {
  out.mark(299).wholes({2, 2, 2, format, 0, 0, -1});
  for (int i = 0; i < 8; ++i) out.real(0);
  for (const double x : {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) out.real(x);
  out.raw(values).wholes({0, 1, 2, 3});
}

std::string plt_tetrahedron(const PltZone& zone, std::int32_t format, const std::string& values) {
  Bytes out;
  out.raw("#!TDV112").wholes({1, 0}).text("t");
  put_names(out, {"X", "Y", "Z", "v"});
  put_zone(out, zone);
  out.mark(357);
  put_data(out, format, values);
  return out.str();
}

const std::string kFourFloats = Bytes().mark(1).mark(2).mark(3).mark(4).str();

TEST(TecplotBinaryValues, OfEveryFormat) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::int32_t, std::string>> rows{
      {1, kFourFloats},
      {2, Bytes().real(1).real(2).real(3).real(4).str()},
      {3, Bytes().wholes({1, 2, 3, 4}).str()},
      {4, std::string("\1\0\2\0\3\0\4\0", 8)},
      {5, "\1\2\3\4"}};
  for (const auto& [format, values] : rows) {
    const ZooMesh mesh = read_any(folder.write("a.plt", plt_tetrahedron({}, format, values))).mesh;
    expect_unit_tetrahedron(mesh);
    EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4)) << format;
  }
  expect_complaints("b.plt", {{plt_tetrahedron({}, 0, kFourFloats),
                               ": at byte 328: values of the format 0 (1 to 5 expected)"},
                              {plt_tetrahedron({}, 6, kFourFloats),
                               ": at byte 328: values of the format 6 (1 to 5 expected)"},
                              {plt_tetrahedron({}, -1, kFourFloats),
                               ": at byte 328: values of the format -1 (1 to 5 expected)"}});
}

TEST(TecplotBinaryComplaints, HeadsOfFiles) {
  const auto head = [](std::int32_t order, std::int32_t type,
                       const std::vector<std::string>& names) {
    Bytes out;
    out.raw("#!TDV112").wholes({order, type}).text("t");
    put_names(out, names);
    return out.mark(357).str();
  };
  const auto mark = [](float value) {
    Bytes out;
    out.raw("#!TDV112").wholes({1, 0}).text("t");
    put_names(out, {"X", "Y", "Z"});
    return out.mark(value).str();
  };
  expect_complaints(
      "a.plt",
      {{head(1, 0, {"X", "Y"}),
        ": three coordinates expected among the variables (2 variables found)"},
       {head(1, 2, {"X", "Y", "Z"}),
        ": at byte 16: a file of solutions alone (one with the grid expected)"},
       {head(2, 0, {"X", "Y", "Z"}),
        ": at byte 12: 1 expected as the mark of the byte order (2 found)"},
       {mark(358),
        ": at byte 56: a zone, auxiliary data or the header's end expected (the mark 358 found; "
        "texts and geometries are not read)"},
       {mark(499),
        ": at byte 56: a zone, auxiliary data or the header's end expected (the mark 499 found; "
        "texts and geometries are not read)"}});
  // a file of a grid alone is read as one with both
  const ScratchFolder folder;
  std::string grid = plt_tetrahedron({}, 1, kFourFloats);
  grid[12] = 1;
  expect_unit_tetrahedron(read_any(folder.write("g.plt", grid)).mesh);
}

TEST(TecplotBinaryComplaints, HeadsOfZones) {
  const auto zone = [](const PltZone& head) { return plt_tetrahedron(head, 1, kFourFloats); };
  expect_complaints(
      "a.plt",
      {{zone({}), ""},
       {zone({.type = 8}), ": at byte 96: zone 'z': type 8 is not known (0 to 7 expected)"},
       {zone({.type = -1}), ": at byte 96: zone 'z': type -1 is not known (0 to 7 expected)"},
       {zone({.nodes = -4}), ": at byte 112: the number of nodes: not a count (-4 found)"},
       {zone({.elements = -1}), ": at byte 116: the number of elements: not a count (-1 found)"},
       {zone({.nodes = 9999}),
        ": at byte 116: zone 'z': more nodes than the file holds (9999 found)"},
       {zone({.elements = 9999}),
        ": at byte 116: zone 'z': more elements than the file holds (9999 found)"}});
}

TEST(TecplotBinaryValues, NeighboursArePassedOver) {
  const ScratchFolder folder;
  // raw ones: one a face
  const std::string raw =
      plt_tetrahedron({.raw_neighbours = 1}, 1, kFourFloats) + Bytes().wholes({0, 0, 0, 0}).str();
  const Reading reading = read_any(folder.write("a.plt", raw));
  expect_unit_tetrahedron(reading.mesh);
  EXPECT_TRUE(reading.notes.empty());
  EXPECT_NE(refusal(folder.write("a.plt", raw.substr(0, raw.size() - 1))), "");
  // local one to one: cell, face, neighbour; local one to many: cell, face, whether blocked, count,
  // neighbours; global: zones with the neighbours
  const std::vector<std::pair<std::int32_t, Bytes>> rows{
      {0, Bytes().wholes({1, 2, 3})},
      {1, Bytes().wholes({1, 2, 0, 3, 7, 8, 9})},
      {2, Bytes().wholes({1, 2, 5, 3})},
      {3, Bytes().wholes({1, 2, 0, 2, 5, 7, 5, 8})}};
  for (const auto& [mode, data] : rows) {
    const std::string text =
        plt_tetrahedron({.neighbours = 2, .mode = mode}, 1, kFourFloats) + data.str() + data.str();
    const Reading read = read_any(folder.write("b.plt", text));
    expect_unit_tetrahedron(read.mesh);
    EXPECT_TRUE(read.notes.empty()) << mode;
    EXPECT_NE(refusal(folder.write("b.plt", text.substr(0, text.size() - 1))), "") << mode;
  }
}

TEST(TecplotBinaryValues, ZonesWithAStrandOrATimeAreOfThatTime) {
  const ScratchFolder folder;
  const auto times = [&](std::int32_t strand, double time) {
    const std::string path =
        folder.write("a.plt", plt_tetrahedron({.strand = strand, .time = time}, 1, kFourFloats));
    return format_named("tecplot").inspect(path).times;
  };
  EXPECT_THAT(times(-1, 0), ElementsAre());
  EXPECT_THAT(times(0, 0), ElementsAre());
  EXPECT_THAT(times(1, 0), ElementsAre(0));
  EXPECT_THAT(times(-2, 0), ElementsAre(0));
  EXPECT_THAT(times(-1, 0.5), ElementsAre(0.5));
}

TEST(TecplotBinaryValues, OrderedZonesOfNoThicknessHaveNoVolume) {
  const ScratchFolder folder;
  for (const auto& [sizes, cells] : std::vector<std::pair<std::array<std::int32_t, 3>, int>>{
           {{4, 3, 1}, 6}, {{1, 4, 3}, 6}, {{12, 1, 1}, 11}, {{3, 1, 4}, 6}}) {
    Bytes out;
    out.raw("#!TDV112").wholes({1, 0}).text("t");
    put_names(out, {"X", "Y", "Z", "v"});
    put_zone(out, {});
    out.mark(299).text("s").wholes({-1, -1}).real(0).wholes({-1, 0, 0, 0, 0});
    out.wholes({sizes[0], sizes[1], sizes[2], 0}).mark(357);
    put_data(out, 1, kFourFloats);
    out.mark(299).wholes({5, 5, 5, 5, 0, 0, -1});
    for (int i = 0; i < 8; ++i) out.real(0);
    const Reading reading = read_any(folder.write("a.plt", out.str() + std::string(48, '\1')));
    expect_unit_tetrahedron(reading.mesh);
    EXPECT_THAT(reading.notes,
                testing::Contains(fmt::format(
                    "dropped cells without volume: {} ordered surface or line", cells)));
  }
}

/// Two zones, of which the second shares a variable or the elements.
std::string plt_sharing(std::int32_t zone_of_v, std::int32_t zone_of_cells,
                        const PltZone& second = {}) {
  Bytes out;
  out.raw("#!TDV112").wholes({1, 0}).text("t");
  put_names(out, {"X", "Y", "Z", "v"});
  put_zone(out, {});
  put_zone(out, second);
  out.mark(357);
  put_data(out, 1, kFourFloats);
  out.mark(299).wholes({2, 2, 2, 1, 0, 1, -1, -1, -1, zone_of_v, zone_of_cells});
  for (int i = 0; i < (zone_of_v == -1 ? 8 : 6); ++i) out.real(0);
  for (const double x : {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) out.real(x);
  if (zone_of_v == -1) out.raw(kFourFloats);
  if (zone_of_cells == -1) out.wholes({0, 1, 2, 3});
  return out.str();
}

TEST(TecplotBinaryComplaints, ZonesShareWithEarlierOnes) {
  const auto byte = [](const std::string& text) {
    const std::size_t at = text.find(": zone");
    return text.substr(at == std::string::npos ? 0 : at);
  };
  const ScratchFolder folder;
  const auto said = [&](const std::string& text) {
    const std::string message = refusal(folder.write("a.plt", text));
    EXPECT_TRUE(message.empty() || message.find("a.plt: at byte ") != std::string::npos) << message;
    return byte(message);
  };
  EXPECT_EQ(said(plt_sharing(-1, -1)), "");
  EXPECT_EQ(said(plt_sharing(0, 0)), "");
  EXPECT_EQ(said(plt_sharing(1, -1)),
            ": zone 'z' shares with zone 1, which does not come before it");
  EXPECT_EQ(said(plt_sharing(-2, -1)),
            ": zone 'z' shares with zone -2, which does not come before it");
  EXPECT_EQ(said(plt_sharing(-1, 1)),
            ": zone 'z' shares with zone 1, which does not come before it");
  EXPECT_EQ(said(plt_sharing(0, -1, {.nodes = 5})), ": zone 'z' shares a variable of another size");
  EXPECT_EQ(said(plt_sharing(-1, 0, {.elements = 2})),
            ": zone 'z' shares elements of another size");
  EXPECT_EQ(said(plt_sharing(-1, 0, {.type = 3})), ": zone 'z' shares elements of another size");
  const ZooMesh mesh = read_any(folder.write("b.plt", plt_sharing(0, 0))).mesh;
  ASSERT_EQ(mesh.cell_count(), 2U);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4, 1, 2, 3, 4));
}

}  // namespace
}  // namespace hiac::formats
