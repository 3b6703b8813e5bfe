// Random damage of every kind of input of every tool: the tool ends by itself, soon, within its
// memory, with exit code 0, 1, 2 or 3 and a message of one line. HIAC_MUTATIONS: how many changes
// of each input are tried (20).

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kView =
    "[image]\nwidth = 8\nheight = 6\n[camera]\nprojection = \"perspective\"\n"
    "eye = [0.5, 0.5, -3.0]\nlook_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nfov = 30.0\n"
    "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
    "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]\n"
    "[[isosurface]]\nfield = \"f\"\nvalue = 0.5\ncolor = [1.0, 0.8, 0.2]\nopacity = 0.4\n";

/// A view whose colours are the damaged colour map.
std::string view_with_map(const std::string& name) {
  std::string view = kView;
  const std::string points = "points = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]]";
  return view.replace(view.find(points), points.size(),
                      "preset = \"" + name + "\"\nrange = [0.0, 1.0]");
}

constexpr const char* kMapJson =
    "[{\"Name\": \"a\", \"ColorSpace\": \"RGB\", \"RGBPoints\": "
    "[0.0, 0.0, 0.0, 1.0, 0.5, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]}]\n";
constexpr const char* kMapXml =
    "<ColorMaps><ColorMap name=\"a\" space=\"RGB\"><Point x=\"0\" o=\"1\" r=\"0\" g=\"0\" b=\"1\"/>"
    "<Point x=\"1\" o=\"1\" r=\"1\" g=\"0\" b=\"0\"/></ColorMap></ColorMaps>\n";

constexpr const char* kLegacy =
    "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
    "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\n"
    "SCALARS f double 1\nLOOKUP_TABLE default\n1 2 nan 4\n";

constexpr const char* kPoly =
    "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 0\n1\n3 1 3 2\n1\n3 1 2 4\n1\n3 2 3 4\n1\n"
    "3 3 1 4\n0\n0\n";

/// A state of ParaView, as short as it may be: a volume with logarithmic colours and a curved
/// opacity, and a contour.
std::string state() {
  const auto property = [](const std::string& name, const std::vector<std::string>& values) {
    std::string text = "<Property name=\"" + name + "\">";
    for (const std::string& value : values) text += "<Element value=\"" + value + "\"/>";
    return text + "</Property>";
  };
  const auto reference = [](const std::string& name, const std::string& ids) {
    return "<Property name=\"" + name + "\"><Proxy value=\"" + ids + "\"/></Property>";
  };
  const auto proxy = [](const std::string& kind, const std::string& properties) {
    return "<Proxy " + kind + ">" + properties + "</Proxy>";
  };
  const std::vector<std::string> array{"", "", "", "0", "f"};
  return "<ServerManagerState version=\"5.11.0\">" +
         proxy("group=\"views\" type=\"RenderView\" id=\"1\"",
               property("CameraPosition", {"0.5", "0.5", "-3"}) +
                   property("CameraFocalPoint", {"0.5", "0.5", "0"}) +
                   property("CameraViewUp", {"0", "1", "0"}) + property("ViewSize", {"8", "6"}) +
                   property("Background", {"0.1", "0.2", "0.3"}) +
                   "<Property name=\"Representations\"><Proxy value=\"2\"/><Proxy value=\"6\"/>"
                   "</Property>") +
         proxy("group=\"representations\" type=\"UnstructuredGridRepresentation\" id=\"2\"",
               reference("Input", "3") + property("Representation", {"Volume"}) +
                   property("ColorArrayName", array) +
                   property("SelectMapper", {"Bunyk ray cast"}) +
                   property("ScalarOpacityUnitDistance", {"0.3"}) + reference("LookupTable", "4") +
                   reference("ScalarOpacityFunction", "5")) +
         proxy("group=\"sources\" type=\"XMLUnstructuredGridReader\" id=\"3\"",
               property("FileName", {"m.vtu"})) +
         proxy("group=\"lookup_tables\" type=\"PVLookupTable\" id=\"4\"",
               property("ColorSpace", {"2"}) + property("UseLogScale", {"1"}) +
                   property("NumberOfTableValues", {"7"}) +
                   property("RGBPoints", {"0.1", "0", "0.2", "1", "1", "1", "0.5", "0"})) +
         proxy("group=\"piecewise_functions\" type=\"PiecewiseFunction\" id=\"5\"",
               property("Points", {"0", "0.1", "0.3", "0.5", "1", "0.9", "0.5", "0"})) +
         proxy("group=\"representations\" type=\"GeometryRepresentation\" id=\"6\"",
               reference("Input", "7") + property("Representation", {"Surface"}) +
                   property("DiffuseColor", {"1", "0.5", "0"})) +
         proxy("group=\"filters\" type=\"Contour\" id=\"7\"",
               reference("Input", "3") + property("SelectInputScalars", array) +
                   property("ContourValues", {"0.25", "0.5"})) +
         "</ServerManagerState>";
}

