// The arrays of VTK's datasets, right and wrong: cells, faces and marks of ghosts.
#include <array>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "formats/vtk/cells_from_vtk.hpp"
#include "formats/vtk/dataset_cells.hpp"
#include "formats/vtk/foreign_from_vtk.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats::vtk {
namespace {

using testing::Contains;
using testing::ElementsAre;

template <typename Read>
std::string array_complaint(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

vtkNew<vtkPoints> eight_points() {
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 8; ++i) points->InsertNextPoint((i + 1) / 2 % 2, i / 2 % 2, i / 4);
  return points;
}

template <typename Array>
vtkNew<Array> array_with(const std::vector<int>& values) {
  vtkNew<Array> array;
  for (const int value : values)
    array->InsertNextValue(static_cast<typename Array::ValueType>(value));
  return array;
}

/// A grid of eight points whose arrays hold what they are given.
template <typename Index>
vtkSmartPointer<vtkUnstructuredGrid> grid_with(const std::vector<int>& offsets,
                                               const std::vector<int>& connectivity,
                                               const std::vector<int>& types) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(eight_points());
  vtkNew<vtkCellArray> cells;
  cells->SetData(array_with<Index>(offsets), array_with<Index>(connectivity));
  // VTK takes the connectivity of polyhedra for lists of faces where it is told of these first
  const auto kept = array_with<vtkUnsignedCharArray>(std::vector<int>(types.size(), VTK_TETRA));
  grid->SetCells(kept, cells);
  for (std::size_t i = 0; i < types.size(); ++i)
    kept->SetValue(static_cast<vtkIdType>(i), static_cast<unsigned char>(types[i]));
  return grid;
}

std::string cells_complaint(const std::vector<int>& offsets, const std::vector<int>& connectivity,
                            const std::vector<int>& types = {VTK_TETRA}) {
  const auto read = [](vtkUnstructuredGrid& grid) {
    return array_complaint([&] {
      DatasetCells cells(grid, "file");
      for (std::size_t i = 0; i < cells.count(); ++i) cells.cell(i);
    });
  };
  const std::string wide = read(*grid_with<vtkTypeInt64Array>(offsets, connectivity, types));
  EXPECT_EQ(read(*grid_with<vtkTypeInt32Array>(offsets, connectivity, types)), wide);
  return wide;
}

TEST(DatasetArrays, OffsetsRiseToTheListsEnd) {
  const std::string wrong = "file: cell 0: wrong offsets (0 to 4 in rising order expected, ";
  EXPECT_EQ(cells_complaint({0, 4}, {0, 1, 2, 4}), "none");
  EXPECT_EQ(cells_complaint({0, 5}, {0, 1, 2, 4}), wrong + "0 and 5 found)");
  EXPECT_EQ(cells_complaint({-1, 4}, {0, 1, 2, 4}), wrong + "-1 and 4 found)");
  EXPECT_EQ(cells_complaint({3, 2}, {0, 1, 2, 4}), wrong + "3 and 2 found)");
  EXPECT_EQ(cells_complaint({0, 4, 3}, {0, 1, 2, 4}, {VTK_TETRA, VTK_TETRA}),
            "file: cell 1: wrong offsets (0 to 4 in rising order expected, 4 and 3 found)");
  EXPECT_EQ(cells_complaint({0, 0, 4}, {0, 1, 2, 4}, {VTK_EMPTY_CELL, VTK_TETRA}), "none");
}

TEST(DatasetArrays, PointsAndTypesFitTheCells) {
  EXPECT_EQ(cells_complaint({0, 4}, {0, 1, 2, 7}), "none");
  EXPECT_EQ(cells_complaint({0, 4}, {0, 1, 2, 8}),
            "file: cell 0: no such point (0 to 7 expected, 8 found)");
  EXPECT_EQ(cells_complaint({0, 4}, {-1, 1, 2, 7}),
            "file: cell 0: no such point (0 to 7 expected, -1 found)");
  EXPECT_EQ(cells_complaint({0, 4}, {0, 1, 2, 7}, {VTK_TETRA, VTK_TETRA}),
            "file: the cell types do not fit the cells (1 expected, 2 found)");
  // a polyhedron's points are those of its faces
  EXPECT_EQ(cells_complaint({0, 4}, {0, 1, 2, 8}, {VTK_POLYHEDRON}), "none");
}

