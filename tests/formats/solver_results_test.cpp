// Binary files of solvers and their viewers.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tests/formats/cell_volumes.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/solver_files.hpp"

#ifdef HIAC_WITH_VTK_LSDYNA
#  include <vtkCellData.h>
#  include <vtkCompositeDataIterator.h>
#  include <vtkDataArray.h>
#  include <vtkDataSet.h>
#  include <vtkLSDynaReader.h>
#  include <vtkMultiBlockDataSet.h>
#  include <vtkNew.h>
#  include <vtkPointData.h>
#endif

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// ---- Tecplot

TEST(TecplotBinary, BricksOfTwoTimesAreRead) {
  const ScratchFolder folder;
  for (const bool swapped : {false, true})
    for (const int version : {108, 111, 112}) {
      const std::string path = folder.write("b.plt", tecplot_bricks({version, swapped, false}));
      const ZooMesh late = read_any(path).mesh;
      ASSERT_EQ(late.cell_count(), 2U);
      EXPECT_EQ(late.node_count(), 12U);
      ASSERT_EQ(late.fields.size(), 2U);
      EXPECT_EQ(late.fields[0].values[11], 10 + 11);
      EXPECT_THAT(late.fields[1].values.view(), ElementsAre(100, 101));
      EXPECT_EQ(late.position(late.cell_nodes(1)[6])[0], 2);
      ReadOptions options;
      options.time = 1;
      EXPECT_THAT(read_any(path, options).mesh.fields[1].values.view(), ElementsAre(0, 1));
    }
}

TEST(TecplotBinary, OldFilesMayBePackedPointByPoint) {
  const ScratchFolder folder;
  const std::string path = folder.write("p.plt", tecplot_bricks({108, false, true}));
  const ZooMesh mesh = read_any(path).mesh;
  EXPECT_EQ(mesh.cell_count(), 2U);
  EXPECT_EQ(mesh.fields[0].values[3], 13);
}

TEST(TecplotBinary, CellValuesOfOrderedZonesArePadded) {
  Bytes out;
  out.raw("#!TDV112").wholes({1, 0}).text("t").whole(4);
  for (const char* name : {"X", "Y", "Z", "c"}) out.text(name);
  out.mark(299).text("z").wholes({-1, -1}).real(0).wholes({-1, 0, 1, 0, 0, 0, 1, 0, 0, 3, 3, 2, 0});
  out.mark(357).mark(299).wholes({2, 2, 2, 3, 0, 0, -1});
  for (int i = 0; i < 8; ++i) out.real(0);
  for (const int c : {0, 1, 2})
    for (int n = 0; n < 18; ++n) out.real(c == 0 ? n % 3 : c == 1 ? n / 3 % 3 : n / 9);
  for (int n = 0; n < 9; ++n) out.whole(n);  // the cells at i = 2 and j = 2 are not there
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("o.plt", out.str())).mesh;
  EXPECT_EQ(mesh.cell_count(), 4U);
  EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(0, 1, 3, 4));
}

/// What text_dialects_test.cpp reads from an ASCII file of the same zones.
TEST(TecplotBinary, PolyhedraAreToldByTheirFaces) {
  const ScratchFolder folder;
  for (const bool swapped : {false, true}) {
    const Reading reading = read_any(folder.write("p.plt", tecplot_polyhedra(swapped)));
    const ZooMesh& mesh = reading.mesh;
    ASSERT_EQ(mesh.cell_count(), 4U);
    for (const CellId cell : {0U, 1U, 2U, 3U}) {
      EXPECT_EQ(mesh.kinds[cell], CellKind::tetrahedron4);
      EXPECT_NEAR(std::abs(volume_of(mesh, cell)), (cell % 2 == 0 ? 1.0 : 2.0) / 6, 1e-12);
    }
    EXPECT_THAT(mesh.fields.at(0).values.view(), ElementsAre(7, 8, 17, 18));
    EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("without volume: 1 POLYGON")));
  }
  const std::string whole = tecplot_polyhedra(false);
  for (std::size_t length = 8; length < whole.size(); length += 20)
    EXPECT_NE(refusal(folder.write("cut.plt", whole.substr(0, length))), "") << length;
  const auto changed = [&](std::initializer_list<std::int32_t> from, std::int32_t to) {
    const std::string old = Bytes().wholes(from).str();
    std::string text = whole;
    text.replace(text.find(old), 4, Bytes().whole(to).str());
    return refusal(folder.write("d.plt", text));
  };
  EXPECT_THAT(changed({9, 12, 15, 18, 21}, 13),
              HasSubstr("places of faces that rise from 0 to 21"));
  EXPECT_THAT(changed({21, 0, 2, 1}, 20), HasSubstr("places of faces that rise from 0 to 21"));
  EXPECT_THAT(changed({4, 1, 4, 3}, 5), HasSubstr("there is no node 6 (1 to 5 expected)"));
  EXPECT_THAT(changed({1, 1, 1, -1}, 2), HasSubstr("no element 2 beside a face (0 to 1 expected)"));
  EXPECT_THAT(changed({7, 21, 2, 1, 2}, 2000000000), HasSubstr("the faces' places"));
  EXPECT_THAT(changed({2, 0, 0, 0, 0}, 2000000000),
              HasSubstr("zone 'p': more elements than the file holds (2000000000 found)"));
  EXPECT_THAT(changed({2, 0, 0, 0, 0}, 15), HasSubstr("zone 'p': 15 elements of 7 faces"));
}

