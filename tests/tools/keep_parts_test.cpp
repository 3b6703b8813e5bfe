// hiac-convert --keep-parts: the pieces of parallel runs' files become the parts of a parted mesh.
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/mesh/parted/join_parts.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"
#include "hiac/mesh/parts/keep_cells.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/tools/tool_folder.hpp"

namespace hiac::tools {
namespace {

using testing::HasSubstr;

class KeepParts : public test::ToolFolder {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(file(name)).parent_path());
    std::ofstream(file(name)) << text;
  }

  // A .pvtu of meshes.
  void write_run(const std::string& name, const std::vector<ZooMesh>& pieces) const {
    std::string sources;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const std::string piece = fmt::format("{}.{}", name, k);
      write_zoo_file(file(piece + ".zoo"), {pieces[k], {}});
      ASSERT_EQ(run("$CONVERT -q " + piece + ".zoo -o " + piece + ".vtu"), 0) << complaint();
      sources += fmt::format("<Piece Source=\"{}.vtu\"/>", piece);
    }
    write(name + ".pvtu",
          "<?xml version=\"1.0\"?><VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">"
          "<PUnstructuredGrid GhostLevel=\"0\">" +
              sources + "</PUnstructuredGrid></VTKFile>");
  }

  // Keeps the parts of `input`; checks them against each other and against the whole as it is read.
  [[nodiscard]] std::vector<MeshPart> kept(const std::string& input,
                                           const std::string& more = "") const {
    EXPECT_EQ(run("$CONVERT " + input + more + " -o whole.zoo"), 0) << complaint();
    EXPECT_EQ(run("$CONVERT " + input + more + " --keep-parts -o kept.zparts"), 0) << complaint();
    const PartedIndex index = read_parted_index(file("kept.zparts"));
    std::vector<MeshPart> parts = read_all_parts(index);
    const ZooMesh whole = read_zoo_file(file("whole.zoo")).mesh;
    EXPECT_EQ(index.hash, content_hash(whole));
    EXPECT_EQ(content_hash(join_parts(index, parts)), content_hash(whole));
    return parts;
  }
};

// A mesh, and the parts of its cells: at random, so that parts interlock.
struct Divided {
  explicit Divided(std::uint32_t parts, ZooMesh of = test::structured(3, test::Cut::pyramids))
      : mesh(std::move(of)) {
    test::add_node_field(mesh, "t", test::smooth_field);
    std::vector<double> number(mesh.cell_count());
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i);
    mesh.fields.push_back({"number", "", FieldLocation::cell, 1, std::move(number)});
    std::mt19937_64 random(3);
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
      part_of_cell.push_back(static_cast<std::uint32_t>(random() % parts));
    for (MeshPart& part : split_mesh(mesh, part_of_cell, parts))
      pieces.push_back(std::move(part.mesh));
  }
  ZooMesh mesh;
  std::vector<std::uint32_t> part_of_cell;
  std::vector<ZooMesh> pieces;
};

TEST_F(KeepParts, PiecesOfAPvtuAreTheParts) {
  const Divided run_of(4);
  write_run("run", run_of.pieces);
  const std::vector<MeshPart> parts = kept("run.pvtu");
  EXPECT_THAT(complaint(), HasSubstr("in common, by their equal coordinates and values"));
  ASSERT_EQ(parts.size(), 4U);
  std::size_t cells = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    cells += parts[k].mesh.cell_count();
    for (const double number : parts[k].mesh.fields.at(1).values)
      EXPECT_EQ(run_of.part_of_cell[static_cast<std::size_t>(number)], k);
  }
  EXPECT_EQ(cells, run_of.mesh.cell_count());
  const PartedIndex index = read_parted_index(file("kept.zparts"));
  EXPECT_EQ(index.nodes, run_of.mesh.node_count());
  EXPECT_EQ(parts[0].mesh.fields.size(), 2U);
}

