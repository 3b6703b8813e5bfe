#include "tests/tools/small_inputs.hpp"

#include <cstddef>
#include <cstdlib>
#include <fstream>

#include "hiac/image/image_io.hpp"
#include "hiac/mesh/zoo_container.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace hiac::test {
namespace {

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

constexpr const char* kCamera =
    "<PVCameraConfiguration version=\"1.0\"><Proxy><Property name=\"CameraPosition\">"
    "<Element index=\"0\" value=\"0.5\"/><Element index=\"1\" value=\"0.5\"/>"
    "<Element index=\"2\" value=\"-3\"/></Property><Property name=\"CameraFocalPoint\">"
    "<Element value=\"0.5\"/><Element value=\"0.5\"/><Element value=\"0\"/></Property>"
    "<Property name=\"CameraViewUp\"><Element value=\"0\"/><Element value=\"1\"/>"
    "<Element value=\"0\"/></Property>"
    "<Property name=\"CameraViewAngle\"><Element value=\"25\"/></Property></Proxy>"
    "</PVCameraConfiguration>";

std::string stl() {
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

std::string vtu_surface() {
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

/// All pictures of one file; one in .f32 is several, read by their common name and --width.
const std::vector<std::string> kPictures{"a.png", "a.exr", "a.npy", "a.tiff",
                                         "a.sgi", "a.pfm", "a.hdr"};
constexpr const char* kChannel = "a.r.f32";

ToolInputs of_render() {
  ToolInputs of{"render",
                {{"m.zoo", HIAC_RENDER " %s --view v.toml -o o.png"},
                 {"m.zoo", HIAC_RENDER " %s --pixel 400,300"},
                 {"m.zoo", HIAC_RENDER " m.zoo %s --view v.toml -o o-%d.png"},
                 {"m.zoo", HIAC_RENDER " %s --size 8x6 -o o.png"},
                 {"m.vtu", HIAC_RENDER " %s --view v.toml -o o.png"},
                 {"m.order", HIAC_RENDER " m.zoo --view v.toml --order %s -o o.png"},
                 {"v.toml", HIAC_RENDER " m.zoo --view %s -o o.png"},
                 {"v.toml", HIAC_RENDER " m.zoo --view %s --colorbar o.png"},
                 {"t.toml", HIAC_RENDER " m.zoo --view %s --frame 1 -o o.png"},
                 {"s.pvsm", HIAC_RENDER " m.zoo --view %s -o o.png"},
                 {"s.pvsm", HIAC_RENDER " --view %s -o o.png"},
                 {"c.pvcc", HIAC_RENDER " m.zoo --size 8x6 --view %s -o o.png"},
                 {"c.json", HIAC_RENDER " m.zoo --view view-%s -o o.png"},
                 {"c.xml", HIAC_RENDER " m.zoo --view view-%s -o o.png"}}};
  for (const char* picture : {"p.png", "p.exr", "p.tiff"})
    of.inputs.push_back({picture, HIAC_RENDER " m.zoo --view %s -o o.npy"});
  for (const std::string& picture : kPictures)
    of.inputs.push_back(
        {picture, HIAC_RENDER " m.zoo --view v.toml --size 4x3 --under %s -o o.exr"});
  of.inputs.push_back(
      {kChannel, HIAC_RENDER " m.zoo --view v.toml --size 4x3 --under d.f32 -o o.exr"});
  return of;
}

ToolInputs of_sort() {
  return {"sort",
          {{"m.zoo", HIAC_SORT " %s --view v.toml -o o.order --verify"},
           {"m.zoo", HIAC_SORT " %s --view v.toml -o o.order --overlap"},
           {"m.zoo", HIAC_SORT " %s --view v.toml -o o.order --algorithm mpvo"},
           {"m.vtu", HIAC_SORT " %s --view v.toml -o o.order"},
           {"m.order", HIAC_SORT " m.zoo --view v.toml --order %s --verify"},
           {"v.toml", HIAC_SORT " m.zoo --view %s -o o.order"},
           {"s.pvsm", HIAC_SORT " m.zoo --view %s -o o.order"},
           {"p.png", HIAC_SORT " m.zoo --view %s -o o.order"}}};
}

ToolInputs of_check() {
  return {"check",
          {{"m.zoo", HIAC_CHECK " %s --overlap --cycles --quality -o o.zoo"},
           {"m.zoo", HIAC_CHECK " %s --repair -o o.zoo"},
           {"m.zoo", HIAC_CHECK " %s --picture o.png --size 8x6"},
           {"m.vtu", HIAC_CHECK " %s -o o.zoo"},
           {"v.toml", HIAC_CHECK " m.zoo --cycles --view %s"}}};
}

ToolInputs of_info() {
  ToolInputs of{"info",
                {{"m.zoo", HIAC_INFO " %s"},
                 {"m.zoo", HIAC_INFO " %s --starter-view -o o.toml"},
                 {"m.vtu", HIAC_INFO " %s"},
                 {"m.zparts", HIAC_INFO " %s"},
                 {"m.order", HIAC_INFO " %s"}}};
  for (const std::string& picture : kPictures) of.inputs.push_back({picture, HIAC_INFO " %s"});
  of.inputs.push_back({kChannel, HIAC_INFO " d.f32 --width 4"});
  return of;
}

ToolInputs of_compare() {
  ToolInputs of{"compare",
                {{"m.zoo", HIAC_COMPARE " a.png --truth %s --view v.toml"},
                 {"m.vtu", HIAC_COMPARE " a.png --truth %s --view v.toml"},
                 {"v.toml", HIAC_COMPARE " a.png --truth m.zoo --view %s --heatmap o.png"},
                 {"p.png", HIAC_COMPARE " %s --truth m.zoo"}}};
  for (const std::string& picture : kPictures) {
    of.inputs.push_back({picture, HIAC_COMPARE " %s b.png"});
    of.inputs.push_back({picture, HIAC_COMPARE " b.png %s --heatmap o.png"});
  }
  of.inputs.push_back({kChannel, HIAC_COMPARE " d.f32 b.png --width 4"});
  return of;
}

ToolInputs of_tetrahedralize() {
  ToolInputs of{"tetrahedralize",
                {{"m.zoo", HIAC_TETRAHEDRALIZE " %s --cells --linearize --levels 1 -o o.zoo"},
                 {"m.zoo", HIAC_TETRAHEDRALIZE " %s --delaunay -o o.zoo"}}};
  for (const char* surface : {"s.stl", "s.off", "s.ply", "s.obj", "s.poly", "s.smesh", "s.vtp",
                              "s.vtu", "b.stl", "b.ply"})
    of.inputs.push_back({surface, HIAC_TETRAHEDRALIZE " %s -o o.zoo"});
  for (const char* points : {"p.csv", "p.txt", "p.xyz", "p.node"})
    of.inputs.push_back({points, HIAC_TETRAHEDRALIZE " %s --delaunay -o o.zoo"});
  return of;
}

ToolInputs of_convert() {
  ToolInputs of{"convert",
                {{"m.zoo", HIAC_CONVERT " %s --parts 2 -o o.zparts"},
                 {"m.zoo", HIAC_CONVERT " - -o o.vtu < %s"},
                 {"m.zoo", HIAC_CONVERT " %s --derive 's=f*2' --warp n:2 -o o.zoo"},
                 {"m.zparts", HIAC_CONVERT " %s -o o.zoo"},
                 {"m.1.zoo", "mv %s m.1.zoo; " HIAC_CONVERT " m.zparts -o o.zoo"},
                 {"m.vtu", HIAC_CONVERT " --list %s"},
                 {"m.vtu", HIAC_CONVERT " %s --invalid cut -o o.zoo"}}};
  for (const char* made : {".vtu", ".vtkhdf", ".msh", ".stl", ".ply", ".vtp"})
    of.inputs.push_back({"m.zoo", HIAC_CONVERT " %s -o o" + std::string(made)});
  return of;
}

#ifdef HIAC_PREVIEW
ToolInputs of_preview() {
  return {"preview",
          {{"m.zoo", HIAC_PREVIEW " %s --view v.toml -o o.png"},
           {"m.zoo", HIAC_PREVIEW " %s --view v.toml --method M2 -o o.png"},
           {"m.order", HIAC_PREVIEW " m.zoo --view v.toml --order %s -o o.png"},
           {"v.toml", HIAC_PREVIEW " m.zoo --view %s -o o.png"},
           {"s.pvsm", HIAC_PREVIEW " m.zoo --view %s -o o.png"}}};
}
#endif

#ifdef HIAC_RENDER_MPI
ToolInputs of_render_mpi() {
  return {"render-mpi",
          {{"m.zoo", HIAC_RENDER_MPI " %s --view v.toml -o o.png"},
           {"m.zparts", HIAC_RENDER_MPI " %s --view v.toml -o o.png"},
           {"m.1.zoo", "mv %s m.1.zoo; " HIAC_RENDER_MPI " m.zparts --view v.toml -o o.png"},
           {"v.toml", HIAC_RENDER_MPI " m.zparts --view %s -o o.png"}}};
}
#endif

/// Writes files by programs of C++ into a folder.
class Writer {
 public:
  explicit Writer(const std::filesystem::path& folder) : folder_(folder) {}

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  void text(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  /// Runs a tool; keeps its message where it fails.
  void tool(const std::string& command) {
    const std::string line =
        "cd '" + folder_.string() + "' && " + command + " >out.txt 2>err.txt </dev/null";
    if (std::system(line.c_str()) != 0 && failure_.empty())
      failure_ = command + ": " + bytes_of(path("err.txt"));
  }
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  std::filesystem::path folder_;
  std::string failure_;
};

void write_pictures(const Writer& writer) {
  std::vector<double> values(48);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 48;
  const Image picture(4, 3, rgba_channels(), values);
  for (const std::string& name : kPictures) write_image(writer.path(name), picture);
  write_image(writer.path("b.png"), picture);
  // of one in .f32 a single channel is damaged
  for (const char* name : {"a.f32", "d.f32"}) write_image(writer.path(name), picture);
}

void write_views(const Writer& writer) {
  writer.text("v.toml", kView);
  writer.text("t.toml", std::string(kView) + "[turntable]\nframes = 3\n");
  writer.text("s.pvsm", state());
  writer.text("c.pvcc", kCamera);
  writer.text("c.json", kMapJson);
  writer.text("c.xml", kMapXml);
  for (const char* damaged : {"d.json", "d.xml"})
    writer.text(std::string("view-") + damaged, view_with_map(damaged));
}

void write_surfaces(const Writer& writer) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string triangles = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  writer.text("s.off", "OFF\n4 4 0\n" + points + triangles);
  writer.text("s.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  writer.text(
      "s.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n" +
          points + triangles);
  writer.text("s.stl", stl());
  writer.text("s.vtu", vtu_surface());
  writer.text("s.poly", kPoly);
  writer.text("s.smesh",
              "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 0\n3 1 3 2\n3 1 2 4\n3 2 3 4\n"
              "3 3 1 4\n0\n0\n");
  const std::string rows = "0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n1 1 1 5\n";
  writer.text("p.csv", "x,y,z,f\n0,0,0,1\n1,0,0,2\n0,1,0,3\n0,0,1,4\n1,1,1,5\n");
  writer.text("p.txt", "x y z f\n" + rows);
  writer.text("p.xyz", rows);
  writer.text("p.node", "5 3 1 0\n1 0 0 0 1\n2 1 0 0 2\n3 0 1 0 3\n4 0 0 1 4\n5 1 1 1 5\n");
}

}  // namespace

std::vector<ToolInputs> inputs_of_tools() {
  std::vector<ToolInputs> all{of_render(),  of_sort(),    of_check(),         of_info(),
                              of_compare(), of_convert(), of_tetrahedralize()};
#ifdef HIAC_PREVIEW
  all.push_back(of_preview());
#endif
#ifdef HIAC_RENDER_MPI
  all.push_back(of_render_mpi());
#endif
  all.push_back(
      {"umbrella",
       {{"m.zoo", HIAC_UMBRELLA " picture %s --size 8x6"}, {"m.vtu", HIAC_UMBRELLA " check %s"}}});
  return all;
}

std::string write_small_inputs(const std::filesystem::path& folder) {
  Writer writer(folder);
  ZooMesh mesh = structured(1, Cut::tetrahedra);
  add_node_field(mesh, "f", [](const Position& p) { return p[0]; });
  mesh.fields.push_back(
      {"n", "m", FieldLocation::node, 3, std::vector<double>(3 * mesh.node_count(), 0.01)});
  write_zoo_file(writer.path("m.zoo"), {mesh, {}});
  write_pictures(writer);
  write_views(writer);
  write_surfaces(writer);
  writer.tool(HIAC_CONVERT " m.zoo -o s.vtp");
  writer.tool(HIAC_CONVERT " m.zoo -o b.stl");
  writer.tool(HIAC_CONVERT " m.zoo -o b.ply");
  writer.tool(HIAC_CONVERT " m.zoo -o m.vtu");
  writer.tool(HIAC_CONVERT " m.zoo --parts 2 -o m.zparts");
  writer.tool(HIAC_SORT " m.zoo --view v.toml -o m.order");
  for (const char* picture : {"p.png", "p.exr", "p.tiff"})
    writer.tool(HIAC_RENDER " m.zoo --view v.toml -o " + std::string(picture));
  return writer.failure();
}

}  // namespace hiac::test
