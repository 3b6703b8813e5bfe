#include "tests/fuzz/seeds.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "formats/registry.hpp"
#include "hiac/mesh/parted/write_parts.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/one_cell_files.hpp"
#include "tests/formats/solver_files.hpp"
#include "tests/fuzz/habit_seeds.hpp"
#include "tests/fuzz/input_files.hpp"
#include "tests/fuzz/other_targets.hpp"
#include "tests/fuzz/surface_seeds.hpp"

namespace hiac::fuzz {
namespace {

using formats::Bytes;
using Texts = std::vector<std::string>;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What `write` writes under that name, and further files beside it.
template <typename Write>
std::string written_files(const std::string& name, const Write& write) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       fmt::format("hiac-fuzz-seed-{}", std::random_device()());
  std::filesystem::create_directory(folder);
  write((folder / name).string());
  std::string text = bytes_of(folder / name);
  std::set<std::string> others;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    others.insert(entry.path().filename().string());
  others.erase(name);
  for (const std::string& other : others) text += parcel(other, bytes_of(folder / other));
  std::filesystem::remove_all(folder);
  return text;
}

/// A mesh written by the format.
std::string written_seed(const formats::Format& format) {
  ZooMesh mesh;
  const auto places = reference_nodes(CellKind::brick20);
  std::vector<double> xyz;
  std::vector<NodeId> nodes;
  for (const auto& place : places) {
    nodes.push_back(static_cast<NodeId>(nodes.size()));
    xyz.insert(xyz.end(), place.begin(), place.end());
  }
  const std::size_t count = nodes.size();
  mesh.kinds = std::vector<CellKind>{CellKind::brick20};
  mesh.elems = std::vector<std::uint64_t>{0, count};
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  mesh.fields.push_back({"a", "", FieldLocation::corner, 1, std::vector<double>(count, 0.5)});
  mesh.fields.push_back({"b", "", FieldLocation::node, 3, std::vector<double>(3 * count, 2)});
  return written_files("input" + std::string(format.extensions.front()),
                       [&](const std::string& path) { format.write(path, mesh); });
}

/// The corners of a unit brick, x fastest, each through a pattern.
std::string corners(const char* pattern) {
  std::string text;
  for (int n = 0; n < 8; ++n) text += fmt::format(fmt::runtime(pattern), n % 2, n / 2 % 2, n / 4);
  return text;
}

std::string column(int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += fmt::format("{}.5\n", n);
  return text;
}

/// Bricks, tetrahedra and prisms of EnSight, all on the corners of one brick.
Texts ensight() {
  const std::string case_text =
      "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: 1 input.geo\nVARIABLE\n"
      "scalar per node: 1 p input.p\nvector per element: 1 v input.v\nTIME\ntime set: 1\n"
      "number of steps: 1\ntime values: 0.5\n";
  const std::string ascii =
      "a\nb\nnode id assign\nelement id off\npart\n1\none\ncoordinates\n8\n0\n1\n0\n1\n0\n1\n0\n1\n"
      "0\n0\n1\n1\n0\n0\n1\n1\n0\n0\n0\n0\n1\n1\n1\n1\nhexa8\n1\n1 2 4 3 5 6 8 7\ntria3\n1\n1 2 "
      "3\n";
  const std::string point_values = "p\npart\n1\ncoordinates\n" + column(8);
  const std::string cell_values = "v\npart\n1\nhexa8\n" + column(3) + "tria3\n" + column(3);
  const std::string values = parcel("input.p", point_values) + parcel("input.v", cell_values);
  const std::string polyhedron =
      "a\nb\nnode id given\nelement id given\npart\n1\none\ncoordinates\n4\n5\n6\n7\n8\n"
      "0\n1\n0\n0\n0\n0\n1\n0\n0\n0\n0\n1\nnfaced\n1\n9\n4\n3\n3\n3\n3\n1 3 2\n1 2 4\n2 3 4\n1 4 "
      "3\n";
  const std::string block =
      "a\nb\nnode id off\nelement id off\npart\n1\none\nblock iblanked\n2 2 2\n"
      "0\n1\n0\n1\n0\n1\n0\n1\n0\n0\n1\n1\n0\n0\n1\n1\n0\n0\n0\n0\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1"
      "\n"
      "1\n";
  const std::string plain = "FORMAT\ntype: ensight gold\nGEOMETRY\nmodel: input.geo\n";
  const auto line = [](std::string text) {
    text.resize(80, ' ');
    return text;
  };
  Bytes binary;
  for (const char* text : {"C Binary", "a", "b", "node id off", "element id off", "part"})
    binary.raw(line(text));
  binary.whole(1).raw(line("one")).raw(line("coordinates")).whole(4);
  for (const int x : {0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) binary.mark(static_cast<float>(x));
  binary.raw(line("tetra4")).wholes({1, 1, 2, 3, 4});
  return {case_text + parcel("input.geo", ascii) + values, plain + parcel("input.geo", polyhedron),
          plain + parcel("input.geo", block), plain + parcel("input.geo", binary.str())};
}

std::string foam_file(const std::string& name, const std::string& kind, const std::string& body) {
  return parcel(name, fmt::format("FoamFile\n{{ version 2.0; format ascii; class {}; object x; }}\n"
                                  "{}\n",
                                  kind, body));
}

Texts openfoam() {
  const std::string folder = "constant/polyMesh/";
  const std::string mesh =
      parcel("input.foam", "") +
      foam_file(folder + "points", "vectorField", "8\n(\n" + corners("({} {} {})\n") + ")") +
      foam_file(folder + "faces", "faceList",
                "6(4(0 2 3 1) 4(4 5 7 6) 4(0 1 5 4) 4(2 6 7 3) 4(0 4 6 2) 4(1 3 7 5))") +
      foam_file(folder + "owner", "labelList", "6(0 0 0 0 0 0)") +
      foam_file(folder + "neighbour", "labelList", "0()") +
      foam_file(folder + "boundary", "polyBoundaryMesh",
                "1(wall { type wall; nFaces 6; startFace 0; })");
  const std::string field = foam_file("0.5/p", "volScalarField",
                                      "dimensions [0 2 -2 0 0 0 0];\n"
                                      "internalField nonuniform List<scalar> 1(2.5);\n"
                                      "boundaryField { wall { type zeroGradient; } }");
  std::string parts = parcel("input.foam", "");
  for (const int part : {0, 1}) {
    const std::string root = fmt::format("processor{}/", part);
    parts +=
        foam_file(
            root + folder + "points", "vectorField",
            part == 0 ? "4((0 0 0)(1 0 0)(0 1 0)(0 0 1))" : "4((1 1 1)(1 0 0)(0 1 0)(0 0 1))") +
        foam_file(root + folder + "faces", "faceList",
                  part == 0 ? "4(3(0 2 1) 3(0 1 3) 3(0 3 2) 3(1 2 3))"
                            : "4(3(1 2 0) 3(2 3 0) 3(3 1 0) 3(1 3 2))") +
        foam_file(root + folder + "owner", "labelList", "4{0}") +
        foam_file(root + folder + "neighbour", "labelList", "0()") +
        foam_file(root + folder + "boundary", "polyBoundaryMesh",
                  fmt::format("1(a {{ type processor; nFaces 1; startFace 3; neighbProcNo {}; }})",
                              1 - part)) +
        foam_file(root + "1/p", "volScalarField", "internalField uniform 1;\n");
  }
  const std::string addresses =
      foam_file("processor0/" + folder + "pointProcAddressing", "labelList", "4(0 1 2 3)") +
      foam_file("processor1/" + folder + "pointProcAddressing", "labelList", "4(4 1 2 3)") +
      foam_file("processor0/" + folder + "cellProcAddressing", "labelList", "1(1)") +
      foam_file("processor1/" + folder + "cellProcAddressing", "labelList", "1(0)");
  return {mesh + field, parts, parts + addresses};
}

Texts mfem() {
  const std::string mesh =
      "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 5 0 1 3 2 4 5 7 6\n\nboundary\n0\n\n"
      "vertices\n8\n";
  const std::string function =
      "FiniteElementSpace\nFiniteElementCollection: H1_3D_P1\nVDim: 1\n"
      "Ordering: 0\n\n";
  const std::string curved =
      "MFEM mesh v1.0\n\ndimension\n3\n\nelements\n1\n1 4 0 1 2 3\n\nboundary\n0\n\nvertices\n4\n\n"
      "nodes\nFiniteElementSpace\nFiniteElementCollection: Quadratic\nVDim: 3\nOrdering: 1\n\n"
      "0 0 0\n2 0 0\n0 2 0\n0 0 2\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n1 0 1\n0 1 1\n";
  return {mesh + "3\n" + corners("{} {} {}\n") + parcel("input.gf", function + column(8)), curved};
}

Texts plot3d() {
  const std::string coordinates = "0 1 0 1 0 1 0 1\n0 0 1 1 0 0 1 1\n0 0 0 0 1 1 1 1\n";
  Bytes binary;
  binary.wholes({12, 2, 2, 2, 12, 96});
  for (int axis = 0; axis < 3; ++axis)
    for (int n = 0; n < 8; ++n) binary.mark(static_cast<float>(n >> axis & 1));
  binary.whole(96);
  const std::string index =
      "{\"filenames\": [{\"time\": 0, \"xyz\": \"a.xyz\", \"function\": \"a.f\"}], "
      "\"function-names\": [\"u\"]}";
  return {"2 2 2\n" + coordinates, binary.str(),
          parcel("input.p3d", index) + parcel("a.xyz", "2 2 2\n" + coordinates) +
              parcel("a.f", "2 2 2 1\n1 2 3 4 5 6 7 8\n")};
}

Texts tetgen() {
  return {"4 3 1 1\n1 0 0 0 5 1\n2 1 0 0 6 1\n3 0 1 0 7 1\n4 0 0 1 8 0\n" +
          parcel("input.ele", "1 4 1\n1 1 2 3 4 9\n")};
}

Texts xdmf() {
  return {
      "<Xdmf Version=\"3.0\"><Domain><Grid Name=\"g\"><Topology TopologyType=\"Hexahedron\" "
      "NumberOfElements=\"1\"><DataItem Dimensions=\"1 8\" Format=\"XML\" DataType=\"Int\">"
      "0 1 3 2 4 5 7 6</DataItem></Topology><Geometry GeometryType=\"XYZ\"><DataItem "
      "Dimensions=\"8 3\" Format=\"XML\">" +
          corners("{} {} {} ") +
          "</DataItem></Geometry><Attribute Name=\"u\" Center=\"Node\"><DataItem "
          "Dimensions=\"8\" Format=\"XML\">1 2 3 4 5 6 7 8</DataItem></Attribute></Grid></Domain>"
          "</Xdmf>",
      "<Xdmf><Domain><Grid Name=\"t\" GridType=\"Collection\" CollectionType=\"Temporal\"><Time "
      "TimeType=\"List\"><DataItem Dimensions=\"2\">0 1</DataItem></Time><Grid><Topology "
      "TopologyType=\"3DCoRectMesh\" Dimensions=\"2 2 2\"/><Geometry "
      "GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Dimensions=\"3\">0 0 0</DataItem><DataItem "
      "Dimensions=\"3\">1 1 1</DataItem></Geometry></Grid><Grid><Topology "
      "TopologyType=\"Mixed\" NumberOfElements=\"1\"><DataItem Dimensions=\"5\">6 0 1 2 4"
      "</DataItem></Topology><Geometry><DataItem Dimensions=\"8 3\">" +
          corners("{} {} {} ") + "</DataItem></Geometry></Grid></Grid></Domain></Xdmf>"};
}

Texts vtk() {
  return {"# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n" +
              corners("{} {} {}\n") +
              "CELLS 2 14\n8 0 1 3 2 4 5 7 6\n4 0 1 2 4\nCELL_TYPES 2\n12 10\nPOINT_DATA 8\n"
              "SCALARS p double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\nCELL_DATA 2\nFIELD f 1\n"
              "v 3 2 float\n1 2 3 4 5 6\n",
          "# vtk DataFile Version 5.1\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n" +
              corners("{} {} {}\n") +
              "CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 4\n"
              "CELL_TYPES 1\n10\n",
          "# vtk DataFile Version 3.0\na\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
          "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8\nVECTORS v float\n" +
              corners("{} {} {}\n"),
          "# vtk DataFile Version 3.0\na\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\n"
          "X_COORDINATES 2 float\n0 1\nY_COORDINATES 2 float\n0 1\nZ_COORDINATES 2 float\n0 1\n"
          "CELL_DATA 1\nTENSORS t float\n1 2 3 4 5 6 7 8 9\n",
          "# vtk DataFile Version 3.0\na\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\n"
          "POINTS 8 int\n" +
              corners("{} {} {}\n")};
}

constexpr const char* kValues =
    "<PointData><DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">1 2 3 4 5 6 7 8"
    "</DataArray></PointData><CellData><DataArray type=\"Int8\" Name=\"c\" "
    "NumberOfComponents=\"2\" format=\"binary\">AgAAAAED</DataArray></CellData>";

std::string vtk_file(const char* type, const std::string& attributes, const std::string& body) {
  return fmt::format(
      "<VTKFile type=\"{0}\" version=\"0.1\" byte_order=\"LittleEndian\"><{0}{1}>{2}</{0}>"
      "</VTKFile>",
      type, attributes, body);
}

std::string xml_points() {
  return "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
         corners("{} {} {} ") + "</DataArray></Points>";
}

Texts vtu() {
  const auto array = [](const char* name, const char* values) {
    return fmt::format("<DataArray type=\"Int64\" Name=\"{}\" format=\"ascii\">{}</DataArray>",
                       name, values);
  };
  const std::string piece = "<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\">" + xml_points();
  const std::string brick = "<Cells>" + array("connectivity", "0 1 3 2 4 5 7 6") +
                            array("offsets", "8") + array("types", "12") + "</Cells>";
  const std::string polyhedron =
      "<Cells>" + array("connectivity", "0 1 2 4") + array("offsets", "4") + array("types", "42") +
      array("faces", "4 3 0 2 1 3 0 1 4 3 1 2 4 3 0 4 2") + array("faceoffsets", "17") + "</Cells>";
  const std::string steps =
      "<PointData><DataArray TimeStep=\"0\" type=\"Float32\" Name=\"p\" format=\"ascii\">"
      "1 2 3 4 5 6 7 8</DataArray><DataArray TimeStep=\"1\" type=\"Float32\" Name=\"p\" "
      "format=\"ascii\">2 3 4 5 6 7 8 9</DataArray></PointData>";
  return {vtk_file("UnstructuredGrid", "", piece + brick + kValues + "</Piece>"),
          vtk_file("UnstructuredGrid", "", piece + polyhedron + "</Piece>"),
          vtk_file("UnstructuredGrid", " TimeValues=\"0 1\"", piece + brick + steps + "</Piece>")};
}

const std::string kExtent = "\"0 1 0 1 0 1\"";

std::string structured(const char* type, const std::string& attributes, const std::string& body) {
  return vtk_file(type, " WholeExtent=" + kExtent + attributes,
                  "<Piece Extent=" + kExtent + ">" + body + kValues + "</Piece>");
}

Texts vtr() {
  const std::string axis = "<DataArray type=\"Float32\" format=\"ascii\">0 1</DataArray>";
  return {
      structured("RectilinearGrid", "", "<Coordinates>" + axis + axis + axis + "</Coordinates>")};
}

Texts vti() { return {structured("ImageData", " Origin=\"0 0 0\" Spacing=\"1 1 1\"", "")}; }

Texts vts() { return {structured("StructuredGrid", "", xml_points())}; }

Texts pvtu() {
  return {vtk_file("PUnstructuredGrid", "", "<Piece Source=\"a.vtu\"/>") +
          parcel("a.vtu", vtu().front())};
}

/// A parallel file of one structured piece.
Texts parallel(const char* type, const std::string& attributes, const char* piece,
               const Texts& of) {
  return {vtk_file(type, " GhostLevel=\"0\" WholeExtent=" + kExtent + attributes,
                   fmt::format("<Piece Extent={} Source=\"{}\"/>", kExtent, piece)) +
          parcel(piece, of.front())};
}

Texts pvti() {
  return parallel("PImageData", " Origin=\"0 0 0\" Spacing=\"1 1 1\"", "a.vti", vti());
}
Texts pvtr() { return parallel("PRectilinearGrid", "", "a.vtr", vtr()); }
Texts pvts() { return parallel("PStructuredGrid", "", "a.vts", vts()); }

Texts pvd() {
  return {vtk_file("Collection", "",
                   "<DataSet timestep=\"0\" part=\"0\" file=\"a.vtu\"/><DataSet timestep=\"1\" "
                   "name=\"b\" file=\"b.vti\"/>") +
          parcel("a.vtu", vtu().front()) + parcel("b.vti", vti().front())};
}

Texts vtm() {
  return {vtk_file("vtkMultiBlockDataSet", "",
                   "<Block index=\"0\" name=\"x\"><DataSet index=\"0\" name=\"y\" "
                   "file=\"a.vtu\"/></Block><DataSet index=\"1\" file=\"b.vti\"/>") +
          parcel("a.vtu", vtu().front()) + parcel("b.vti", vti().front())};
}

/// The header of a netCDF file of one dimension, two attributes and a variable.
Texts classic_netcdf() {
  Bytes out(true);
  out.raw("CDF\x01").wholes({0, 10, 1, 1}).raw("n   ").whole(3);
  out.wholes({12, 1, 5}).raw("title   ").wholes({2, 3}).raw("abc ");
  out.wholes({11, 1, 1}).raw("v   ").wholes({1, 0, 0, 0, 6, 24});
  const auto begin = static_cast<std::int32_t>(out.str().size() + 4);
  out.whole(begin).real(1).real(2).real(3);
  return {out.str()};
}

Texts points() { return {"x,y,z,T\n0,0,0,1\n1,0,0,2\n0,1,0,nan\n", "0 0 0\n1 0 0\n"}; }

Texts d3plot() {
  const formats::Model model = formats::linear_model();
  return {d3plot_geometry(model, false, false) + d3plot_state(model, 1, false, false)};
}

/// Two tetrahedra with a face in common, each a part.
Texts zparts() {
  ZooMesh mesh;
  mesh.kinds = std::vector<CellKind>(2, CellKind::tetrahedron4);
  mesh.elems = std::vector<std::uint64_t>{0, 4, 8};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 0, 2, 1, 4};
  mesh.xyz = std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1};
  mesh.fields.push_back({"t", "K", FieldLocation::node, 1, std::vector<double>{0, 1, 2, 3, 4}});
  return {written_files("input.zparts", [&](const std::string& path) {
    write_parted_mesh(path, mesh, std::vector<std::uint32_t>{0, 1}, 2, [](const std::string&) {});
  })};
}

