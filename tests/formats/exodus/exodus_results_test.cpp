// What Exodus files hold besides elements: blocks, variables on nodes and on some blocks' elements,
// steps, the old layout, and elements with nodes in faces. Written through netCDF after the data
// model's document (SAND92-2137).
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <netcdf.h>

#include "formats/common/pieces/piece_field.hpp"
#include "hiac/mesh/zoo_mesh.hpp"
#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/damage.hpp"
#include "tests/formats/field_named.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

void check(int status) { ASSERT_EQ(status, NC_NOERR) << nc_strerror(status); }

/// An Exodus file in the making.
class ExodusFile {
 public:
  ExodusFile(const std::string& path, std::size_t nodes, std::size_t blocks, std::size_t steps) {
    check(nc_create(path.c_str(), NC_CLOBBER, &file_));
    length("time_step", steps == 0 ? NC_UNLIMITED : steps);
    length("num_nodes", nodes);
    length("num_el_blk", blocks);
    length("num_dim", 3);
    length("len_string", 33);
  }
  ~ExodusFile() { check(nc_close(file_)); }
  ExodusFile(const ExodusFile&) = delete;
  ExodusFile& operator=(const ExodusFile&) = delete;

  void length(const std::string& name, std::size_t size) {
    check(nc_def_dim(file_, name.c_str(), size, &lengths_[name]));
  }
  void reals(const std::string& name, const std::vector<std::string>& along,
             const std::vector<double>& values) {
    check(nc_put_var_double(file_, variable(name, NC_DOUBLE, along), values.data()));
    check(nc_redef(file_));
  }
  void integers(const std::string& name, const std::vector<std::string>& along,
                const std::vector<int>& values, const std::string& element = "") {
    const int id = variable(name, NC_INT, along, element);
    check(nc_put_var_int(file_, id, values.data()));
    check(nc_redef(file_));
  }
  void names(const std::string& name, const std::string& along,
             const std::vector<std::string>& texts) {
    std::string padded;
    for (std::string text : texts) {
      text.resize(33);
      padded += text;
    }
    check(nc_put_var_text(file_, variable(name, NC_CHAR, {along, "len_string"}), padded.c_str()));
    check(nc_redef(file_));
  }
  void title(const std::string& text) {
    check(nc_put_att_text(file_, NC_GLOBAL, "title", text.size(), text.c_str()));
  }

 private:
  int variable(const std::string& name, nc_type type, const std::vector<std::string>& along,
               const std::string& element = "") {
    std::vector<int> ids;
    for (const std::string& length : along) ids.push_back(lengths_.at(length));
    int id = 0;
    check(nc_def_var(file_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &id));
    if (!element.empty())
      check(nc_put_att_text(file_, id, "elem_type", element.size(), element.c_str()));
    check(nc_enddef(file_));
    return id;
  }

  int file_ = 0;
  std::map<std::string, int> lengths_;
};

// A brick [0, 1]^3, a pyramid on its top with a tetrahedron beside it, and a node of no cell.
const std::vector<std::vector<double>> kAxes{{0, 1, 1, 0, 0, 1, 1, 0, 0.5, 9, 2},
                                             {0, 0, 1, 1, 0, 0, 1, 1, 0.5, 9, 0},
                                             {0, 0, 0, 0, 1, 1, 1, 1, 2, 9, 1.5}};
constexpr std::size_t kNodes = 11;

/// The value of a variable on a node or a cell at a step.
double value_of(int variable, std::size_t step, std::size_t item) {
  return 1000 * variable + 100 * static_cast<double>(step) + static_cast<double>(item);
}

