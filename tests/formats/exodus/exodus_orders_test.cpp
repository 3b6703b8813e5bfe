// The node order of every element that is read from Exodus files, by files of one cell written
// through netCDF. The elements as in the data model's document (SAND92-2137), section 4.8.
#include <cmath>

#include <netcdf.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/one_cell.hpp"

namespace hiac::formats {
namespace {

const std::vector<DocumentedElement> kElements{
    {"TETRA4", CellKind::tetrahedron4, kTetraCorners, {}},
    {"tetra10",
     CellKind::tetrahedron10,
     kTetraCorners,
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
     1},
    {"PYRAMID", CellKind::pyramid5, kPyramidCorners, {}},
    {"PYRAMID13",
     CellKind::pyramid13,
     kPyramidCorners,
     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
     1},
    {"WEDGE", CellKind::prism6, kPrismCorners, {}},
    {"WEDGE15",
     CellKind::prism15,
     kPrismCorners,
     {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}},
     1},
    {"HEX", CellKind::brick8, kBrickCorners, {}},
    {"HEX20",
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
      {7, 4}},
     1}};

void check(int status) { ASSERT_EQ(status, NC_NOERR) << nc_strerror(status); }

/// A file of one cell and a nodal variable at one step.
void write_cell(const std::string& path, const DocumentedElement& element, int mode) {
  const std::vector<Vector> points = placed_points(element);
  int file = 0;
  check(nc_create(path.c_str(), NC_CLOBBER | mode, &file));
  const auto dimension = [&](const char* name, std::size_t length) {
    int id = 0;
    check(nc_def_dim(file, name, length, &id));
    return id;
  };
  const auto variable = [&](const char* name, nc_type type, std::vector<int> dimensions) {
    int id = 0;
    check(
        nc_def_var(file, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
    return id;
  };
  const int steps = dimension("time_step", NC_UNLIMITED);
  const int nodes = dimension("num_nodes", points.size());
  const int cells = dimension("num_el_in_blk1", 1);
  const int per_cell = dimension("num_nod_per_el1", points.size());
  const int length = dimension("len_string", 33);
  const int variables = dimension("num_nod_var", 1);
  dimension("num_dim", 3);
  dimension("num_elem", 1);
  dimension("num_el_blk", 1);
  const std::array<int, 3> axes{variable("coordx", NC_DOUBLE, {nodes}),
                                variable("coordy", NC_DOUBLE, {nodes}),
                                variable("coordz", NC_DOUBLE, {nodes})};
  const int connect = variable("connect1", NC_INT, {cells, per_cell});
  check(nc_put_att_text(file, connect, "elem_type", element.name.size(), element.name.c_str()));
  const int names = variable("name_nod_var", NC_CHAR, {variables, length});
  const int values = variable("vals_nod_var1", NC_DOUBLE, {steps, nodes});
  const int times = variable("time_whole", NC_DOUBLE, {steps});
  check(nc_enddef(file));
  std::vector<double> p;
  std::vector<int> ids;
  for (std::size_t i = 0; i < points.size(); ++i) {
    p.push_back(polynomial(element.kind, points[i]));
    ids.push_back(static_cast<int>(i) + 1);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> axis;
    for (const Vector& point : points) axis.push_back(point[d]);
    check(nc_put_var_double(file, axes[d], axis.data()));
  }
  check(nc_put_var_int(file, connect, ids.data()));
  const std::array<char, 33> name{"p"};
  check(nc_put_var_text(file, names, name.data()));
  const std::array<std::size_t, 2> start{0, 0};
  const std::array<std::size_t, 2> count{1, points.size()};
  check(nc_put_vara_double(file, values, start.data(), count.data(), p.data()));
  const double time = 0.5;
  check(nc_put_vara_double(file, times, start.data(), count.data(), &time));
  check(nc_close(file));
}

TEST(ExodusOrders, OneCellFilesHavePositiveJacobiansAndTheirField) {
  const ScratchFolder folder;
  for (const DocumentedElement& element : kElements)
    for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4 | NC_CLASSIC_MODEL}) {
      const std::string path = folder.file("cell.e");
      write_cell(path, element, mode);
      ASSERT_EQ(format_to_read(path).name, "exodus") << mode;
      const Reading reading = read_any(path);
      expect_one_cell(reading.mesh, element);
      EXPECT_EQ(reading.mesh.metadata.back().second, "0.5");
    }
}

