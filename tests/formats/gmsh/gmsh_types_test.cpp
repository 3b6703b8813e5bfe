// Gmsh's element types: the number of nodes follows from shape and order; complete elements have
// all nodes of their order, serendipity ones none but on their edges.
#include "formats/gmsh/gmsh_types.hpp"

#include <functional>
#include <set>

#include <gtest/gtest.h>

namespace hiac::formats {
namespace {

struct TypeFamily {
  std::string name;
  int first_order;
  std::vector<int> numbers;  ///< of rising orders
  std::function<int(int)> nodes;
};

std::vector<TypeFamily> solid_families() {
  return {
      {"Tetrahedron",
       1,
       {4, 11, 29, 30, 31, 71, 72, 73, 74, 75},
       [](int p) { return (p + 1) * (p + 2) * (p + 3) / 6; }},
      {"Tetrahedron", 3, {137, 32, 33, 79, 80, 81, 82, 83}, [](int p) { return 4 + 6 * (p - 1); }},
      {"Hexahedron",
       1,
       {5, 12, 92, 93, 94, 95, 96, 97, 98},
       [](int p) { return (p + 1) * (p + 1) * (p + 1); }},
      {"Hexahedron",
       2,
       {17, 99, 100, 101, 102, 103, 104, 105},
       [](int p) { return 8 + 12 * (p - 1); }},
      {"Prism",
       1,
       {6, 13, 90, 91, 106, 107, 108, 109, 110},
       [](int p) { return (p + 1) * (p + 1) * (p + 2) / 2; }},
      {"Prism", 2, {18, 111, 112, 113, 114, 115, 116, 117}, [](int p) { return 6 + 9 * (p - 1); }},
      {"Pyramid",
       1,
       {7, 14, 118, 119, 120, 121, 122, 123, 124},
       [](int p) { return (p + 1) * (p + 2) * (2 * p + 3) / 6; }},
      {"Pyramid", 2, {19, 125, 126, 127, 128, 129, 130, 131}, [](int p) {
         return 5 + 8 * (p - 1);
       }}};
}

std::vector<TypeFamily> flat_families() {
  return {{"Line", 1, {1, 8, 26, 27, 28, 62, 63, 64, 65, 66}, [](int p) { return p + 1; }},
          {"Triangle",
           1,
           {2, 9, 21, 23, 25, 42, 43, 44, 45, 46},
           [](int p) { return (p + 1) * (p + 2) / 2; }},
          {"Triangle", 3, {20, 22, 24, 52, 53, 54, 55, 56}, [](int p) { return 3 * p; }},
          {"Quadrilateral",
           1,
           {3, 10, 36, 37, 38, 47, 48, 49, 50, 51},
           [](int p) { return (p + 1) * (p + 1); }},
          {"Quadrilateral", 2, {16, 39, 40, 41, 57, 58, 59, 60, 61}, [](int p) { return 4 * p; }}};
}

TEST(GmshTypes, HaveTheNodesOfTheirShapeAndOrder) {
  std::set<int> known;
  for (const bool solid : {true, false})
    for (const TypeFamily& family : solid ? solid_families() : flat_families()) {
      int order = family.first_order;
      for (const int number : family.numbers) {
        const ForeignType* type = gmsh::element_type(number);
        ASSERT_NE(type, nullptr) << number;
        EXPECT_EQ(type->nodes, static_cast<std::size_t>(family.nodes(order))) << number;
        EXPECT_TRUE(type->name.starts_with(family.name)) << number << " " << type->name;
        EXPECT_EQ(type->conversion.fate == CellFate::no_volume, !solid) << number;
        known.insert(number);
        ++order;
      }
    }
  for (const int point : {15, 84, 85, 86}) {
    EXPECT_EQ(gmsh::element_type(point)->nodes, 1U);
    EXPECT_EQ(gmsh::element_type(point)->name, "Point");
    known.insert(point);
  }
  for (int number = -1; number < 200; ++number)
    EXPECT_EQ(gmsh::element_type(number) != nullptr, known.contains(number)) << number;
}

TEST(GmshTypes, OfTheZooAreWrittenAsTheyAreRead) {
  for (std::size_t k = 0; k < kKindCount; ++k) {
    const auto kind = static_cast<CellKind>(k);
    const auto& written = gmsh::written_type(kind);
    ASSERT_EQ(written.has_value(), shape_of(kind) != CellShape::wedge) << kind_name(kind);
    if (!written) continue;
    const ForeignType* type = gmsh::element_type(written->number);
    EXPECT_EQ(type->conversion.kind, kind);
    EXPECT_EQ(type->conversion.fate, CellFate::converted);
    ASSERT_EQ(written->nodes.size(), node_count(kind));
    for (std::size_t i = 0; i < written->nodes.size(); ++i)
      EXPECT_EQ(written->nodes[type->conversion.permutation[i]], i) << kind_name(kind) << i;
  }
}

TEST(GmshTypes, BeyondTheZooKeepTheirCorners) {
  for (const TypeFamily& family : solid_families())
    for (const int number : family.numbers) {
      const ForeignType* type = gmsh::element_type(number);
      if (type->conversion.fate == CellFate::converted) continue;
      ASSERT_TRUE(type->conversion.corners) << number;
      const CellKind corners = family.name == "Tetrahedron"  ? CellKind::tetrahedron4
                               : family.name == "Hexahedron" ? CellKind::brick8
                               : family.name == "Prism"      ? CellKind::prism6
                                                             : CellKind::pyramid5;
      EXPECT_EQ(*type->conversion.corners, corners) << number;
    }
}

}  // namespace
}  // namespace hiac::formats