/// `old`: all coordinates in one array, and all variables of nodes in one.
void write_blocks(const std::string& path, bool old, bool named) {
  ExodusFile file(path, kNodes, 3, 3);
  file.title("three blocks");
  file.length("num_nod_var", 2);
  file.length("num_elem_var", 2);
  file.length("num_glo_var", 4);
  file.length("num_ed_blk", 1);
  if (old) {
    std::vector<double> all;
    for (const auto& axis : kAxes) all.insert(all.end(), axis.begin(), axis.end());
    file.reals("coord", {"num_dim", "num_nodes"}, all);
  } else {
    for (std::size_t d = 0; d < 3; ++d)
      file.reals(
          std::string("coord") + "xyz" [d], { "num_nodes" }, kAxes[d]);
  }
  file.integers("eb_prop1", {"num_el_blk"}, {10, 20, 5});
  if (named) file.names("eb_names", "num_el_blk", {"base", "roof", ""});
  const std::vector<std::vector<int>> cells{{1, 2, 3, 4, 5, 6, 7, 8}, {1, 2, 3}, {5, 6, 7, 8, 9}};
  const std::vector<std::string> elements{"HEX8", "TRI3", "PYRAMID5"};
  for (std::size_t b = 1; b <= 3; ++b) {
    file.length(fmt::format("num_el_in_blk{}", b), 1);
    file.length(fmt::format("num_nod_per_el{}", b), cells[b - 1].size());
    file.integers(fmt::format("connect{}", b),
                  {fmt::format("num_el_in_blk{}", b), fmt::format("num_nod_per_el{}", b)},
                  cells[b - 1], elements[b - 1]);
  }
  file.reals("time_whole", {"time_step"}, {0, 0.5, 2});
  file.names("name_nod_var", "num_nod_var", {"temp", "p"});
  file.names("name_elem_var", "num_elem_var", {"stress", "eqps"});
  std::vector<double> all;
  for (std::size_t step = 0; step < 3; ++step)
    for (const int variable : {1, 2})
      for (std::size_t n = 0; n < kNodes; ++n) all.push_back(value_of(variable, step, n));
  if (old) {
    file.reals("vals_nod_var", {"time_step", "num_nod_var", "num_nodes"}, all);
  } else {
    for (const int variable : {1, 2}) {
      std::vector<double> own;
      for (std::size_t step = 0; step < 3; ++step)
        for (std::size_t n = 0; n < kNodes; ++n) own.push_back(value_of(variable, step, n));
      file.reals(fmt::format("vals_nod_var{}", variable), {"time_step", "num_nodes"}, own);
    }
  }
  // the truth table: variable 1 on the blocks 1 and 2, variable 2 on the block 3 alone
  for (const auto& [variable, block] : {std::pair(1, 1), std::pair(1, 2), std::pair(2, 3)}) {
    std::vector<double> own;
    for (std::size_t step = 0; step < 3; ++step)
      own.push_back(value_of(variable + 2, step, static_cast<std::size_t>(block)));
    file.reals(fmt::format("vals_elem_var{}eb{}", variable, block),
               {"time_step", fmt::format("num_el_in_blk{}", block)}, own);
  }
}

TEST(ExodusResults, BytesBehindAClassicFileAreTold) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.e");
  for (const bool old : {false, true}) {
    write_blocks(path, old, false);
    EXPECT_THAT(read_any(path).notes, Not(Contains(HasSubstr("behind"))));
    std::ofstream(path, std::ios::binary | std::ios::app) << "stray";
    EXPECT_THAT(read_any(path).notes,
                Contains("5 bytes behind the end of the netCDF file's data are not read"));
  }
}

TEST(ExodusResults, VariablesOfStepsAndBlocksInEitherLayout) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.e");
  for (const bool old : {false, true}) {
    SCOPED_TRACE(old);
    write_blocks(path, old, false);
    const Inventory inventory = format_to_read(path).inspect(path);
    EXPECT_EQ(inventory.points, kNodes);
    EXPECT_THAT(inventory.times, ElementsAre(0, 0.5, 2));
    EXPECT_THAT(inventory.blocks, ElementsAre("10", "20", "5"));
    ASSERT_EQ(inventory.fields.size(), 4U);
    EXPECT_EQ(inventory.fields[1].low, 2200);
    EXPECT_EQ(inventory.fields[1].high, 2210);
    for (std::size_t step = 0; step < 3; ++step) {
      ReadOptions options;
      options.step = step;
      const ZooMesh mesh = read_any(path, options).mesh;
      EXPECT_THAT(std::vector<CellKind>(mesh.kinds.begin(), mesh.kinds.end()),
                  ElementsAre(CellKind::brick8, CellKind::pyramid5));
      ASSERT_EQ(mesh.node_count(), 9U);
      EXPECT_NEAR(volume_of(mesh, 0), 1, 1e-15);
      EXPECT_NEAR(volume_of(mesh, 1), 1.0 / 3, 1e-15);
      for (std::size_t n = 0; n < 9; ++n) {
        EXPECT_EQ(field_named(mesh, "temp").values[n], value_of(1, step, n));
        EXPECT_EQ(field_named(mesh, "p").values[n], value_of(2, step, n));
      }
      const Field& stress = field_named(mesh, "stress");
      EXPECT_EQ(stress.location, FieldLocation::cell);
      EXPECT_EQ(stress.values[0], value_of(3, step, 1));
      EXPECT_TRUE(std::isnan(stress.values[1]));
      EXPECT_TRUE(std::isnan(field_named(mesh, "eqps").values[0]));
      EXPECT_EQ(field_named(mesh, "eqps").values[1], value_of(4, step, 3));
    }
    const Reading last = read_any(path);
    EXPECT_EQ(field_named(last.mesh, "temp").values[3], value_of(1, 2, 3));
    EXPECT_THAT(last.mesh.metadata,
                Contains(std::pair<std::string, std::string>("title", "three blocks")));
    EXPECT_THAT(last.notes, Contains(HasSubstr("last of 3 steps, time 2")));
    EXPECT_THAT(last.notes, Contains(HasSubstr("left out 1 edge and 0 face blocks")));
    EXPECT_THAT(last.notes, Contains(HasSubstr("left out 4 global variables")));
    EXPECT_THAT(last.notes, Contains(HasSubstr("1 TRI3")));
    ReadOptions missing;
    missing.step = 3;
    EXPECT_THROW(read_any(path, missing), UsageError);
  }
}

