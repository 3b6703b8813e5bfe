// Which columns of a table of points are its coordinates, and what is said of wrong rows.

#include "formats/surface/point_file.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> field_names(const ZooMesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) names.push_back(field.name);
  return names;
}

TEST(PointColumns, WithoutNamesAreNumbered) {
  const ScratchFolder folder;
  EXPECT_THAT(field_names(read_points(folder.write("a.txt", "1 2 3\n"))), IsEmpty());
  EXPECT_THAT(field_names(read_points(folder.write("a.txt", "1 2 3 4\n"))), ElementsAre("value"));
  const ZooMesh two = read_points(folder.write("a.txt", "1 2 3 4 5\n6 7 8 9 10\n"));
  EXPECT_THAT(field_names(two), ElementsAre("value1", "value2"));
  EXPECT_THAT(two.xyz.view(), ElementsAre(1, 2, 3, 6, 7, 8));
  EXPECT_THAT(two.fields[0].values.view(), ElementsAre(4, 9));
  EXPECT_THAT(two.fields[1].values.view(), ElementsAre(5, 10));
}

TEST(PointColumns, AreFoundByTheirNamesIfAllThreeAreThere) {
  const ScratchFolder folder;
  const ZooMesh small = read_points(folder.write("a.csv", "z;p;y;x\n1;2;3;4\n"));
  EXPECT_THAT(small.xyz.view(), ElementsAre(4, 3, 1));
  EXPECT_THAT(field_names(small), ElementsAre("p"));
  const ZooMesh two = read_points(folder.write("a.csv", "p,y,x,q\n1,2,3,4\n"));
  EXPECT_THAT(two.xyz.view(), ElementsAre(1, 2, 3));
  EXPECT_THAT(field_names(two), ElementsAre("q"));
  const ZooMesh long_names = read_points(folder.write("a.csv", "p,xx,yy,zz\n1,2,3,4\n"));
  EXPECT_THAT(long_names.xyz.view(), ElementsAre(1, 2, 3));
  EXPECT_THAT(field_names(long_names), ElementsAre("zz"));
}

TEST(PointColumns, RefusalsNameTheRow) {
  const ScratchFolder folder;
  const auto said = [&](const char* name, const std::string& text) -> std::string {
    const std::string path = folder.write(name, text);
    try {
      read_points(path);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(path.size());
    }
    return "none";
  };
  EXPECT_EQ(said("a.txt", "# a comment\n\n1 2\n"), ":3: at least 3 columns expected (2 found)");
  EXPECT_EQ(said("a.txt", "x y\n"), ":1: at least 3 columns expected (2 found)");
  EXPECT_EQ(said("a.txt", "1 2 3 4\n1 2 3 4 5\n"), ":2: 4 columns expected (5 found)");
  EXPECT_EQ(said("a.txt", "x y z\n1 2 3e\n"), ":2: a number expected ('3e' found)");
  EXPECT_EQ(said("a.txt", "1 2 3\n#1 2\n1 2 --3\n"), ":3: a number expected ('--3' found)");
  EXPECT_EQ(said("a.txt", "1 2 3\n1 2 +-3\n"), ":2: a number expected ('+-3' found)");
  EXPECT_EQ(said("a.txt", "1 2 3\n1 2 +\n"), ":2: a number expected ('+' found)");
  EXPECT_EQ(said("a.node", "1 3 0 0\n1 +1 2 +-3\n"),
            ":2: a coordinate expected as word 4 ('+-3' found)");
  EXPECT_EQ(said("a.txt", "x y z\n"), ": holds no point");
  EXPECT_EQ(said("a.txt", ""), ": holds no point");
  EXPECT_EQ(said("a.txt", "1 2 3\n4 nan 6\n"), ": a coordinate of point 1 is not finite");
  EXPECT_EQ(said("a.txt", "1 2 3 nan\n"), "none");
}

TEST(PointColumns, FilesAreKnownByTheirNames) {
  for (const char* name : {"a.csv", "a.txt", "a.xyz", "a.node", "b.c/a.csv"})
    EXPECT_TRUE(is_point_file(name)) << name;
  for (const char* name : {"a.CSV", "a.vtk", "csv", "a.csv.gz"})
    EXPECT_FALSE(is_point_file(name)) << name;
}

}  // namespace
}  // namespace hiac::formats