// Two bodies that touch: nodes of different numbers at one place, which places alone would join or,
// where a piece has both, leave apart.
TEST_F(KeepParts, NumbersOfTheWholeMeshJoinWhatIsOneNode) {
  ZooMesh touching = test::side_by_side(test::structured(3, test::Cut::bricks),
                                        test::structured(3, test::Cut::pyramids));
  std::vector<double> numbers(touching.node_count());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(3 * i + 5);
  touching.fields.push_back({"GlobalNodeId", "", FieldLocation::node, 1, std::move(numbers)});
  const Divided run_of(3, touching);
  write_run("run", run_of.pieces);
  ASSERT_EQ(kept("run.pvtu").size(), 3U);
  EXPECT_THAT(complaint(), HasSubstr("in common, by their 'GlobalNodeId'"));
  EXPECT_EQ(read_parted_index(file("kept.zparts")).nodes, run_of.mesh.node_count());
}

TEST_F(KeepParts, CellsThatAnEarlierPieceHasAreGhosts) {
  const Divided run_of(2);
  // a layer of ghosts that no array marks: cells of the first piece in the second
  std::vector<bool> second(run_of.mesh.cell_count());
  std::size_t ghosts = 0;
  for (CellId cell = 0; cell < second.size(); ++cell) {
    second[cell] = run_of.part_of_cell[cell] == 1 || cell % 3 == 0;
    ghosts += second[cell] && run_of.part_of_cell[cell] == 0 ? 1U : 0U;
  }
  write_run("run", {run_of.pieces[0], keep_cells(run_of.mesh, second)});
  const std::vector<MeshPart> parts = kept("run.pvtu");
  EXPECT_THAT(complaint(), HasSubstr(fmt::format("left out {} cells that an earlier", ghosts)));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].mesh.cell_count(), run_of.pieces[0].cell_count());
  EXPECT_EQ(parts[1].mesh.cell_count(), run_of.pieces[1].cell_count());
}

TEST_F(KeepParts, MarkedGhostsAreLeftOut) {
  const auto piece = [](const std::string& points, const std::string& cells, int count,
                        const std::string& ghosts) {
    return fmt::format(
        "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" version=\"1.0\">"
        "<UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"{}\"><CellData><DataArray "
        "type=\"UInt8\" Name=\"vtkGhostType\" format=\"ascii\">{}</DataArray></CellData><Points>"
        "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{}</DataArray>"
        "</Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{}"
        "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 8</DataArray>"
        "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 10</DataArray></Cells>"
        "</Piece></UnstructuredGrid></VTKFile>",
        count, ghosts, points, cells);
  };
  const std::string points = "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1";
  write("a.vtu", piece(points, "0 1 2 3 4 1 3 2", 2, "0 1"));
  write("b.vtu", piece(points, "4 1 3 2 0 1 2 3", 2, "0 1"));
  write("run.pvtu",
        "<?xml version=\"1.0\"?><VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">"
        "<PUnstructuredGrid GhostLevel=\"1\"><Piece Source=\"a.vtu\"/><Piece Source=\"b.vtu\"/>"
        "</PUnstructuredGrid></VTKFile>");
  const std::vector<MeshPart> parts = kept("run.pvtu");
  ASSERT_EQ(parts.size(), 2U);
  for (const MeshPart& part : parts) EXPECT_EQ(part.mesh.cell_count(), 1U);
  EXPECT_EQ(read_parted_index(file("kept.zparts")).nodes, 5U);
}

TEST_F(KeepParts, EditsKeepThem) {
  const Divided run_of(3);
  write_run("run", run_of.pieces);
  const auto parts = kept("run.pvtu",
                          " --derive 'u=2*t' --threshold number=10, --field number=n"
                          " --field t --invalid skip");
  ASSERT_EQ(parts.size(), 3U);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    ASSERT_EQ(parts[k].mesh.fields.size(), 3U);
    EXPECT_EQ(parts[k].mesh.fields[0].name, "n");
    for (const double number : parts[k].mesh.fields[0].values) {
      EXPECT_GE(number, 10);
      EXPECT_EQ(run_of.part_of_cell[static_cast<std::size_t>(number)], k);
    }
  }
}

TEST_F(KeepParts, APartWithoutCellsIsNone) {
  const Divided run_of(3);
  write_run("run", run_of.pieces);
  const std::string first = fmt::format("{}", [&] {
    std::size_t cell = 0;
    while (run_of.part_of_cell[cell] != 2) ++cell;
    return cell;
  }());
  // one cell, of the third piece
  const auto parts = kept("run.pvtu", " --threshold number=" + first + "," + first);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].mesh.cell_count(), 1U);
}