TEST(ExodusResults, BlocksAreCalledByNameOrId) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.e");
  write_blocks(path, false, true);
  EXPECT_THAT(format_to_read(path).inspect(path).blocks, ElementsAre("base", "roof", "5"));
  ReadOptions options;
  options.block = "5";
  options.time = 0.5;
  const ZooMesh part = read_any(path, options).mesh;
  ASSERT_EQ(part.cell_count(), 1U);
  EXPECT_EQ(part.kinds[0], CellKind::pyramid5);
  ASSERT_EQ(part.node_count(), 5U);
  EXPECT_EQ(field_named(part, "temp").values[0], value_of(1, 1, 4));
  EXPECT_EQ(field_named(part, "eqps").values[0], value_of(4, 1, 3));
}

/// A quadratic map, which the serendipity kinds hold.
Vector bent(const Vector& p) {
  return {p[0] + 0.125 * p[1] * p[1], p[1] - 0.0625 * p[2] * p[0], p[2] + 0.25 * p[0] * p[1]};
}

/// One cell with the nodes of the serendipity kind in the format's order, and others at means of
/// corners.
struct RichElement {
  std::string name;
  CellKind kind;
  std::vector<Vector> corners;
  std::vector<std::vector<std::size_t>> means;
};

const std::vector<RichElement> kRich{{"HEX27",
                                      CellKind::brick20,
                                      kBrickCorners,
                                      {{0, 1},
                                       {1, 2},
                                       {2, 3},
                                       {3, 0},
                                       {0, 4},
                                       {1, 5},
                                       {2, 6},
                                       {3, 7},
                                       {4, 5},
                                       {5, 6},
                                       {6, 7},
                                       {7, 4},
                                       {0, 1, 2, 3, 4, 5, 6, 7},
                                       {0, 1, 2, 3},
                                       {4, 5, 6, 7},
                                       {0, 3, 7, 4},
                                       {1, 2, 6, 5},
                                       {0, 1, 5, 4},
                                       {2, 3, 7, 6}}},
                                     {"WEDGE18",
                                      CellKind::prism15,
                                      kPrismCorners,
                                      {{0, 1},
                                       {1, 2},
                                       {2, 0},
                                       {0, 3},
                                       {1, 4},
                                       {2, 5},
                                       {3, 4},
                                       {4, 5},
                                       {5, 3},
                                       {0, 1, 4, 3},
                                       {1, 2, 5, 4},
                                       {0, 2, 5, 3}}}};

TEST(ExodusResults, CurvedElementsLoseTheNodesInTheirFaces) {
  const ScratchFolder folder;
  const std::string path = folder.file("rich.e");
  for (const RichElement& element : kRich) {
    SCOPED_TRACE(element.name);
    std::vector<Vector> points = element.corners;
    for (const auto& mean : element.means) {
      Vector p{};
      for (const std::size_t corner : mean)
        for (std::size_t c = 0; c < 3; ++c)
          p[c] += element.corners[corner][c] / static_cast<double>(mean.size());
      points.push_back(p);
    }
    {
      ExodusFile file(path, points.size(), 1, 1);
      std::vector<int> nodes;
      for (std::size_t d = 0; d < 3; ++d) {
        std::vector<double> axis;
        for (const Vector& p : points) axis.push_back(bent(p)[d]);
        file.reals(
            std::string("coord") + "xyz" [d], { "num_nodes" }, axis);
      }
      for (std::size_t n = 1; n <= points.size(); ++n) nodes.push_back(static_cast<int>(n));
      file.length("num_el_in_blk1", 1);
      file.length("num_nod_per_el1", points.size());
      file.integers("connect1", {"num_el_in_blk1", "num_nod_per_el1"}, nodes, element.name);
    }
    const ZooMesh mesh = read_any(path).mesh;
    ASSERT_EQ(mesh.cell_count(), 1U);
    ASSERT_EQ(mesh.kinds[0], element.kind);
    EXPECT_EQ(mesh.node_count(), node_count(element.kind));
    const bool prism = shape_of(element.kind) == CellShape::prism;
    for (std::size_t n = 0; n < node_count(element.kind); ++n) {
      const Vector expected = bent(reference_nodes(element.kind)[n]);
      const auto found = mesh.position(mesh.cell_nodes(0)[n]);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-15) << n;
    }
    ReadOptions corners;
    corners.corners_of_unsupported = true;
    EXPECT_EQ(read_any(path, corners).mesh.kinds[0], prism ? CellKind::prism6 : CellKind::brick8);
  }
}

