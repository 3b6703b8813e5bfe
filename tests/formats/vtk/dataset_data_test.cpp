// Fields and data of VTK's datasets, VTK's messages, and the cells that VTK has none for.

#include <fmt/format.h>
#include <vtkBitArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>

#include "formats/vtk/fields_from_vtk.hpp"
#include "formats/vtk/from_vtk.hpp"
#include "formats/vtk/message_capture.hpp"
#include "formats/vtk/written_cells.hpp"
#include "tests/formats/files.hpp"

namespace hiac::formats::vtk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Entry = std::pair<std::string, std::string>;

/// Two points along x, in one cell's place.
vtkNew<vtkImageData> two_points() {
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 1, 1);
  return image;
}

template <typename Array>
vtkNew<Array> named_array(const char* name, const std::vector<double>& values) {
  vtkNew<Array> array;
  array->SetName(name);
  for (const double value : values)
    array->InsertNextValue(static_cast<typename Array::ValueType>(value));
  return array;
}

struct Moved {
  ZooMesh mesh;
  std::vector<std::string> notes;
};

Moved moved(vtkDataSet& dataset, const TupleChoice& points) {
  Moved result;
  move_fields(dataset, points, {1, true, {}}, "file", result.mesh, result.notes);
  return result;
}

TEST(DatasetData, FieldsOfEveryNumberType) {
  const auto image = two_points();
  image->GetPointData()->AddArray(named_array<vtkFloatArray>("f", {0.5, -1}));
  image->GetPointData()->AddArray(named_array<vtkIntArray>("i", {7, -8}));
  vtkNew<vtkBitArray> bits;
  bits->SetName("b");
  bits->InsertNextValue(1);
  bits->InsertNextValue(0);
  image->GetPointData()->AddArray(bits);
  const auto doubles = named_array<vtkDoubleArray>("d", {1, 2});
  doubles->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), "mm");
  image->GetPointData()->AddArray(doubles);
  image->GetPointData()->AddArray(named_array<vtkIntArray>(nullptr, {3, 4}));
  image->GetCellData()->AddArray(named_array<vtkIntArray>("", {5}));
  const Moved result = moved(*image, {2, true, {}});
  std::vector<std::string> names;
  for (const Field& field : result.mesh.fields) names.push_back(field.name);
  EXPECT_THAT(names, ElementsAre("f", "i", "b", "d", "node field 4", "cell field 0"));
  EXPECT_THAT(result.mesh.fields[0].values.view(), ElementsAre(0.5, -1));
  EXPECT_THAT(result.mesh.fields[1].values.view(), ElementsAre(7, -8));
  EXPECT_THAT(result.mesh.fields[2].values.view(), ElementsAre(1, 0));
  EXPECT_EQ(result.mesh.fields[3].unit, "mm");
  EXPECT_EQ(result.mesh.fields[1].unit, "");
  EXPECT_THAT(result.notes, IsEmpty());
  EXPECT_EQ(image->GetPointData()->GetNumberOfArrays(), 0);
}

TEST(DatasetData, ChosenTuplesAreCopied) {
  const auto image = two_points();
  const auto add = [&](auto array, const char* name) {
    array->SetName(name);
    array->SetNumberOfComponents(2);
    for (const int value : {0, 1, 1, 0}) array->InsertNextValue(static_cast<unsigned char>(value));
    image->GetPointData()->AddArray(array);
  };
  add(vtkSmartPointer<vtkIntArray>::New(), "i");
  add(vtkSmartPointer<vtkBitArray>::New(), "b");
  const std::vector<std::uint32_t> second{1};
  const Moved result = moved(*image, {2, false, second});
  ASSERT_EQ(result.mesh.fields.size(), 2U);
  EXPECT_THAT(result.mesh.fields[0].values.view(), ElementsAre(1, 0));
  EXPECT_THAT(result.mesh.fields[1].values.view(), ElementsAre(1, 0));
}

