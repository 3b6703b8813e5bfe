// Many of the smallest items that MSH files can have, up to the end of the file: counts are checked
// against what the rest of the file can hold, which these just fit.
#include <cstdint>

#include <fmt/format.h>

#include "tests/formats/files.hpp"
#include "tests/formats/raw_bytes.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kManyItems = 400;

std::string msh_head(const std::string& version, bool binary) {
  return fmt::format("$MeshFormat\n{} {:d} 8\n{}$EndMeshFormat\n", version, binary,
                     binary ? raw_bytes<std::int32_t>({1}) + "\n" : "");
}

/// Nodes 1 to 4 make the unit tetrahedron; all others are the first once more.
std::array<double, 3> msh_point(int n) {
  return {n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0};
}
int msh_number(int n) { return n <= 4 ? n : 1; }

TEST(GmshSizes, NodesAsShortAsTheyCanBe) {
  const ScratchFolder folder;
  for (const std::string version : {"2.2", "3"})
    for (const bool binary : {false, true}) {
      SCOPED_TRACE(version);
      const bool third = version == "3";
      std::string elements = msh_head(version, binary) + "$Elements\n1\n";
      if (binary)
        elements += third ? raw_bytes<std::int32_t>({9, 4, 0, 4, 1, 2, 3, 4})
                          : raw_bytes<std::int32_t>({4, 1, 0, 9, 1, 2, 3, 4});
      else
        elements += third ? "9 4 0 4 1 2 3 4" : "9 4 0 1 2 3 4";
      std::string nodes = fmt::format("\n$EndElements\n$Nodes\n{}\n", kManyItems);
      for (int n = 1; n <= kManyItems; ++n) {
        const auto [x, y, z] = msh_point(n);
        if (binary)
          nodes += raw_bytes<std::int32_t>({msh_number(n)}) + raw_bytes<double>({x, y, z}) +
                   (third ? raw_bytes<std::int32_t>({0}) : "");
        else
          nodes += fmt::format("{} {} {} {}{}\n", msh_number(n), x, y, z, third ? " 0" : "");
      }
      expect_unit_tetrahedron(
          read_any(folder.write("a.msh", elements + nodes + "\n$EndNodes\n")).mesh);
    }
}

// An empty block takes its head alone: three integers and a size.
TEST(GmshSizes, EmptyBlocksAndNodesOfVersion4) {
  const ScratchFolder folder;
  for (const bool v41 : {false, true}) {
    const auto range = [&] { return v41 ? raw_bytes<std::uint64_t>({1, 4}) : std::string(); };
    const auto number = [&](std::int32_t n) {
      return v41 ? raw_bytes<std::int64_t>({n}) : raw_bytes<std::int32_t>({n});
    };
    const std::string head = msh_head(v41 ? "4.1" : "4", true);
    // block heads: dimension and tag (in 4.0 the other way), parametric or type, count
    const auto block = [&](int dimension, std::int32_t kind, std::uint64_t count) {
      return (v41 ? raw_bytes<std::int32_t>({dimension, 7, kind})
                  : raw_bytes<std::int32_t>({7, dimension, kind})) +
             raw_bytes<std::uint64_t>({count});
    };
    std::string empty_nodes;
    std::string empty_elements;
    for (int i = 0; i < kManyItems; ++i) {
      empty_nodes += block(0, 0, 0);
      empty_elements += block(3, 4, 0);
    }
    std::string numbers;
    std::string list;
    for (int n = 1; n <= 4; ++n) {
      const auto [x, y, z] = msh_point(n);
      numbers += number(n);
      list += (v41 ? "" : number(n)) + raw_bytes<double>({x, y, z});
    }
    const std::string four = block(3, 0, 4) + (v41 ? numbers + list : list);
    const std::string element = block(3, 4, 1) + number(9) + numbers;
    const std::uint64_t blocks = kManyItems + 1;
    const auto section = [&](const std::string& name, std::uint64_t count, std::uint64_t total,
                             const std::string& body) {
      return "$" + name + "\n" + raw_bytes<std::uint64_t>({count, total}) + range() + body +
             "\n$End" + name + "\n";
    };
    expect_unit_tetrahedron(
        read_any(folder.write("a.msh", head + section("Elements", 1, 1, element) +
                                           section("Nodes", blocks, 4, four + empty_nodes)))
            .mesh);
    expect_unit_tetrahedron(read_any(folder.write("a.msh", head + section("Nodes", 1, 4, four) +
                                                               section("Elements", blocks, 1,
                                                                       element + empty_elements)))
                                .mesh);
  }
}

