// Fields that a file has at some of its steps only: read where they are, told where they are not,
// and listed.
#include "formats/common/mesh/field_steps.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "formats/common/mesh/assemble.hpp"
#include "tests/formats/files.hpp"
#include "tests/formats/unit_tetrahedron.hpp"

namespace hiac::formats {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> names_of(const ZooMesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) names.push_back(field.name);
  return names;
}

Reading at_step(const std::string& path, std::size_t step) {
  ReadOptions options;
  options.step = step;
  return read_any(path, options);
}

/// A file of three steps, 0, 1 and 2, with the field p at all of them and q at the steps 0 and 1.
void expect_q_at_two_of_three(const std::string& path) {
  for (const std::size_t step : {0, 1}) {
    const Reading reading = at_step(path, step);
    expect_unit_tetrahedron(reading.mesh);
    EXPECT_THAT(names_of(reading.mesh), ElementsAre("p", "q"));
    EXPECT_THAT(reading.notes, Not(Contains(HasSubstr("is absent"))));
  }
  const Reading last = at_step(path, 2);
  expect_unit_tetrahedron(last.mesh);
  EXPECT_THAT(names_of(last.mesh), ElementsAre("p"));
  EXPECT_THAT(last.notes,
              Contains("field 'q' is absent at step 2, time 2: it has values at steps 0, 1"));
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_EQ(inventory.times.size(), 3U);
  EXPECT_THAT(inventory.notes, Contains("field 'q' has values at 2 of 3 steps: 0, 1"));
  EXPECT_THAT(inventory.notes, Not(Contains(HasSubstr("field 'p'"))));
}

TEST(FieldSteps, NotesNameTheStepsInRanges) {
  const FieldSteps fields{
      {"a", {0, 2, 3, 4, 6, 7}}, {"b", {1}}, {"always", {0, 1, 2, 3, 4, 5, 6, 7}}, {"fixed", {}}};
  std::vector<std::string> notes;
  note_partial_fields(fields, 8, notes);
  EXPECT_THAT(notes, ElementsAre("field 'a' has values at 6 of 8 steps: 0, 2 to 4, 6, 7",
                                 "field 'b' has values at 1 of 8 steps: 1"));
  notes.clear();
  const std::vector<double> times{0, 0.1, 0.2, 0.30000000000000004, 0.4, 0.5, 0.6, 0.7};
  note_absent_fields(fields, times, 3, notes);
  EXPECT_THAT(notes,
              ElementsAre("field 'b' is absent at step 3, time 0.3: it has values at step 1"));
  notes.clear();
  note_absent_fields(fields, times, 5, notes);
  EXPECT_EQ(notes.size(), 2U);
}

// what the readers of Exodus, frd, Gmsh, UNV, CGNS and MED hand on: the fields of all steps
TEST(FieldSteps, OfReadersThatKnowAllSteps) {
  const auto mesh = [] {
    ForeignMesh result;
    result.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    result.types.push_back({"tet", 4, converted_to(CellKind::tetrahedron4)});
    result.cell_types = {0};
    result.cell_nodes = {0, 1, 2, 3};
    result.times = {0, 1, 2};
    const auto add = [&](const std::string& name, std::optional<std::size_t> step) {
      result.fields.push_back(field_of(name, FieldLocation::cell, 1, {1.0}));
      result.fields.back().step = step;
    };
    for (const std::size_t step : {0, 1, 2}) add("p", step);
    for (const std::size_t step : {0, 1}) add("q", step);
    add("fixed", std::nullopt);
    return result;
  };
  ReadOptions options;
  options.step = 2;
  const Reading last = assemble(mesh(), options, "m");
  EXPECT_THAT(names_of(last.mesh), ElementsAre("p", "fixed"));
  EXPECT_THAT(last.notes,
              ElementsAre("field 'q' is absent at step 2, time 2: it has values at steps 0, 1"));
  options.step = 1;
  EXPECT_THAT(assemble(mesh(), options, "m").notes, IsEmpty());
  // the last of every field, with a note that names the time
  const Reading all = assemble(mesh(), {}, "m");
  EXPECT_THAT(names_of(all.mesh), ElementsAre("p", "q", "fixed"));
  EXPECT_THAT(all.notes, Contains("field 'q' is of time 1, its last"));
  EXPECT_THAT(inventory_of(mesh(), "m", "m").notes,
              ElementsAre("field 'q' has values at 2 of 3 steps: 0, 1"));
}

TEST(FieldSteps, OfEnSightWithoutTheFilesOfAStep) {
  const ScratchFolder folder;
  static_cast<void>(folder.write(
      "g.geo",
      "a\nb\nnode id off\nelement id off\npart\n         1\ncore\ncoordinates\n         4\n"
      " 0.00000e+00\n 1.00000e+00\n 0.00000e+00\n 0.00000e+00\n"
      " 0.00000e+00\n 0.00000e+00\n 1.00000e+00\n 0.00000e+00\n"
      " 0.00000e+00\n 0.00000e+00\n 0.00000e+00\n 1.00000e+00\n"
      "tetra4\n         1\n         1         2         3         4\n"));
  for (const char* name : {"p0", "p1", "p2", "q0", "q1"})
    static_cast<void>(folder.write(name, "v\npart\n         1\ntetra4\n 7.00000e+00\n"));
  expect_q_at_two_of_three(folder.write(
      "c.case",
      "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: g.geo\nVARIABLE\n"
      "scalar per element: 1 p p*\nscalar per element: 1 q q*\nTIME\ntime set: 1\n"
      "number of steps: 3\nfilename start number: 0\nfilename increment: 1\ntime values: 0 1 2\n"));
  for (const char* name : {"q0", "q1"}) std::filesystem::remove(folder.file(name));
  EXPECT_THAT(refusal(folder.file("c.case")), HasSubstr("q2"));
}

