#include "tests/fuzz/format_target.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "formats/registry.hpp"
#include "hiac/base/error.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "tests/formats/one_cell_files.hpp"
#include "tests/formats/solver_files.hpp"

namespace {

const hiac::formats::Format& format() {
  const char* name = std::getenv("HIAC_FUZZ_FORMAT");
  static const hiac::formats::Format& found =
      hiac::formats::format_named(name == nullptr ? "" : name);
  return found;
}

/// A folder in memory, gone at the end.
class Folder {
 public:
  Folder() {
    const bool memory = std::filesystem::exists("/dev/shm");
    std::string name = (memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) +
                       std::string("/hiac-fuzz-XXXXXX");
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// The two files of TetGen are one input, parted by a line of equals signs.
constexpr const char* kParting = "====\n";

std::string write_input(const Folder& folder, const std::string& input) {
  const bool two_files = format().name == "tetgen";
  const std::size_t parting = two_files ? input.find(kParting) : std::string::npos;
  const std::string name = "input" + std::string(format().extensions.front());
  folder.write(name, input.substr(0, parting));
  if (two_files && parting != std::string::npos)
    folder.write("input.ele", input.substr(parting + std::string(kParting).size()));
  else if (two_files)
    folder.write("input.ele", "");
  return folder.file(name);
}

[[noreturn]] void report(const char* what) {
  std::fprintf(stderr, "%s: %s\n", std::string(format().name).c_str(), what);
  std::abort();
}

/// A mesh written by the format, where it can be.
std::string written_seed() {
  hiac::ZooMesh mesh;
  const auto places = hiac::reference_nodes(hiac::CellKind::brick20);
  std::vector<double> xyz;
  std::vector<hiac::NodeId> nodes;
  for (const auto& place : places) {
    nodes.push_back(static_cast<hiac::NodeId>(nodes.size()));
    xyz.insert(xyz.end(), place.begin(), place.end());
  }
  const std::size_t count = nodes.size();
  mesh.kinds = std::vector<hiac::CellKind>{hiac::CellKind::brick20};
  mesh.elems = std::vector<std::uint64_t>{0, count};
  mesh.nodes = std::move(nodes);
  mesh.xyz = std::move(xyz);
  mesh.fields.push_back({"a", "", hiac::FieldLocation::corner, 1, std::vector<double>(count, 0.5)});
  mesh.fields.push_back({"b", "", hiac::FieldLocation::node, 3, std::vector<double>(3 * count, 2)});
  const Folder folder;
  const std::string path = folder.file("seed" + std::string(format().extensions.front()));
  format().write(path, mesh);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string path =
      write_input(folder, std::string(reinterpret_cast<const char*>(data), size));
  try {
    const hiac::formats::Reading reading = format().read(path, {});
    hiac::validate(reading.mesh, path);
    format().inspect(path);
  } catch (const hiac::InputError& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) report("error of two lines");
  } catch (const std::exception& error) {
    report(error.what());
  }
  return 0;
}

namespace hiac::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const formats::OneCellFile& file : formats::one_cell_files())
    if (file.format == format().name) texts.push_back(file.text);
  if (format().write) texts.push_back(written_seed());
  if (format().name == "tecplot") texts.push_back(formats::tecplot_bricks({}));
  if (format().name == "d3plot") {
    const formats::Model model = formats::linear_model();
    texts.push_back(formats::d3plot_geometry(model, false, false) +
                    formats::d3plot_state(model, 1, false, false));
  }
  if (format().name == "tetgen")
    texts.push_back(std::string("4 3 1 1\n1 0 0 0 5 1\n2 1 0 0 6 1\n3 0 1 0 7 1\n4 0 0 1 8 0\n") +
                    kParting + "1 4 1\n1 1 2 3 4 9\n");
  return texts;
}

}  // namespace hiac::fuzz