TEST(ExodusResults, DamagedFilesAreRefusedOrValid) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.e");
  for (const bool old : {false, true}) {
    write_blocks(path, old, true);
    EXPECT_EQ(expect_cuts_survived(path, 24), 24U);
    expect_changes_survived(path, 16);
  }
}

TEST(ExodusResults, FilesWithoutVolumeAreRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("flat.e");
  {
    ExodusFile file(path, 3, 1, 1);
    for (const char* axis : {"coordx", "coordy", "coordz"})
      file.reals(axis, {"num_nodes"}, {0, 1, 2});
    file.length("num_el_in_blk1", 1);
    file.length("num_nod_per_el1", 3);
    file.integers("connect1", {"num_el_in_blk1", "num_nod_per_el1"}, {1, 2, 3}, "TRI");
  }
  EXPECT_THAT(refusal(path), HasSubstr("holds no volume cells"));
}

// Two tetrahedra on either side of a face, one in each piece of a run of two; the second block has
// no cell in the first piece.
void write_run_piece(const std::string& path, bool second, const std::vector<int>& numbers) {
  ExodusFile file(path, 4, 2, 1);
  const double top = second ? 1 : 0;
  file.reals("coordx", {"num_nodes"}, {top, 1, 0, 0});
  file.reals("coordy", {"num_nodes"}, {top, 0, 1, 0});
  file.reals("coordz", {"num_nodes"}, {top, 0, 0, 1});
  file.length("block", 1);
  file.length("four", 4);
  file.integers(second ? "connect2" : "connect1", {"block", "four"},
                second ? std::vector{2, 3, 4, 1} : std::vector{1, 2, 3, 4}, "TET4");
  if (!numbers.empty()) file.integers("node_num_map", {"num_nodes"}, numbers);
  file.reals("time_whole", {"time_step"}, {2});
  file.length("num_elem_var", 1);
  file.names("name_elem_var", "num_elem_var", {"p"});
  file.reals(second ? "vals_elem_var1eb2" : "vals_elem_var1eb1", {"time_step", "block"},
             {second ? 7.0 : 6.0});
}

TEST(ExodusRuns, PiecesAreOneMesh) {
  for (const bool mapped : {true, false}) {
    const ScratchFolder folder;
    write_run_piece(folder.file("a.e.2.0"), false,
                    mapped ? std::vector{9, 1, 2, 3} : std::vector<int>{});
    EXPECT_THAT(refusal(folder.file("a.e.2.0")), HasSubstr("a.e.2.1 is missing"));
    write_run_piece(folder.file("a.e.2.1"), true,
                    mapped ? std::vector{8, 1, 2, 3} : std::vector<int>{});
    const std::string path = folder.file("a.e.2.1");  // any piece names the run
    const Reading whole = read_any(path);
    EXPECT_EQ(whole.mesh.cell_count(), 2U);
    EXPECT_EQ(whole.mesh.node_count(), 5U);
    EXPECT_NEAR(volume_of(whole.mesh), 1.0 / 6 + 1.0 / 3, 1e-15);
    ASSERT_EQ(whole.mesh.fields.size(), 1U);
    EXPECT_THAT(field_named(whole.mesh, "p").values.view(), ElementsAre(6, 7));
    EXPECT_THAT(whole.mesh.metadata, Contains(testing::Pair("pieces", "2")));
    EXPECT_THAT(whole.mesh.metadata, Contains(testing::Pair("source", "a.e.2.1")));
    EXPECT_THAT(whole.notes, Contains("read the 2 pieces of a run"));
    EXPECT_THAT(whole.notes,
                Contains(HasSubstr(mapped ? "by their 'node_num_map'" : "by their equal")));
    const PieceMarking marking;
    ZooMesh marked = read_any(path).mesh;
    EXPECT_THAT(*take_pieces(marked), ElementsAre(0, 1));
    EXPECT_EQ(content_hash(marked), content_hash(whole.mesh));
    const Inventory inventory = format_to_read(path).inspect(path);
    EXPECT_EQ(inventory.points, 8U);
    EXPECT_EQ(inventory.fields.size(), 1U);
  }
}

TEST(ExodusRuns, OtherNamesAreReadAlone) {
  const ScratchFolder folder;
  for (const char* name : {"a.2.2", "b.02.1", "c.1.0", "d.10.1", "2.0", "e.2a.1b", "f.2.b"}) {
    write_run_piece(folder.file(name), false, {1, 2, 3, 4});
    EXPECT_EQ(read_any(folder.file(name)).mesh.cell_count(), 1U) << name;
  }
}

}  // namespace
}  // namespace hiac::formats