TEST(FieldSteps, OfOpenFoamWithoutTheFilesOfAStep) {
  const ScratchFolder folder;
  const auto write = [&](const std::string& name, const std::string& type,
                         const std::string& body) {
    std::filesystem::create_directories(std::filesystem::path(folder.file(name)).parent_path());
    static_cast<void>(folder.write(
        name, "FoamFile\n{\n version 2.0;\n format ascii;\n class " + type + ";\n}\n" + body));
  };
  const std::string mesh = "constant/polyMesh/";
  write(mesh + "points", "vectorField", "4\n((0 0 0)\n(1 0 0)\n(0 1 0)\n(0 0 1))\n");
  write(mesh + "faces", "faceList", "4( 3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3) )\n");
  write(mesh + "owner", "labelList", "4{0}\n");
  write(mesh + "neighbour", "labelList", "0()\n");
  for (const char* name : {"0/p", "1/p", "2/p", "0/q", "1/q"})
    write(name, "volScalarField", "internalField uniform 7;\n");
  write("0/phi", "surfaceScalarField", "internalField uniform 7;\n");
  const Reading last = at_step(folder.write("a.foam", ""), 2);
  EXPECT_EQ(last.mesh.cell_count(), 1U);
  EXPECT_THAT(names_of(last.mesh), ElementsAre("p"));
  EXPECT_THAT(last.notes,
              Contains("field 'q' is absent at step 2, time 2: it has values at steps 0, 1"));
  EXPECT_THAT(last.notes, Not(Contains(HasSubstr("phi"))));
  EXPECT_THAT(at_step(folder.file("a.foam"), 1).notes, Not(Contains(HasSubstr("is absent"))));
  EXPECT_THAT(format_to_read(folder.file("a.foam")).inspect(folder.file("a.foam")).notes,
              Contains("field 'q' has values at 2 of 3 steps: 0, 1"));
}

/// The unit tetrahedron with its arrays.
std::string vtu_of(const std::vector<std::string>& names) {
  std::string arrays;
  for (const std::string& name : names)
    arrays += "<DataArray type=\"Float64\" Name=\"" + name + "\" format=\"ascii\">7</DataArray>";
  return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
         "<UnstructuredGrid><Piece NumberOfPoints=\"4\" "
         "NumberOfCells=\"1\"><PointData/><CellData>" +
         arrays +
         "</CellData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
         "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>"
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>"
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

TEST(FieldSteps, OfCollectionsOfVtkFiles) {
  const ScratchFolder folder;
  std::string sets;
  for (const int step : {0, 1, 2}) {
    const std::vector<std::string> names{"p", "q"};
    static_cast<void>(folder.write(fmt::format("{}.vtu", step),
                                   vtu_of({names.begin(), names.end() - (step == 2 ? 1 : 0)})));
    sets += fmt::format("<DataSet timestep=\"{0}\" file=\"{0}.vtu\"/>", step);
  }
  const std::string path = folder.write(
      "a.pvd", "<VTKFile type=\"Collection\"><Collection>" + sets + "</Collection></VTKFile>");
  EXPECT_THAT(names_of(at_step(path, 1).mesh), ElementsAre("p", "q"));
  EXPECT_THAT(names_of(at_step(path, 2).mesh), ElementsAre("p"));
  const Inventory inventory = format_to_read(path).inspect(path);
  EXPECT_THAT(inventory.notes, ElementsAre("field 'q' has values at 2 of 3 steps: 0, 1"));
}

TEST(FieldSteps, OfOneVtkFileOfSeveralSteps) {
  const ScratchFolder folder;
  std::string text = vtu_of({"p", "q"});
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  };
  replace("<UnstructuredGrid>", "<UnstructuredGrid TimeValues=\"0 1 2\">");
  replace("Name=\"p\"", "Name=\"p\" TimeStep=\"0 1 2\"");
  replace("Name=\"q\"", "Name=\"q\" TimeStep=\"0 1\"");
  expect_q_at_two_of_three(folder.write("a.vtu", text));
}

TEST(FieldSteps, OfXdmf) {
  if (std::none_of(all_formats().begin(), all_formats().end(),
                   [](const Format& format) { return format.name == "xdmf"; }))
    GTEST_SKIP() << "built without HDF5";
  const ScratchFolder folder;
  std::string grids;
  for (const int step : {0, 1, 2}) {
    grids += fmt::format(
        "<Grid><Time Value=\"{}\"/><Topology TopologyType=\"Tetrahedron\" NumberOfElements=\"1\">"
        "<DataItem Dimensions=\"1 4\" NumberType=\"Int\">0 1 2 3</DataItem></Topology><Geometry>"
        "<DataItem Dimensions=\"4 3\">0 0 0 1 0 0 0 1 0 0 0 1</DataItem></Geometry>",
        step);
    for (const char* name : {"p", "q"})
      if (step < 2 || *name == 'p')
        grids += fmt::format(
            "<Attribute Name=\"{}\" Center=\"Cell\"><DataItem Dimensions=\"1\">7</DataItem>"
            "</Attribute>",
            name);
    grids += "</Grid>";
  }
  expect_q_at_two_of_three(
      folder.write("a.xdmf",
                   "<Xdmf Version=\"3.0\"><Domain><Grid GridType=\"Collection\" "
                   "CollectionType=\"Temporal\">" +
                       grids + "</Grid></Domain></Xdmf>"));
}

}  // namespace
}  // namespace hiac::formats