TEST(DatasetArrays, CellsOfImagesAreBricks) {
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 2);
  DatasetCells cells(*image, "file");
  EXPECT_EQ(cells.count(), 6U);
  EXPECT_EQ(cells.point_count(), 24U);
  EXPECT_EQ(cells.entry_count(), 48U);
  const auto points = [&](std::size_t cell) {
    const StoredCell stored = cells.cell(cell);
    EXPECT_EQ(stored.type, VTK_HEXAHEDRON);
    return std::vector<vtkIdType>(stored.points.begin(), stored.points.end());
  };
  EXPECT_THAT(points(0), ElementsAre(0, 1, 4, 3, 12, 13, 16, 15));
  EXPECT_THAT(points(1), ElementsAre(1, 2, 5, 4, 13, 14, 17, 16));
  EXPECT_THAT(points(5), ElementsAre(7, 8, 11, 10, 19, 20, 23, 22));
  vtkNew<vtkImageData> deep;
  deep->SetDimensions(2, 3, 3);
  DatasetCells layers(*deep, "file");
  const StoredCell last = layers.cell(3);
  EXPECT_THAT(std::vector<vtkIdType>(last.points.begin(), last.points.end()),
              ElementsAre(8, 9, 11, 10, 14, 15, 17, 16));
}

vtkSmartPointer<vtkUnstructuredGrid> two_tetrahedra() {
  return grid_with<vtkTypeInt64Array>({0, 4, 8}, {0, 1, 3, 4, 5, 4, 6, 1}, {VTK_TETRA, VTK_TETRA});
}

TEST(DatasetArrays, MarksSayWhichCellsAreNotHere) {
  for (const auto& [mark, ghost] : {std::pair<int, bool>{0, false},
                                    {vtkDataSetAttributes::DUPLICATECELL, true},
                                    {vtkDataSetAttributes::HIGHCONNECTIVITYCELL, false},
                                    {vtkDataSetAttributes::LOWCONNECTIVITYCELL, false},
                                    {vtkDataSetAttributes::REFINEDCELL, true},
                                    {vtkDataSetAttributes::EXTERIORCELL, false},
                                    {vtkDataSetAttributes::HIDDENCELL, true}}) {
    const auto grid = two_tetrahedra();
    const auto marks = array_with<vtkUnsignedCharArray>({0, mark});
    marks->SetName("vtkGhostType");
    grid->GetCellData()->AddArray(marks);
    const DatasetCells cells(*grid, "file");
    EXPECT_FALSE(cells.is_ghost(0));
    EXPECT_EQ(cells.is_ghost(1), ghost) << mark;
    std::vector<std::string> notes;
    EXPECT_EQ(convert_cells(*grid, {}, "file", notes).kinds.size(), ghost ? 1U : 2U);
    if (ghost)
      EXPECT_THAT(notes, Contains("dropped 1 ghost or hidden cells"));
    else
      EXPECT_THAT(notes, testing::IsEmpty());
  }
}

TEST(DatasetArrays, HiddenPointsTakeTheirCellsAway) {
  for (const auto& [mark, hidden] : {std::pair<int, bool>{0, false},
                                     {vtkDataSetAttributes::DUPLICATEPOINT, false},
                                     {vtkDataSetAttributes::HIDDENPOINT, true}}) {
    const auto grid = two_tetrahedra();
    const auto marks = array_with<vtkUnsignedCharArray>({0, 0, 0, 0, 0, 0, mark, 0});
    marks->SetName("vtkGhostType");
    grid->GetPointData()->AddArray(marks);
    const DatasetCells cells(*grid, "file");
    const std::array<vtkIdType, 2> with{1, 6};
    const std::array<vtkIdType, 2> without{1, 5};
    EXPECT_EQ(cells.has_hidden_point(with), hidden);
    EXPECT_FALSE(cells.has_hidden_point(without));
    const auto counts = count_cells(*grid, "file");
    EXPECT_EQ(counts.size(), hidden ? 2U : 1U);
    for (const CellCount& count : counts) EXPECT_EQ(count.count, hidden ? 1U : 2U);
  }
}

TEST(DatasetArrays, MarksFitTheirCells) {
  const auto said = [](const std::vector<int>& values, int components) {
    const auto grid = two_tetrahedra();
    const auto marks = array_with<vtkUnsignedCharArray>(values);
    marks->SetNumberOfComponents(components);
    marks->SetName("vtkGhostType");
    grid->GetCellData()->AddArray(marks);
    return array_complaint([&] { const DatasetCells cells(*grid, "file"); });
  };
  EXPECT_EQ(said({0, 1}, 1), "none");
  EXPECT_EQ(said({0}, 1), "file: the ghost marks do not fit (2 expected, 1 found)");
  EXPECT_EQ(said({0, 1, 0}, 1), "file: the ghost marks do not fit (2 expected, 3 found)");
  EXPECT_EQ(said({0, 1, 0, 1}, 2), "file: the ghost marks do not fit (2 expected, 4 found)");
}