// Every way of cutting a file off is seen, although netCDF makes zeros of what is missing
/// Writes integers, each list along a dimension of its own.
class Integers {
 public:
  explicit Integers(int file) : file_(file) {}
  void dimension(const std::string& name, std::size_t length) const {
    int id = 0;
    check(nc_def_dim(file_, name.c_str(), length, &id));
  }
  void put(const std::string& name, const std::vector<int>& values,
           const std::string& elements = "") const {
    int id = 0;
    int length = 0;
    check(nc_def_dim(file_, ("length of " + name).c_str(), values.size(), &length));
    check(nc_def_var(file_, name.c_str(), NC_INT, 1, &length, &id));
    if (!elements.empty())
      check(nc_put_att_text(file_, id, "elem_type", elements.size(), elements.c_str()));
    check(nc_enddef(file_));
    check(nc_put_var_int(file_, id, values.data()));
    check(nc_redef(file_));
  }

 private:
  int file_;
};

// Two tetrahedra over one face, as the Exodus II library writes polyhedra (blocks "nsided" of
// faces, a block "nfaced" of elements), and a polygon.
TEST(ExodusPolyhedra, FacesMakeTheirCells) {
  const ScratchFolder folder;
  const std::string path = folder.file("poly.e");
  int file = 0;
  check(nc_create(path.c_str(), NC_CLOBBER, &file));
  const Integers integers(file);
  integers.dimension("num_nodes", 5);
  integers.dimension("num_dim", 3);
  integers.dimension("num_el_blk", 2);
  integers.dimension("num_fa_blk", 2);
  integers.put("coordx", {0, 1, 0, 0, 1});
  integers.put("coordy", {0, 0, 1, 0, 1});
  integers.put("coordz", {0, 0, 0, 1, 1});
  integers.put("fbconn1", {1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3}, "nsided");
  integers.put("fbepecnt1", {3, 3, 3, 3});
  integers.put("fbconn2", {2, 3, 5, 3, 4, 5, 2, 5, 4}, "nsided");
  integers.put("fbepecnt2", {3, 3, 3});
  integers.put("facconn1", {1, 2, 3, 4, 3, 5, 6, 7}, "nfaced");
  integers.put("ebepecnt1", {4, 4});
  integers.put("connect2", {1, 2, 5, 3}, "nsided");
  integers.put("ebepecnt2", {4});
  check(nc_close(file));
  const Reading reading = read_any(path);
  ASSERT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_EQ(reading.mesh.kinds[0], CellKind::tetrahedron4);
  EXPECT_NEAR(volume_of(reading.mesh, 0), 1.0 / 6, 1e-12);
  EXPECT_NEAR(std::abs(volume_of(reading.mesh, 1)), 1.0 / 3, 1e-12);
  EXPECT_THAT(reading.notes, testing::Contains(testing::HasSubstr("2 polyhedra have the faces")));
  EXPECT_THAT(reading.notes, testing::Contains(testing::HasSubstr("without volume: 1 nsided")));
}

TEST(ExodusPolyhedra, ListsThatDoNotFitAreRefused) {
  const ScratchFolder folder;
  for (const auto& [faces, counts, message] :
       std::vector<std::tuple<std::vector<int>, std::vector<int>, std::string>>{
           {{1, 2, 3, 5}, {4}, "names face 5"},
           {{1, 1, 1, 4}, {4}, "more than twice"},
           {{1, 2, 3, 4}, {5}, "does not fit 'facconn1'"}}) {
    const std::string path = folder.file("poly.e");
    int file = 0;
    check(nc_create(path.c_str(), NC_CLOBBER, &file));
    const Integers integers(file);
    integers.dimension("num_nodes", 4);
    integers.dimension("num_dim", 3);
    integers.dimension("num_el_blk", 1);
    integers.dimension("num_fa_blk", 1);
    integers.put("coordx", {0, 1, 0, 0});
    integers.put("coordy", {0, 0, 1, 0});
    integers.put("coordz", {0, 0, 0, 1});
    integers.put("fbconn1", {1, 3, 2, 1, 2, 4, 2, 3, 4, 1, 4, 3}, "nsided");
    integers.put("fbepecnt1", {3, 3, 3, 3});
    integers.put("facconn1", faces, "nfaced");
    integers.put("ebepecnt1", counts);
    check(nc_close(file));
    EXPECT_THAT(refusal(path), testing::HasSubstr(message));
  }
}

TEST(ExodusOrders, TruncatedFilesAreRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("cell.e");
  write_cell(path, kElements.back(), 0);
  const std::string text = text_of(path);
  for (std::size_t length = 1; length < text.size(); length += 61) {
    const std::string cut = folder.write("cut.e", text.substr(0, length));
    const std::string message = refusal(cut);
    EXPECT_FALSE(message.empty()) << length;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace hiac::formats