TEST(DatasetData, IntegersBeyondWhatDoublesHoldAreTold) {
  const auto notes = [](auto array) {
    const auto image = two_points();
    image->GetPointData()->AddArray(array);
    return moved(*image, {2, true, {}}).notes;
  };
  constexpr double kExact = 9007199254740992.0;
  EXPECT_THAT(notes(named_array<vtkTypeInt64Array>("i", {kExact, -kExact}).Get()), IsEmpty());
  EXPECT_THAT(notes(named_array<vtkTypeInt64Array>("i", {1, -2}).Get()), IsEmpty());
  EXPECT_THAT(notes(named_array<vtkTypeInt64Array>("i", {0, kExact + 2}).Get()),
              ElementsAre("field 'i' holds integers beyond 2^53, which are rounded"));
  EXPECT_THAT(notes(named_array<vtkTypeInt64Array>("i", {-kExact - 2, 0}).Get()),
              ElementsAre(HasSubstr("beyond 2^53")));
  EXPECT_THAT(notes(named_array<vtkDoubleArray>("d", {0, kExact + 2}).Get()), IsEmpty());
  EXPECT_THAT(notes(named_array<vtkFloatArray>("f", {0, 1e30}).Get()), IsEmpty());
}

TEST(DatasetData, FieldsThatAreNone) {
  const auto image = two_points();
  vtkNew<vtkStringArray> texts;
  texts->SetName("t");
  texts->InsertNextValue("a");
  texts->InsertNextValue("b");
  image->GetPointData()->AddArray(texts);
  image->GetPointData()->AddArray(named_array<vtkIntArray>("vtkGhostLevels", {0, 0}));
  image->GetPointData()->AddArray(named_array<vtkIntArray>("vtkGhostType", {0, 0}));
  const Moved result = moved(*image, {2, true, {}});
  EXPECT_THAT(result.mesh.fields, IsEmpty());
  EXPECT_THAT(result.notes, ElementsAre("field 't' holds no numbers: left out"));
  const auto other = two_points();
  other->GetCellData()->AddArray(named_array<vtkIntArray>("c", {0, 0}));
  try {
    moved(*other, {2, true, {}});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: field 'c' does not fit (1 tuples expected, 2 found)");
  }
}

TEST(DatasetData, DataOfTheWholeAreMetadata) {
  vtkNew<vtkFieldData> data;
  data->AddArray(named_array<vtkDoubleArray>("TimeValue", {0.5}));
  data->AddArray(named_array<vtkIntArray>("short", std::vector<double>(16, 3)));
  data->AddArray(named_array<vtkIntArray>("long", std::vector<double>(17, 3)));
  data->AddArray(named_array<vtkIntArray>("none", {}));
  const auto rows = named_array<vtkIntArray>("rows", {1, 2, 3, 4, 5, 6});
  rows->SetNumberOfComponents(3);
  data->AddArray(rows);
  for (const auto& [name, count] : {std::pair<const char*, int>{"text", 1}, {"texts", 2}}) {
    vtkNew<vtkStringArray> texts;
    texts->SetName(name);
    for (int i = 0; i < count; ++i) texts->InsertNextValue("words");
    data->AddArray(texts);
  }
  ZooMesh mesh;
  mesh.metadata = {{"text", "old"}};
  std::vector<std::string> notes;
  add_metadata(*data, mesh, notes);
  EXPECT_THAT(mesh.metadata, ElementsAre(Entry("text", "words"), Entry("time", "0.5"),
                                         Entry("short", "3 3 3 3 3 3 3 3 3 3 3 3 3 3 3 3"),
                                         Entry("rows", "1 2 3 4 5 6")));
  EXPECT_THAT(
      notes, ElementsAre("left out data of the whole dataset: long (17 values), texts (2 values)"));
  EXPECT_THAT(times_of(*data), ElementsAre(0.5));
  vtkNew<vtkFieldData> older;
  older->AddArray(named_array<vtkDoubleArray>("other", {7}));
  EXPECT_THAT(times_of(*older), IsEmpty());
  older->AddArray(named_array<vtkDoubleArray>("TIME", {1, 2}));
  EXPECT_THAT(times_of(*older), ElementsAre(1, 2));
}

