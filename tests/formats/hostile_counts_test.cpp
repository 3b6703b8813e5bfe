// Numbers in files that lead beyond what the files hold: refused by name, in one line, before
// anything is read or written at the place that they name.
#include <filesystem>

#include <fmt/format.h>

#include "tests/formats/files.hpp"
#include "tests/formats/raw_bytes.hpp"

namespace hiac::formats {
namespace {

using testing::HasSubstr;

// cgx numbers its types from 1 to 12.
TEST(HostileCounts, FrdElementsOfNoType) {
  const ScratchFolder folder;
  const auto head = [](const char* key, int count, int encoding) {
    return fmt::format("    {}{:18}{:12}{:37}{}\n", key, "", count, "", encoding);
  };
  std::string text = "    1C\n" + head("2C", 4, 1);
  for (int n = 1; n <= 4; ++n)
    text += fmt::format(" -1{:10}{:12.5E}{:12.5E}{:12.5E}\n", n, n == 2 ? 1.0 : 0.0,
                        n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0);
  text += " -3\n";
  const std::string in_binary = "    1C\n" + head("2C", 4, 3) + raw_bytes<std::int32_t>({1}) +
                                raw_bytes<double>({0, 0, 0}) + raw_bytes<std::int32_t>({2}) +
                                raw_bytes<double>({1, 0, 0}) + raw_bytes<std::int32_t>({3}) +
                                raw_bytes<double>({0, 1, 0}) + raw_bytes<std::int32_t>({4}) +
                                raw_bytes<double>({0, 0, 1}) + head("3C", 1, 2);
  const std::string nodes = fmt::format("\n -2{:10}{:10}{:10}{:10}\n -3\n 9999\n", 1, 2, 3, 4);
  for (const int type : {-1, 0, 13, 65536}) {
    SCOPED_TRACE(type);
    const std::string said =
        fmt::format("element 9: an element type 1 to 12 expected ({} found)", type);
    const std::string written =
        text + head("3C", 1, 1) + fmt::format(" -1{:10}{:5}{:5}{:5}", 9, type, 0, 1) + nodes;
    EXPECT_THAT(refusal(folder.write("a.frd", written)), HasSubstr(said));
    EXPECT_THAT(
        refusal(folder.write(
            "b.frd", in_binary + raw_bytes<std::int32_t>({9, type, 0, 1, 1, 2, 3, 4}) + " 9999\n")),
        HasSubstr(said));
  }
  // the same files with a type that there is
  EXPECT_EQ(
      refusal(folder.write("c.frd", text + head("3C", 1, 1) +
                                        fmt::format(" -1{:10}{:5}{:5}{:5}", 9, 3, 0, 1) + nodes)),
      "");
  EXPECT_EQ(
      refusal(folder.write(
          "d.frd", in_binary + raw_bytes<std::int32_t>({9, 3, 0, 1, 1, 2, 3, 4}) + " 9999\n")),
      "");
}

// A tetrahedron as a case of OpenFOAM's: four faces, of which none has a neighbour.
TEST(HostileCounts, OpenFoamNeighboursBeyondTheFaces) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.file("constant/polyMesh"));
  const auto write = [&](const std::string& name, const char* type, const std::string& list) {
    static_cast<void>(folder.write(
        "constant/polyMesh/" + name,
        fmt::format("FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n{}\n", type,
                    name, list)));
  };
  const std::string path = folder.write("a.foam", "");
  write("points", "vectorField", "4((0 0 0)(1 0 0)(0 1 0)(0 0 1))");
  write("faces", "faceList", "4(3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3))");
  write("owner", "labelList", "4(0 0 0 0)");
  write("neighbour", "labelList", "0()");
  EXPECT_EQ(refusal(path), "");
  write("neighbour", "labelList", "5(0 0 0 0 0)");
  EXPECT_THAT(refusal(path),
              HasSubstr("neighbour: does not fit the faces (at most 4 entries expected, 5 found)"));
  for (const char* longer : {"5(0 0 0 0 0)", "5{0}", "(0 0 0 0 0)", "9(1 1 1 1 1 1 1 1 1)"}) {
    write("neighbour", "labelList", longer);
    EXPECT_THAT(refusal(path), HasSubstr("neighbour")) << longer;
  }
  write("neighbour", "labelList", "0()");
  for (const char* other : {"5(0 0 0 0 0)", "3(0 0 0)"}) {
    write("owner", "labelList", other);
    EXPECT_THAT(refusal(path), HasSubstr("owner")) << other;
  }
}

TEST(HostileCounts, GmshBlocksLargerThanTheirTotal) {
  const ScratchFolder folder;
  // version 2, binary: type, elements of the block, tags; then number and nodes of each
  const auto binary = [&](std::int32_t total, std::int32_t in_block) {
    std::string text =
        "$MeshFormat\n2.2 1 8\n" + raw_bytes<std::int32_t>({1}) + "\n$EndMeshFormat\n$Nodes\n4\n";
    for (int n = 1; n <= 4; ++n)
      text += raw_bytes<std::int32_t>({n}) +
              raw_bytes<double>({n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0, n == 4 ? 1.0 : 0.0});
    text += fmt::format("\n$EndNodes\n$Elements\n{}\n", total) +
            raw_bytes<std::int32_t>({4, in_block, 0});
    for (int e = 1; e <= 3; ++e) text += raw_bytes<std::int32_t>({e, 1, 2, 3, 4});
    return folder.write("b.msh", text + "\n$EndElements\n");
  };
  EXPECT_EQ(refusal(binary(3, 3)), "");
  for (const std::int32_t total : {1, 2})
    EXPECT_THAT(refusal(binary(total, 3)),
                HasSubstr(fmt::format("elements of a block: impossible (1 to {} expected, 3 found)",
                                      total)));
  EXPECT_THAT(refusal(binary(3, 0)), HasSubstr("1 to 3 expected, 0 found"));
  EXPECT_NE(refusal(binary(3, -1)), "");
  EXPECT_NE(refusal(binary(3, 2147483647)), "");

  // version 4.1: blocks and total, of nodes and of elements
  const auto text = [&](int nodes, int elements, const std::string& in_block) {
    return folder.write(
        "t.msh", fmt::format("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 {} 1 4\n3 1 0 4\n"
                             "1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
                             "$Elements\n1 {} 1 2\n3 1 4 {}\n1 1 2 3 4\n2 1 2 3 4\n"
                             "$EndElements\n",
                             nodes, elements, in_block));
  };
  EXPECT_EQ(refusal(text(4, 2, "2")), "");
  EXPECT_THAT(refusal(text(3, 2, "2")), HasSubstr("3 nodes expected, 4 found in the blocks"));
  EXPECT_THAT(refusal(text(4, 1, "2")), HasSubstr("1 elements expected, 2 found in the blocks"));
  EXPECT_NE(refusal(text(4, 2, "99999999999999999")), "");
  EXPECT_NE(refusal(text(4, 2, "-1")), "");
}

}  // namespace
}  // namespace hiac::formats