/// A tetrahedron as a polyhedron; its list of faces has that number in that place.
vtkSmartPointer<vtkUnstructuredGrid> polyhedron_with(vtkIdType place, vtkIdType number) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(eight_points());
  const std::array<vtkIdType, 16> faces{3, 0, 3, 1, 3, 0, 1, 4, 3, 1, 3, 4, 3, 3, 0, 4};
  grid->InsertNextCell(VTK_POLYHEDRON, 4, faces.data());
  if (place >= 0) grid->GetFaces()->SetValue(place, number);
  return grid;
}

TEST(DatasetArrays, FacesOfPolyhedraStayInTheirList) {
  const auto said = [](vtkIdType place, vtkIdType number) {
    return array_complaint([&] { foreign_from_vtk(*polyhedron_with(place, number), "file"); });
  };
  const std::string damaged = "file: cell 0: a polyhedron with a damaged list of faces";
  EXPECT_TRUE(has_cells_beyond_the_zoo(*polyhedron_with(-1, 0), "file"));
  EXPECT_EQ(said(-1, 0), "none");
  EXPECT_EQ(said(0, 3), "none");
  EXPECT_EQ(said(0, 5), damaged);
  EXPECT_EQ(said(0, -1), damaged);
  EXPECT_EQ(said(1, 18), damaged);
  EXPECT_EQ(said(13, 4), damaged);
  EXPECT_EQ(said(2, 7), "none");
  EXPECT_EQ(said(2, 8), damaged);
  EXPECT_EQ(said(2, -1), damaged);
  const auto without = grid_with<vtkTypeInt64Array>({0, 4}, {0, 1, 2, 4}, {VTK_POLYHEDRON});
  EXPECT_EQ(array_complaint([&] { foreign_from_vtk(*without, "file"); }), damaged);
  const ForeignMesh mesh = foreign_from_vtk(*polyhedron_with(-1, 0), "file");
  EXPECT_THAT(mesh.polyhedra.faces, ElementsAre(3, 0, 3, 1, 3, 0, 1, 4, 3, 1, 3, 4, 3, 3, 0, 4));
  EXPECT_THAT(mesh.notes, testing::IsEmpty());
}

TEST(DatasetArrays, PrismsOverPolygonsAreToldByTheirFaces) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 12; ++i) points->InsertNextPoint(i, 0, 0);
  grid->SetPoints(points);
  const std::array<vtkIdType, 12> ids{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  grid->InsertNextCell(VTK_PENTAGONAL_PRISM, 10, ids.data());
  grid->InsertNextCell(VTK_HEXAGONAL_PRISM, 12, ids.data());
  const ForeignMesh mesh = foreign_from_vtk(*grid, "file");
  EXPECT_THAT(mesh.polyhedra.cells, ElementsAre(0, 1));
  const std::vector<std::int64_t> five(
      mesh.polyhedra.faces.begin(),
      mesh.polyhedra.faces.begin() + static_cast<std::ptrdiff_t>(mesh.polyhedra.ends[0]));
  EXPECT_THAT(five, ElementsAre(5, 0, 1, 2, 3, 4, 5, 5, 6, 7, 8, 9, 4, 0, 1, 6, 5, 4, 1, 2, 7, 6, 4,
                                2, 3, 8, 7, 4, 3, 4, 9, 8, 4, 4, 0, 5, 9));
  EXPECT_EQ(mesh.polyhedra.ends[1] - mesh.polyhedra.ends[0], 2U * 7 + 6 * 5);
  EXPECT_EQ(mesh.polyhedra.faces.back(), 11);
}