TEST(TecplotBinary, DamagedFilesAreRefused) {
  const ScratchFolder folder;
  const std::string whole = tecplot_bricks({});
  for (std::size_t length = 8; length < whole.size(); length += 41)
    EXPECT_NE(refusal(folder.write("cut.plt", whole.substr(0, length))), "") << length;
  EXPECT_THAT(refusal(folder.write("v.plt", "#!TDV075" + whole.substr(8))),
              HasSubstr("a version from 107 to 112 expected"));
  for (std::size_t at = 8; at < whole.size(); at += 36) {
    std::string changed = whole;
    changed[at + 3] = '\x7f';
    static_cast<void>(refusal(folder.write("d.plt", changed)));  // refused or read, not more
  }
}

TEST(TecplotBinary, BytesBehindTheLastZoneAreTold) {
  const ScratchFolder folder;
  const std::string whole = tecplot_bricks({});
  const auto behind = HasSubstr("behind the end of");
  EXPECT_THAT(read_any(folder.write("b.plt", whole)).notes, testing::Not(Contains(behind)));
  const Reading reading = read_any(folder.write("b.plt", whole + std::string("\0x\0", 3)));
  EXPECT_EQ(reading.mesh.cell_count(), 2U);
  EXPECT_THAT(reading.notes, Contains("3 bytes behind the end of the last zone are not read"));
}

TEST(TecplotBinary, NamesDoNotBreakMessagesIntoLines) {
  std::string text = tecplot_bricks({});
  // an integer a character: "early"
  const std::size_t name = text.find(std::string("e\0\0\0a\0\0\0r", 9));
  ASSERT_NE(name, std::string::npos);
  text[name + 4] = '\n';
  const ScratchFolder folder;
  for (std::size_t length = name + 24; length < text.size(); length += 12)
    EXPECT_THAT(refusal(folder.write("n.plt", text.substr(0, length))),
                testing::Not(HasSubstr("\n")));
  const std::string mark("\0\x80\x95\x43\x02", 5);  // of the zone's data, and its first format
  text[text.find(mark)] = 1;
  EXPECT_THAT(refusal(folder.write("n.plt", text)), HasSubstr("'e rly': the mark of its data"));
}

// ---- LS-DYNA

#ifdef HIAC_WITH_VTK_LSDYNA
/// Nodes are found by where they have gone, cells by their order.
void expect_same(vtkDataSet& solids, const ZooMesh& mesh) {
  ASSERT_EQ(static_cast<std::size_t>(solids.GetNumberOfPoints()), mesh.node_count());
  const auto value = [](vtkDataArray* array, std::size_t tuple, int component) {
    return array->GetComponent(static_cast<vtkIdType>(tuple), component);
  };
  const Field temperature = scalar_field(mesh, "temperature");
  const Field velocity = scalar_field(mesh, "velocity:x");
  const Field displacement = scalar_field(mesh, "displacement:z");
  for (NodeId node = 0; node < mesh.node_count(); ++node) {
    std::array<double, 3> x{};
    const auto at = mesh.position(node);
    std::copy(at.begin(), at.end(), x.begin());
    x[2] += displacement.values[node];
    const vtkIdType point = solids.FindPoint(x.data());
    ASSERT_GE(point, 0);
    std::array<double, 3> found{};
    solids.GetPoint(point, found.data());
    EXPECT_EQ(found, x);
    const auto p = static_cast<std::size_t>(point);
    EXPECT_EQ(value(solids.GetPointData()->GetArray("Temperature"), p, 0),
              temperature.values[node]);
    EXPECT_EQ(value(solids.GetPointData()->GetArray("Velocity"), p, 0), velocity.values[node]);
  }
  const Field stress = scalar_field(mesh, "stress:5");
  const Field strain = scalar_field(mesh, "plastic strain");
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_EQ(value(solids.GetCellData()->GetArray("Stress"), cell, 5), stress.values[cell]);
    EXPECT_EQ(value(solids.GetCellData()->GetArray("EffPlastStrn"), cell, 0), strain.values[cell]);
  }
}
#endif

