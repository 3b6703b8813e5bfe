#include "tests/fuzz/other_targets.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include <fmt/format.h>

#include "hiac/image/image_io.hpp"
#include "hiac/order/order_file.hpp"
#include "hiac/scene/paraview/paraview_view.hpp"
#include "hiac/scene/specification.hpp"
#include "tests/fuzz/input_files.hpp"

namespace hiac::fuzz {
namespace {

constexpr std::array kPictures{"npy", "sgi", "pfm", "hdr"};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void read_order(const std::string& path) {
  const std::string bytes = bytes_of(path);
  static_cast<void>(
      decode_order({kOrderChunk, std::vector<std::uint8_t>(bytes.begin(), bytes.end())}, path));
}

void read_state(const std::string& path) {
  const ParaviewView view = view_from_state(path);
  static_cast<void>(parse_scene(view.text, path));
}

/// A picture as the format's writer makes it.
std::string picture_seed(const std::string& extension, std::vector<std::string> channels) {
  const std::size_t count = 5 * 3 * channels.size();
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<double>(k % 7) / 4;
  const std::string path = (std::filesystem::temp_directory_path() /
                            fmt::format("hiac-fuzz-seed-{}.{}", std::random_device()(), extension))
                               .string();
  write_image(path, Image(5, 3, std::move(channels), std::move(values)));
  std::string bytes = bytes_of(path);
  std::filesystem::remove(path);
  return bytes;
}

std::string order_seed() {
  VisibilityOrder order;
  order.cells = std::vector<CellId>{2, 0, 3, 1, 4};
  order.groups = std::vector<CellGroup>{{1, 2}};
  order.algorithm = "exact";
  const ExtraChunk chunk =
      encode_order({std::string(32, 'a'), std::string(32, 'b'), std::move(order)});
  return {chunk.payload.begin(), chunk.payload.end()};
}

const std::string kCamera =
    "[image]\nwidth = 8\nheight = 6\n[camera]\neye = [0.5, 0.5, -3.0]\n"
    "look_at = [0.5, 0.5, 0.0]\nup = [0.0, 1.0, 0.0]\nfov = 30.0\n";

std::vector<std::string> specification_seeds() {
  const std::string maps =
      "[volume.color]\nfield = \"f\"\npreset = \"map.json\"\nrange = [0.0, 1.0]\n"
      "[skin]\nopacity = 0.5\n[skin.color]\nfield = \"f\"\npreset = \"map.xml\"\nrange = "
      "\"auto\"\n";
  const std::string json =
      "[{\"Name\": \"a\", \"ColorSpace\": \"Lab\", \"RGBPoints\": [0.0, 0.0, 0.0, 1.0, 0.5, 1.0, "
      "1.0, 1.0, 1.0, 1.0, 0.0, 0.0]}]\n";
  const std::string xml =
      "<ColorMaps><ColorMap name=\"a\" space=\"Diverging\"><Point x=\"0\" o=\"1\" r=\"0\" g=\"0\" "
      "b=\"1\"/><Point x=\"1\" o=\"1\" r=\"1\" g=\"0\" b=\"0\"/></ColorMap></ColorMaps>\n";
  return {kCamera +
              "[volume.extinction]\nfield = \"f\"\npoints = [[0.0, 1.0], [1.0, 1.0]]\n"
              "[volume.color]\nfield = \"f\"\npoints = [[0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, "
              "0.0]]\n[[isosurface]]\nfield = \"f\"\nvalue = 0.5\ncolor = [1.0, 0.8, 0.2]\n"
              "opacity = 0.4\n[background]\ncolor = [0.25, 0.5, 0.75]\n[turntable]\nframes = 3\n",
          kCamera + maps + parcel("map.json", json) + parcel("map.xml", xml)};
}

std::string property(const char* name, std::initializer_list<const char*> values) {
  std::string text = fmt::format("<Property name=\"{}\">", name);
  for (const char* value : values) text += fmt::format("<Element value=\"{}\"/>", value);
  return text + "</Property>";
}

std::string reference(const char* name, int id) {
  return fmt::format("<Property name=\"{}\"><Proxy value=\"{}\"/></Property>", name, id);
}

std::string proxy(const char* group, const char* type, int id, const std::string& properties) {
  return fmt::format("<Proxy group=\"{}\" type=\"{}\" id=\"{}\">{}</Proxy>", group, type, id,
                     properties);
}

std::vector<std::string> state_seeds() {
  const std::string camera = property("CameraPosition", {"0.5", "0.5", "-3"}) +
                             property("CameraFocalPoint", {"0.5", "0.5", "0"}) +
                             property("CameraViewUp", {"0", "1", "0"});
  const std::string array = property("ColorArrayName", {"", "", "", "0", "f"});
  return {"<ServerManagerState version=\"5.11.0\">" +
          proxy("views", "RenderView", 1,
                camera + property("ViewSize", {"8", "6"}) +
                    property("Background", {"0.1", "0.2", "0.3"}) +
                    reference("Representations", 2)) +
          proxy("representations", "UnstructuredGridRepresentation", 2,
                reference("Input", 3) + property("Representation", {"Volume"}) + array +
                    property("SelectMapper", {"Bunyk ray cast"}) +
                    property("ScalarOpacityUnitDistance", {"0.3"}) + reference("LookupTable", 4) +
                    reference("ScalarOpacityFunction", 5)) +
          proxy("sources", "XMLUnstructuredGridReader", 3, property("FileName", {"m.vtu"})) +
          proxy("lookup_tables", "PVLookupTable", 4,
                property("ColorSpace", {"2"}) + property("UseLogScale", {"1"}) +
                    property("NumberOfTableValues", {"7"}) +
                    property("RGBPoints", {"0.1", "0", "0.2", "1", "1", "1", "0.5", "0"})) +
          proxy("piecewise_functions", "PiecewiseFunction", 5,
                property("Points", {"0", "0.1", "0.3", "0.5", "1", "0.9", "0.5", "0"})) +
          "</ServerManagerState>"};
}

}  // namespace

std::optional<Target> other_target(const std::string& name) {
  if (name == "order") return Target{name, ".order", read_order};
  if (name == "state") return Target{name, ".pvsm", read_state};
  if (name == "specification")
    return Target{name, ".toml", [](const std::string& path) { read_scene(path); }};
  if (std::ranges::find(kPictures, name) != kPictures.end())
    return Target{name, "." + name, [](const std::string& path) { read_image(path); }};
  return std::nullopt;
}

std::vector<std::string> other_seeds(const std::string& name) {
  if (name == "order") return {order_seed()};
  if (name == "state") return state_seeds();
  if (name == "specification") return specification_seeds();
  if (std::ranges::find(kPictures, name) == kPictures.end()) return {};
  std::vector<std::string> seeds{picture_seed(name, {"R", "G", "B"})};
  if (name != "hdr" && name != "pfm") seeds.push_back(picture_seed(name, {"R", "G", "B", "A"}));
  return seeds;
}

}  // namespace hiac::fuzz
