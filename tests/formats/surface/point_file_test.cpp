#include "formats/surface/point_file.hpp"

#include <gmock/gmock.h>

#include "hiac/base/error.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PointFile, NamesItsColumnsOrNot) {
  const ScratchFolder folder;
  const ZooMesh plain =
      read_points(folder.write("a.xyz", "# measured\n1 2 3 10\n\n4\t5 6 -2e1\n+7,8;9 30\r\n"));
  EXPECT_THAT(plain.xyz.view(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  ASSERT_EQ(plain.fields.size(), 1U);
  EXPECT_EQ(plain.fields[0].name, "value");
  EXPECT_THAT(plain.fields[0].values.view(), ElementsAre(10, -20, 30));
  EXPECT_EQ(plain.cell_count(), 0U);

  const ZooMesh named =
      read_points(folder.write("a.csv", "\"T\",\"Z\",\"X\",\"Y\",\"p\"\n9,3,1,2,nan\n8,6,4,5,7\n"));
  EXPECT_THAT(named.xyz.view(), ElementsAre(1, 2, 3, 4, 5, 6));
  ASSERT_EQ(named.fields.size(), 2U);
  EXPECT_EQ(named.fields[0].name, "T");
  EXPECT_THAT(named.fields[0].values.view(), ElementsAre(9, 8));
  EXPECT_EQ(named.fields[1].name, "p");

  const ZooMesh tetgen = read_points(
      folder.write("a.node", "2 3 2 1\n# a comment\n1 0 0 1  5 6  0\n2 1 0 1  7 8  1\n"));
  EXPECT_THAT(tetgen.xyz.view(), ElementsAre(0, 0, 1, 1, 0, 1));
  ASSERT_EQ(tetgen.fields.size(), 2U);
  EXPECT_THAT(tetgen.fields[1].values.view(), ElementsAre(6, 8));
}

TEST(PointFile, WhatIsMalformedIsRefusedWithItsLine) {
  const ScratchFolder folder;
  const auto refusal = [&](const char* name, const char* text) -> std::string {
    try {
      read_points(folder.write(name, text));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("a.txt", "1 2 3\n1 2\n"), HasSubstr("a.txt:2: 3 columns expected (2 found)"));
  EXPECT_THAT(refusal("a.txt", "1 2 3\n\n1 2 x\n"), HasSubstr("a.txt:3: a number expected ('x'"));
  EXPECT_THAT(refusal("a.txt", "1 2\n"), HasSubstr("at least 3 columns"));
  EXPECT_THAT(refusal("a.txt", "x y z\n"), HasSubstr("holds no point"));
  EXPECT_THAT(refusal("a.txt", "1 2 inf\n"), HasSubstr("not finite"));
  EXPECT_THAT(refusal("a.node", "2 3 0 0\n1 0 0 0\n3 0 0 0\n"), HasSubstr("a.node:3"));
  EXPECT_THAT(refusal("a.node", "99999999999 3 0 0\n1 0 0 0\n"), HasSubstr("ends too soon"));
  EXPECT_THROW(read_points(folder.file("nothing.csv")), InputError);
}

}  // namespace
}  // namespace hiac::formats