Texts tecplot() {
  return {formats::tecplot_bricks({}), formats::tecplot_polyhedra(false),
          "VARIABLES = X, Y, Z\nZONE ZONETYPE=FEPOLYHEDRON, NODES=4, ELEMENTS=1, FACES=4, "
          "TotalNumFaceNodes=12, DATAPACKING=BLOCK\n0 1 0 0\n0 0 1 0\n0 0 0 1\n3 3 3 3\n"
          "1 3 2 1 2 4 2 3 4 1 4 3\n1 1 1 1\n0 0 0 0\n"};
}

}  // namespace

std::vector<std::string> seeds(const std::string& name) {
  static const std::map<std::string, std::function<Texts()>> known{
      {"classic-netcdf", classic_netcdf},
      {"d3plot", d3plot},
      {"ensight", ensight},
      {"mfem", mfem},
      {"openfoam", openfoam},
      {"plot3d", plot3d},
      {"points", points},
      {"pvd", pvd},
      {"pvti", pvti},
      {"pvtr", pvtr},
      {"pvts", pvts},
      {"pvtu", pvtu},
      {"tecplot", tecplot},
      {"tetgen", tetgen},
      {"vti", vti},
      {"vtk", vtk},
      {"vtm", vtm},
      {"vtr", vtr},
      {"vts", vts},
      {"vtu", vtu},
      {"xdmf", xdmf},
      {"zparts", zparts}};
  Texts texts;
  if (known.contains(name)) texts = known.at(name)();
  for (std::string& text : habit_seeds(name)) texts.push_back(std::move(text));
  for (std::string& text : surface_seeds(name)) texts.push_back(std::move(text));
#ifdef HIAC_WITH_OTHER_TARGETS
  for (std::string& text : other_seeds(name)) texts.push_back(std::move(text));
#endif
  for (const formats::OneCellFile& file : formats::one_cell_files())
    if (file.format == name) texts.push_back(file.text);
  for (const formats::Format& format : formats::all_formats())
    if (format.name == name && format.write) texts.push_back(written_seed(format));
  return texts;
}

}  // namespace hiac::fuzz