TEST(DatasetArrays, GhostsAmongOtherCellsAreLeftOut) {
  for (const bool by_point : {false, true}) {
    const auto grid = two_tetrahedra();
    const auto marks = array_with<vtkUnsignedCharArray>(
        by_point ? std::vector<int>{0, 0, 0, 0, 0, 0, vtkDataSetAttributes::HIDDENPOINT, 0}
                 : std::vector<int>{0, vtkDataSetAttributes::DUPLICATECELL});
    marks->SetName("vtkGhostType");
    if (by_point)
      grid->GetPointData()->AddArray(marks);
    else
      grid->GetCellData()->AddArray(marks);
    const ForeignMesh mesh = foreign_from_vtk(*grid, "file");
    ASSERT_EQ(mesh.cell_count(), 2U);
    EXPECT_EQ(mesh.types[mesh.cell_types[0]].name, "Tetra");
    EXPECT_EQ(mesh.types[mesh.cell_types[1]].name, "ghost or hidden cell");
    EXPECT_THAT(mesh.cell_nodes, ElementsAre(0, 1, 3, 4));
    EXPECT_THAT(mesh.notes, ElementsAre("dropped 1 ghost or hidden cells"));
  }
}

void set_time(vtkUnstructuredGrid& grid, double time) {
  vtkNew<vtkDoubleArray> value;
  value->SetName("TimeValue");
  value->InsertNextValue(time);
  grid.GetFieldData()->AddArray(value);
}

// Cells that the zoo has and cells that their faces tell are read in two ways.
TEST(DatasetArrays, TheOneStepMayBeAskedFor) {
  const auto grid = [](bool polyhedron) {
    auto made = polyhedron ? polyhedron_with(-1, 0) : two_tetrahedra();
    set_time(*made, 2.5);
    return made;
  };
  for (const bool polyhedron : {false, true}) {
    SCOPED_TRACE(polyhedron);
    ReadOptions options;
    const auto refused = [&]() -> std::string {
      try {
        mesh_from_vtk(grid(polyhedron), options, "file");
      } catch (const UsageError& error) {
        return error.what();
      }
      return "none";
    };
    options.step = 1;
    EXPECT_EQ(refused(), "step 1: file holds one step (0 expected)");
    options.step.reset();
    options.time = 3;
    EXPECT_EQ(refused(), "time 3: file holds another time (2.5 found)");
    options.time = 2.5;
    const Reading reading = mesh_from_vtk(grid(polyhedron), options, "file");
    EXPECT_EQ(reading.mesh.cell_count(), polyhedron ? 1U : 2U);
    EXPECT_EQ(reading.mesh.node_count(), polyhedron ? 4U : 6U);
    EXPECT_THAT(reading.mesh.metadata, ElementsAre(testing::Pair("time", "2.5")));
  }
}

TEST(DatasetArrays, WhatADatasetHoldsIsListed) {
  const auto grid = two_tetrahedra();
  set_time(*grid, 2.5);
  const auto marks = array_with<vtkUnsignedCharArray>({0, 7});
  marks->SetName("c");
  grid->GetCellData()->AddArray(marks);
  const Inventory inventory = inventory_from_vtk(*grid, "file");
  EXPECT_EQ(inventory.points, 8U);
  EXPECT_THAT(inventory.times, ElementsAre(2.5));
  ASSERT_EQ(inventory.cells.size(), 1U);
  EXPECT_EQ(inventory.cells[0].kind, "Tetra");
  EXPECT_EQ(inventory.cells[0].count, 2U);
  EXPECT_EQ(inventory.cells[0].fate, "tetrahedron4");
  const auto polyhedra = count_cells(*polyhedron_with(-1, 0), "file");
  ASSERT_EQ(polyhedra.size(), 1U);
  EXPECT_EQ(polyhedra[0].kind, "Polyhedron");
  EXPECT_EQ(polyhedra[0].fate, "what its faces make it");
  ASSERT_EQ(inventory.fields.size(), 1U);
  EXPECT_EQ(inventory.fields[0].name, "c");
  EXPECT_EQ(inventory.fields[0].type, "unsigned char");
  EXPECT_EQ(inventory.fields[0].high, 7);
}

TEST(DatasetArrays, TypesOfNoNodesAreWrong) {
  const auto grid = grid_with<vtkTypeInt64Array>({0, 3}, {0, 1, 2}, {VTK_TETRA});
  EXPECT_EQ(array_complaint([&] { count_cells(*grid, "file"); }),
            "file: cell 0: a Tetra cannot have 3 nodes");
  const auto unknown = grid_with<vtkTypeInt64Array>({0, 3, 3}, {0, 1, 2}, {255, 255});
  const auto counts = count_cells(*unknown, "file");
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_EQ(counts[0].kind, "type 255");
  EXPECT_EQ(counts[1].kind, "type 255 of 3 nodes");
}

}  // namespace
}  // namespace hiac::formats::vtk