TEST(GmshSizes, ElementsWithManyTags) {
  const ScratchFolder folder;
  const std::string nodes = [] {
    std::string text = "$Nodes\n4\n";
    for (int n = 1; n <= 4; ++n) {
      const auto [x, y, z] = msh_point(n);
      text += raw_bytes<std::int32_t>({n}) + raw_bytes<double>({x, y, z});
    }
    return text + "\n$EndNodes\n";
  }();
  std::string tags;
  for (int t = 0; t < kManyItems; ++t) tags += raw_bytes<std::int32_t>({5});
  const std::string element =
      raw_bytes<std::int32_t>({4, 1, kManyItems, 9}) + tags + raw_bytes<std::int32_t>({1, 2, 3, 4});
  const std::string path = folder.write(
      "a.msh", msh_head("2.2", true) + nodes + "$Elements\n1\n" + element + "\n$EndElements\n");
  expect_unit_tetrahedron(read_any(path).mesh);
  EXPECT_THAT(format_named("gmsh").inspect(path).blocks, ElementsAre("5"));
  // version 3 has partitions behind the nodes
  std::string third = "$Nodes\n4\n";
  for (int n = 1; n <= 4; ++n) {
    const auto [x, y, z] = msh_point(n);
    third +=
        raw_bytes<std::int32_t>({n}) + raw_bytes<double>({x, y, z}) + raw_bytes<std::int32_t>({0});
  }
  third += "\n$EndNodes\n$Elements\n1\n" +
           raw_bytes<std::int32_t>({9, 4, 0, 4 + kManyItems, 1, 2, 3, 4}) + tags;
  expect_unit_tetrahedron(
      read_any(folder.write("b.msh", msh_head("3", true) + third + "\n$EndElements\n")).mesh);
}

// The entities stand last here, so that what follows does not make room for them.
TEST(GmshSizes, EntitiesWithManyGroupsAndBounds) {
  const ScratchFolder folder;
  const std::string mesh =
      "$Nodes\n1 4 1 4\n3 7 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "$EndNodes\n$Elements\n1 1 9 9\n3 7 4 1\n9 1 2 3 4\n$EndElements\n";
  std::string many;
  for (int i = 0; i < kManyItems; ++i) many += " 5";
  for (const bool bounds : {false, true}) {
    const std::string lists = bounds ? fmt::format(" 1 5 {}{}", kManyItems, many)
                                     : fmt::format(" {}{} 0", kManyItems, many);
    expect_unit_tetrahedron(
        read_any(folder.write("a.msh", msh_head("4.1", false) + mesh + "$Entities\n0 0 0 1\n7" +
                                           " 0 0 0 1 1 1" + lists + "\n$EndEntities\n"))
            .mesh);
    const std::string third = bounds ? fmt::format("7 {}{} 0", kManyItems, many)
                                     : fmt::format("7 0 {}{}", kManyItems, many);
    expect_unit_tetrahedron(
        read_any(folder.write("b.msh", msh_head("3", false) +
                                           "$Nodes\n4\n1 0 0 0 0\n2 1 0 0 0\n3 0 1 0 0\n4 0 0 1 0\n"
                                           "$EndNodes\n$Elements\n1\n9 4 7 4 1 2 3 4\n"
                                           "$EndElements\n$Entities\n0 0 0 1\n" +
                                           third + "\n$EndEntities\n"))
            .mesh);
  }
  // in binary a group takes four bytes
  std::string groups;
  for (int i = 0; i < kManyItems; ++i) groups += raw_bytes<std::int32_t>({5});
  const std::string binary =
      "$Nodes\n" + raw_bytes<std::uint64_t>({1, 4, 1, 4}) + raw_bytes<std::int32_t>({3, 7, 0}) +
      raw_bytes<std::uint64_t>({4, 1, 2, 3, 4}) +
      raw_bytes<double>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}) + "\n$EndNodes\n$Elements\n" +
      raw_bytes<std::uint64_t>({1, 1, 9, 9}) + raw_bytes<std::int32_t>({3, 7, 4}) +
      raw_bytes<std::uint64_t>({1, 9, 1, 2, 3, 4}) + "\n$EndElements\n$Entities\n" +
      raw_bytes<std::uint64_t>({0, 0, 0, 1}) + raw_bytes<std::int32_t>({7}) +
      raw_bytes<double>({0, 0, 0, 1, 1, 1});
  for (const std::string& lists :
       {raw_bytes<std::uint64_t>({kManyItems}) + groups + raw_bytes<std::uint64_t>({0}),
        raw_bytes<std::uint64_t>({0}) + raw_bytes<std::uint64_t>({kManyItems}) + groups})
    expect_unit_tetrahedron(
        read_any(folder.write("c.msh", msh_head("4.1", true) + binary + lists + "\n$EndEntities\n"))
            .mesh);
}

TEST(GmshSizes, ValuesAtTheNodesOfElementsEndTheFile) {
  const ScratchFolder folder;
  std::string text = msh_head("2.2", true) + "$Nodes\n4\n";
  for (int n = 1; n <= 4; ++n) {
    const auto [x, y, z] = msh_point(n);
    text += raw_bytes<std::int32_t>({n}) + raw_bytes<double>({x, y, z});
  }
  // a line of eleven nodes has as many values
  text += "\n$EndNodes\n$Elements\n2\n" + raw_bytes<std::int32_t>({4, 1, 0, 9, 1, 2, 3, 4}) +
          raw_bytes<std::int32_t>({66, 1, 0, 8, 1, 2, 1, 1, 1, 1, 1, 1, 1, 1, 1}) +
          "\n$EndElements\n$ElementNodeData\n1\n\"p\"\n0\n3\n0\n1\n2\n" +
          raw_bytes<std::int32_t>({9, 4}) + raw_bytes<double>({1, 2, 3, 4}) +
          raw_bytes<std::int32_t>({8, 11}) + std::string(88, '\0') + "\n$EndElementNodeData\n";
  const ZooMesh mesh = read_any(folder.write("a.msh", text)).mesh;
  expect_unit_tetrahedron(mesh);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(refusal(folder.write("b.msh", text.substr(0, text.size() - 22))),
              HasSubstr("the file ends within values"));
}

}  // namespace
}  // namespace hiac::formats