TEST(DatasetData, SummariesOfFields) {
  const auto image = two_points();
  image->GetPointData()->AddArray(named_array<vtkFloatArray>("f", {0.5, -1}));
  const auto pair = named_array<vtkIntArray>("c", {3, 4});
  pair->SetNumberOfComponents(2);
  image->GetCellData()->AddArray(pair);
  const auto summaries = summarize_fields(*image);
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].name, "f");
  EXPECT_EQ(summaries[0].location, "node");
  EXPECT_EQ(summaries[0].type, "float");
  EXPECT_EQ(summaries[0].tuples, 2U);
  EXPECT_EQ(summaries[0].low, -1);
  EXPECT_EQ(summaries[0].high, 0.5);
  EXPECT_EQ(summaries[1].location, "cell");
  EXPECT_EQ(summaries[1].components, 2U);
  EXPECT_EQ(summaries[1].tuples, 1U);
}

std::string step_complaint(const ReadOptions& options, const std::vector<double>& times) {
  try {
    check_step(options, times, "file");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "none";
}

TEST(DatasetData, StepsThatADatasetDoesNotHave) {
  ReadOptions options;
  EXPECT_EQ(step_complaint(options, {}), "none");
  options.step = 0;
  EXPECT_EQ(step_complaint(options, {}), "none");
  options.step = 1;
  EXPECT_EQ(step_complaint(options, {1}), "step 1: file holds one step (0 expected)");
  options.step.reset();
  options.time = 0.5;
  EXPECT_EQ(step_complaint(options, {}), "time 0.5: file tells no time");
  EXPECT_EQ(step_complaint(options, {0.5}), "none");
  EXPECT_EQ(step_complaint(options, {2}), "time 0.5: file holds another time (2 found)");
  EXPECT_EQ(step_complaint(options, {0.5, 2}), "time 0.5: file holds another time (0.5 2 found)");
  options.block = "b";
  EXPECT_EQ(step_complaint(options, {0.5}), "block b: file has no named blocks");
}

TEST(DatasetData, MessagesOfVtkBecomeErrorsAndNotes) {
  const auto said = [](const MessageCapture& messages) -> std::string {
    try {
      messages.throw_on_error("file");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  const vtkSmartPointer<vtkOutputWindow> outer = vtkOutputWindow::GetInstance();
  const vtkLogger::Verbosity verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_WARNING);
  {
    const MessageCapture messages;
    vtkOutputWindow* const window = vtkOutputWindow::GetInstance();
    EXPECT_NE(window, outer);
    EXPECT_FALSE(messages.any_error());
    EXPECT_EQ(said(messages), "none");
    window->DisplayWarningText("Warning: In a.cxx, line 1\nvtkReader (0x1): it is odd\n\n");
    window->DisplayWarningText("Warning: In b.cxx, line 2\nvtkReader (0x2): it is odd\n\n");
    window->DisplayWarningText("Warning: In b.cxx, line 3\nnothing known\nof it\n");
    EXPECT_FALSE(messages.any_error());
    EXPECT_THAT(messages.warnings(), ElementsAre("it is odd", "nothing known of it"));
    for (int i = 0; i < 10; ++i) window->DisplayWarningText(fmt::format("{}", i).c_str());
    EXPECT_EQ(messages.warnings().size(), 8U);
    window->DisplayErrorText("ERROR: In a.cxx, line 7\nvtkReader (0x55): it breaks\r\ndown\n\n");
    window->DisplayErrorText("ERROR: In a.cxx, line 8\nvtkReader (0x55): again\n\n");
    EXPECT_TRUE(messages.any_error());
    EXPECT_EQ(said(messages), "file: cannot be read: it breaks  down");
  }
  EXPECT_EQ(vtkOutputWindow::GetInstance(), outer);
  EXPECT_EQ(vtkLogger::GetCurrentVerbosityCutoff(), vtkLogger::VERBOSITY_WARNING);
  vtkLogger::SetStderrVerbosity(verbosity);
  const MessageCapture generic;
  vtkOutputWindow::GetInstance()->DisplayGenericWarningText(
      "Generic Warning: In a.cxx, line 9\nno number\n\n");
  EXPECT_EQ(said(generic), "file: cannot be read: no number");
}

TEST(DatasetData, MessagesOfVtkTellNoAddressesAndContentsOfObjects) {
  const MessageCapture messages;
  for (const char* text :
       {"vtkPipeline (0x1): Algorithm vtkReader(0x55a1c7033e20) returned failure for request: "
        "vtkInformation (0x55a1c7034f90)\n  Debug: Off\n  Modified Time: 735\n\n",
        "vtkReader (0x1): no vtkPoints (0x2c) for vtkCells (0x3)\n\n",
        "vtkReader (0x1): vtkCells (0x3)\n  Debug: Off\n\n", "vtkReader (0x1): is (0x open\n\n"})
    vtkOutputWindow::GetInstance()->DisplayWarningText(
        (std::string("Warning: In a.cxx, line 1\n") + text).c_str());
  EXPECT_THAT(messages.warnings(),
              ElementsAre("Algorithm vtkReader returned failure for request",
                          "no vtkPoints for vtkCells", "vtkCells", "is (0x open"));
}

TEST(DatasetData, KindsThatVtkHasNoCellFor) {
  const auto written = [](CellKind kind, std::vector<std::string>& notes) -> std::string {
    ZooMesh mesh;
    mesh.kinds = std::vector{kind, kind};
    try {
      const WrittenCells table = written_cells(mesh, "vtu", "a.vtu", notes);
      return fmt::format("{} of {}", table[static_cast<std::size_t>(kind)]->type,
                         table[static_cast<std::size_t>(kind)]->nodes.size());
    } catch (const InputError& error) {
      return error.what();
    }
  };
  std::vector<std::string> notes;
  for (const auto& [kind, type] : {std::pair{CellKind::tetrahedron4, VTK_TETRA},
                                   {CellKind::tetrahedron20, VTK_LAGRANGE_TETRAHEDRON},
                                   {CellKind::brick20, VTK_QUADRATIC_HEXAHEDRON},
                                   {CellKind::prism15, VTK_QUADRATIC_WEDGE},
                                   {CellKind::pyramid13, VTK_QUADRATIC_PYRAMID}})
    EXPECT_EQ(written(kind, notes), fmt::format("{} of 0", static_cast<int>(type)));
  EXPECT_THAT(notes, IsEmpty());
  for (const CellKind kind :
       {CellKind::pyramid21, CellKind::prism24, CellKind::wedge29, CellKind::brick32})
    EXPECT_EQ(written(kind, notes),
              fmt::format("a.vtu: vtu has no cell for a {} (2 found)", kind_name(kind)));
  EXPECT_EQ(written(CellKind::wedge7, notes),
            fmt::format("{} of 8", static_cast<int>(VTK_HEXAHEDRON)));
  EXPECT_THAT(notes,
              ElementsAre("2 wedge7 cells written as bricks with a repeated node, vtu having "
                          "no such cell"));
  notes.clear();
  EXPECT_EQ(written(CellKind::wedge18, notes),
            fmt::format("{} of 20", static_cast<int>(VTK_QUADRATIC_HEXAHEDRON)));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 wedge18 cells written as bricks")));
}

}  // namespace
}  // namespace hiac::formats::vtk