TEST_F(KeepParts, PartsOfAPartedMesh) {
  const Divided run_of(3);
  write_zoo_file(file("m.zoo"), {run_of.mesh, {}});
  ASSERT_EQ(run("$CONVERT -q m.zoo --parts 3 -o m.zparts"), 0) << complaint();
  const std::vector<MeshPart> before = read_all_parts(read_parted_index(file("m.zparts")));
  const std::vector<MeshPart> parts = kept("m.zparts");
  ASSERT_EQ(parts.size(), 3U);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    EXPECT_EQ(content_hash(parts[k].mesh), content_hash(before[k].mesh));
    EXPECT_TRUE(std::ranges::equal(parts[k].global_cells, before[k].global_cells));
  }
}

std::string foam(const std::string& type, const std::string& content) {
  return "FoamFile\n{\n version 2.0;\n format ascii;\n class " + type + ";\n object x;\n}\n" +
         content;
}

TEST_F(KeepParts, ProcessorsOfAnOpenFoamCase) {
  write("case.foam", "");
  const auto write_part = [&](int part, const std::string& points, const std::string& faces) {
    const std::string folder = fmt::format("processor{}/constant/polyMesh/", part);
    write(folder + "points", foam("vectorField", "4(" + points + ")\n"));
    write(folder + "faces", foam("faceList", "4(" + faces + ")\n"));
    write(folder + "owner", foam("labelList", "4{0}\n"));
    write(folder + "neighbour", foam("labelList", "0()\n"));
    write(folder + "boundary",
          foam("polyBoundaryMesh",
               fmt::format("1(to {{ type processor; nFaces 1; startFace 3; neighbProcNo {}; }})\n",
                           1 - part)));
    write(fmt::format("processor{}/0/p", part),
          foam("volScalarField", fmt::format("internalField uniform {};\n", part)));
  };
  write_part(0, "(0 0 0)(1 0 0)(0 1 0)(0 0 1)", "3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3)");
  write_part(1, "(1 1 1)(1 0 0)(0 1 0)(0 0 1)", "3(1 2 0) 3(2 3 0) 3(3 1 0) 3(1 3 2)");
  for (const bool by_addresses : {false, true}) {
    for (const int part : {0, 1}) {
      if (!by_addresses) continue;
      const std::string folder = fmt::format("processor{}/constant/polyMesh/", part);
      write(folder + "pointProcAddressing",
            foam("labelList", part == 0 ? "4(0 1 2 3)\n" : "4(4 1 2 3)\n"));
      write(folder + "cellProcAddressing", foam("labelList", part == 0 ? "1(1)\n" : "1(0)\n"));
    }
    const std::vector<MeshPart> parts = kept("case.foam");
    EXPECT_THAT(complaint(), HasSubstr(by_addresses ? "by pointProcAddressing" : "their patches"));
    ASSERT_EQ(parts.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(parts[k].mesh.cell_count(), 1U);
      EXPECT_EQ(parts[k].mesh.fields.at(0).values[0], static_cast<double>(k));
      EXPECT_EQ(parts[k].global_cells[0], by_addresses ? 1 - k : k);
    }
    EXPECT_EQ(read_parted_index(file("kept.zparts")).nodes, 5U);
  }
}

TEST_F(KeepParts, WrongUsageIsExit2) {
  const Divided run_of(2);
  write_zoo_file(file("m.zoo"), {run_of.mesh, {}});
  EXPECT_EQ(run("$CONVERT m.zoo --keep-parts -o k.zparts"), 2);
  EXPECT_THAT(complaint(), HasSubstr("--keep-parts: m.zoo is in one piece"));
  EXPECT_EQ(run("$CONVERT m.zoo --keep-parts -o k.zoo"), 2);
  EXPECT_THAT(complaint(), HasSubstr("only for a parted mesh"));
  EXPECT_EQ(run("$CONVERT m.zoo --keep-parts --parts 2 -o k.zparts"), 2);
  EXPECT_FALSE(std::filesystem::exists(file("k.zparts")));
}

}  // namespace
}  // namespace hiac::tools