TEST(D3plot, FamiliesOfEveryWordAreRead) {
  const Model model = linear_model();
  for (const bool wide : {false, true})
    for (const bool swapped : {false, true}) {
      const ScratchFolder folder;
      const std::string path = folder.write(
          "d3plot", d3plot_geometry(model, wide, swapped) + d3plot_state(model, 0, wide, swapped) +
                        d3plot_state(model, 1, wide, swapped) + end_of_states(wide, swapped));
      EXPECT_NE(folder.write("d3plot01", d3plot_state(model, 2.5, wide, swapped) +
                                             end_of_states(wide, swapped)),
                "");
      EXPECT_THAT(format_to_read(path).inspect(path).times, ElementsAre(0, 1, 2.5));
      const Reading last = read_any(path);
      EXPECT_EQ(last.mesh.cell_count(), 3U);
      EXPECT_THAT(last.notes, testing::Contains(HasSubstr("1 solids that are deleted")));
      ReadOptions options;
      options.time = 1;
      const ZooMesh mesh = read_any(path, options).mesh;
      ASSERT_EQ(mesh.cell_count(), 4U);
      EXPECT_EQ(mesh.kinds[0], CellKind::brick8);
      EXPECT_EQ(mesh.kinds[1], CellKind::prism6);
      EXPECT_EQ(mesh.kinds[2], CellKind::pyramid5);
      EXPECT_EQ(mesh.kinds[3], CellKind::tetrahedron4);
      const auto field = [&](const std::string& name) {
        return *std::find_if(mesh.fields.begin(), mesh.fields.end(),
                             [&](const Field& f) { return f.name == name; });
      };
      for (NodeId node = 0; node < mesh.node_count(); ++node) {
        const auto x = mesh.position(node);
        EXPECT_EQ(field("temperature").values[node], x[0] + 1);
        EXPECT_EQ(field("displacement").values[3 * node + 2], 1);
        EXPECT_EQ(field("velocity").values[3 * node + 1], 3 * x[1]);
      }
      EXPECT_EQ(field("stress").values[6 * 2 + 5], 26);
      EXPECT_EQ(field("plastic strain").values[1], 17);
      EXPECT_EQ(field("history 1").values[3], 38);
      EXPECT_EQ(field("part").values[0], 1);
    }
}

TEST(D3plot, ThickShellsAreBricksAndShellsNoVolumes) {
  Model model = linear_model();
  model.points.insert(model.points.end(), {{0, 3, 0}, {1, 3, 0}, {1, 3, 1}, {0, 3, 1}});
  model.thick_shells = {{4, 3, 14, 13, 8, 7, 15, 16}};
  const ScratchFolder folder;
  const std::string path = folder.write("d3plot", d3plot_geometry(model, false, false) +
                                                      d3plot_state(model, 1, false, false) +
                                                      d3plot_state(model, 3, false, false));
  ReadOptions options;
  options.step = 0;
  const Reading reading = read_any(path, options);
  ASSERT_EQ(reading.mesh.cell_count(), 5U);
  EXPECT_EQ(reading.mesh.kinds[4], CellKind::brick8);
  const Field stress = scalar_field(reading.mesh, "plastic strain");
  EXPECT_EQ(stress.values[3], 37);
  EXPECT_TRUE(std::isnan(stress.values[4]));
  EXPECT_EQ(scalar_field(reading.mesh, "part").values[4], 3);
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("values of thick shells")));
  EXPECT_THAT(reading.notes, testing::Contains(HasSubstr("without volume: 1 shell")));
  // at the second step a solid and the thick shell are deleted
  EXPECT_EQ(read_any(path).mesh.cell_count(), 3U);
}