/// An input, and what reads it: %s is the damaged file's name (in `view-NAME`: of the view of it).
struct Input {
  std::string name, command;
};

const std::vector<Input> kInputs{
    {"m.zoo", HIAC_RENDER " %s --view v.toml -o o.png"},
    {"m.zoo", HIAC_SORT " %s --view v.toml -o o.order --verify"},
    {"m.zoo", HIAC_CHECK " %s --overlap --cycles -o o.zoo"},
    {"m.zoo", HIAC_INFO " %s"},
    {"m.zoo", HIAC_CONVERT " %s -o o.vtu"},
    {"m.zoo", HIAC_CONVERT " %s -o o.ply"},
    {"m.zoo", HIAC_TETRAHEDRALIZE " %s --cells -o o.zoo"},
    {"m.order", HIAC_RENDER " m.zoo --view v.toml --order %s -o o.png"},
    {"m.order", HIAC_INFO " %s"},
    {"v.toml", HIAC_RENDER " m.zoo --view %s -o o.png"},
    {"v.toml", HIAC_SORT " m.zoo --view %s -o o.order"},
    {"s.pvsm", HIAC_RENDER " m.zoo --view %s -o o.png"},
    {"a.png", HIAC_COMPARE " %s b.png"},
    {"a.exr", HIAC_COMPARE " %s b.png"},
    {"a.npy", HIAC_COMPARE " %s b.png"},
    {"a.tiff", HIAC_COMPARE " %s b.png"},
    {"a.png", HIAC_RENDER " m.zoo --view v.toml --size 4x3 --under %s -o o.exr"},
    {"c.json", HIAC_RENDER " m.zoo --view view-%s -o o.png"},
    {"c.xml", HIAC_RENDER " m.zoo --view view-%s -o o.png"},
    {"a.sgi", HIAC_INFO " %s"},
    {"a.pfm", HIAC_INFO " %s"},
    {"a.hdr", HIAC_INFO " %s"},
    {"s.stl", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.off", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.ply", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.obj", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.poly", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.vtp", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"s.vtu", HIAC_TETRAHEDRALIZE " %s -o o.zoo"},
    {"p.csv", HIAC_TETRAHEDRALIZE " %s --delaunay -o o.zoo"},
    {"m.vtu", HIAC_CONVERT " %s -o o.zoo"},
    {"m.vtk", HIAC_CONVERT " %s -o o.zoo"},
    {"m.vtu", HIAC_CONVERT " --list %s"},
    {"m.vtkhdf", HIAC_CONVERT " %s -o o.zoo"},
    {"m.msh", HIAC_CONVERT " %s -o o.zoo"},
};

class MutatedInputs : public testing::Test {
 protected:
  void SetUp() override {
    ZooMesh mesh = structured(1, Cut::tetrahedra);
    add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
    write_zoo_file(path("m.zoo"), {mesh, {}});
    write("v.toml", kView);
    write("s.pvsm", state());
    std::vector<double> values(48);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 48;
    for (const char* image : {"a.png", "a.exr", "a.npy", "a.tiff", "a.sgi", "a.pfm", "a.hdr"})
      write_image(path(image), Image(4, 3, rgba_channels(), values));
    write_image(path("b.png"), Image(4, 3, rgba_channels(), values));
    write("c.json", kMapJson);
    write("c.xml", kMapXml);
    for (const char* damaged : {"d.json", "d.xml"})
      write(std::string("view-") + damaged, view_with_map(damaged));
    write("m.vtk", kLegacy);
    write("s.poly", kPoly);
    write("p.csv", "x,y,z,f\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n1,1,1,5\n");
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    write("s.off", "OFF\n4 4 0\n" + points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    write("s.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    write(
        "s.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
            points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    write("s.stl", stl());
    ASSERT_EQ(run(HIAC_CONVERT " m.zoo -o s.vtp"), 0) << complaint();
    write("s.vtu", vtu_surface());
    ASSERT_EQ(run(HIAC_SORT " m.zoo --view v.toml -o m.order"), 0) << complaint();
    for (const char* mesh_file : {"m.vtu", "m.vtkhdf", "m.msh"})
      ASSERT_EQ(run(std::string(HIAC_CONVERT " m.zoo -o ") + mesh_file), 0) << complaint();
  }
  static std::string stl() {
    const char* corners[] = {"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
    const int triangles[][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    std::string text = "solid a\n";
    for (const auto& triangle : triangles) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (const int corner : triangle) text += std::string("vertex ") + corners[corner] + "\n";
      text += "endloop\nendfacet\n";
    }
    return text + "endsolid a\n";
  }

  static std::string vtu_surface() {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">"
           "<UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"4\"><Points>"
           "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
           "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>"
           "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">"
           "0 2 1 0 1 3 1 2 3 2 0 3</DataArray>"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5</DataArray>"
           "</Cells></Piece></UnstructuredGrid></VTKFile>";
  }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string bytes_of(const std::string& name) const {
    return test::bytes_of(path(name));
  }
  [[nodiscard]] std::string complaint() const { return bytes_of("err.txt"); }

  /// The exit status; 128 and the signal's number where one ended it, as after 20 seconds of work;
  /// 124 where nothing happens.
  [[nodiscard]] int run(const std::string& command) const {
    const int status =
        std::system(("cd '" + folder_.path().string() + "' && ulimit -t 20 && timeout 300 " +
                     command + " >out.txt 2>err.txt </dev/null")
                        .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  ScratchFolder folder_;
};

std::string mutated(std::string bytes, std::mt19937& random) {
  static const std::vector<std::string> kTelling{"0",
                                                 "-1",
                                                 "9999999999",
                                                 "1e400",
                                                 "nan",
                                                 "",
                                                 "\n",
                                                 ",",
                                                 "\xff",
                                                 "\"",
                                                 "=",
                                                 "[",
                                                 "2000000000",
                                                 std::string(4, '\0'),
                                                 std::string("\xff\xff\xff\x7f", 4),
                                                 std::string(8, '\xff')};
  for (std::size_t changes = 1 + random() % 4; changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = random() % bytes.size();
    switch (random() % 6) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, random() % 16);
        break;
      case 2:
        bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 64));
        break;
      case 3:
        bytes.replace(at, random() % 6, kTelling[random() % kTelling.size()]);
        break;
      default:
        bytes[at] = static_cast<char>(random() % 256);
    }
  }
  return bytes;
}

TEST_F(MutatedInputs, EndWithACodeAndALine) {
  const char* wanted = std::getenv("HIAC_MUTATIONS");
  const int rounds = wanted == nullptr ? 20 : std::atoi(wanted);
  std::mt19937 random(20261123);
  std::size_t runs = 0;
  for (const Input& input : kInputs) {
    const std::string sound = bytes_of(input.name);
    ASSERT_FALSE(sound.empty()) << input.name;
    const std::string damaged = "d" + fs::path(input.name).extension().string();
    std::string command = input.command + " --max-memory 1GB";
    command.replace(command.find("%s"), 2, damaged);
    for (int round = 0; round < rounds; ++round) {
      const std::string bytes = round == 0 ? sound : mutated(sound, random);
      write(damaged, bytes);
      const int code = run(command);
      ++runs;
      if (round == 0) {
        ASSERT_EQ(code, 0) << command << "\n" << complaint();
      }
      const std::string kept = "/tmp/hiac-mutated-finding-" + damaged;
      if (code < 0 || code > 3) std::ofstream(kept, std::ios::binary) << bytes;
      ASSERT_TRUE(code >= 0 && code <= 3)
          << command << " ends with " << code << " (input kept in " << kept << ")\n"
          << complaint();
    }
  }
  RecordProperty("runs", static_cast<int>(runs));
}

}  // namespace
}  // namespace hiac::test