TEST(D3plot, AStateThatIsCutOffIsTold) {
  const Model model = linear_model();
  const std::string whole = d3plot_geometry(model, false, false) +
                            d3plot_state(model, 1, false, false) +
                            d3plot_state(model, 2, false, false);
  const std::string mark = end_of_states(false, false);
  const ScratchFolder folder;
  const auto behind = HasSubstr("behind the end of");
  for (const std::string& rest : {std::string(), std::string(400, '\0'), mark, mark + "anything"}) {
    const Reading reading = read_any(folder.write("d3plot", whole + rest));
    EXPECT_THAT(reading.notes, testing::Not(Contains(behind))) << rest.size();
  }
  const std::string third = d3plot_state(model, 3, false, false);
  const Reading reading = read_any(folder.write("d3plot", whole + third.substr(0, 40)));
  EXPECT_THAT(reading.notes,
              Contains("40 bytes behind the end of the last complete state are not read"));
  EXPECT_THAT(format_to_read(folder.file("d3plot")).inspect(folder.file("d3plot")).times,
              ElementsAre(1, 2));
}

/// VTK's reader of the same files is another's understanding of the format.
TEST(D3plot, VtkReadsTheSame) {
#ifndef HIAC_WITH_VTK_LSDYNA
  GTEST_SKIP() << "VTK::IOLSDyna is not there";
#else
  Model model = linear_model();
  // of both, VTK 9.1 shows values that the file does not hold
  model.shell = false;
  model.numbers = false;
  for (const bool wide : {false, true})
    for (const bool swapped : {false, true}) {
      const ScratchFolder folder;
      const std::string path = folder.write("d3plot", d3plot_geometry(model, wide, swapped));
      EXPECT_NE(folder.write("d3plot01", d3plot_state(model, 0.5, wide, swapped) +
                                             d3plot_state(model, 1, wide, swapped) +
                                             end_of_states(wide, swapped)),
                "");
      const ZooMesh mesh = read_any(path).mesh;
      vtkNew<vtkLSDynaReader> reader;
      reader->SetFileName(path.c_str());
      reader->UpdateInformation();
      ASSERT_EQ(reader->GetNumberOfTimeSteps(), 2) << wide << swapped;
      reader->SetTimeStep(1);
      reader->Update();
      vtkDataSet* solids = nullptr;
      const auto blocks =
          vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
      for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
        if (auto* block = vtkDataSet::SafeDownCast(blocks->GetCurrentDataObject());
            block != nullptr && block->GetNumberOfCells() == 4)
          solids = block;
      ASSERT_NE(solids, nullptr);
      expect_same(*solids, mesh);
    }
#endif
}

TEST(D3plot, TetrahedraOfTenNodesHaveTheirNodesOnTheRightEdges) {
  Model model;
  const std::array<std::array<double, 3>, 4> corners{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}};
  constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
      {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
  model.points.assign(corners.begin(), corners.end());
  for (const auto& [a, b] : kEdges)
    model.points.push_back({(corners[a][0] + corners[b][0]) / 2,
                            (corners[a][1] + corners[b][1]) / 2,
                            (corners[a][2] + corners[b][2]) / 2});
  model.solids = {{1, 2, 3, 4, 5, 6, 7, 8}};
  model.more = {{9, 10}};
  const ScratchFolder folder;
  const ZooMesh mesh = read_any(folder.write("d3plot", d3plot_geometry(model, false, false) +
                                                           d3plot_state(model, 1, false, false)))
                           .mesh;
  ASSERT_EQ(mesh.kinds[0], CellKind::tetrahedron10);  // the gate has seen to the edges
  EXPECT_EQ(scalar_field(mesh, "temperature").values[1], mesh.position(1)[0] + 1);
}

TEST(D3plot, DamagedFilesAreRefused) {
  const Model model = linear_model();
  const ScratchFolder folder;
  const std::string whole =
      d3plot_geometry(model, false, false) + d3plot_state(model, 1, false, false);
  const std::size_t geometry = d3plot_geometry(model, false, false).size();
  for (std::size_t length = 256; length + 92 < geometry; length += 52)
    EXPECT_NE(refusal(folder.write("d3plot", whole.substr(0, length))), "") << length;
  for (std::size_t word = 15; word < 64; ++word) {
    std::string changed = whole;
    changed[4 * word + 3] = '\x7f';
    static_cast<void>(refusal(folder.write("d3plot", changed)));  // refused or read, not more
  }
}

}  // namespace
}  // namespace hiac::formats
