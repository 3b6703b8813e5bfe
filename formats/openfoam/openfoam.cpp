#include "formats/openfoam/openfoam.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "formats/assemble.hpp"
#include "formats/face_cells.hpp"
#include "formats/foreign_mesh.hpp"
#include "formats/openfoam/foam_file.hpp"
#include "formats/steps.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using openfoam::FoamFile;
namespace fs = std::filesystem;

/// A folder of results and its time.
struct TimeFolder {
  double time;
  fs::path path;
};

std::vector<TimeFolder> time_folders(const fs::path& root) {
  std::vector<TimeFolder> folders;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(root, failed)) {
    const std::string name = entry.path().filename().string();
    double time = 0;
    const char* end = name.data() + name.size();
    const auto [next, error] = std::from_chars(name.data(), end, time);
    if (error == std::errc() && next == end && entry.is_directory())
      folders.push_back({time, entry.path()});
  }
  std::sort(folders.begin(), folders.end(),
            [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
  return folders;
}

/// The names of the files in a folder, without .gz, in alphabetical order.
std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
    if (!entry.is_regular_file()) continue;
    const fs::path name = entry.path().filename();
    names.push_back(name.extension() == ".gz" ? name.stem().string() : name.string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Reader {
 public:
  Reader(const std::string& path, const ReadOptions& options)
      : subject_(path), options_(options), root_(fs::path(path).parent_path()) {
    if (root_.empty()) root_ = ".";
    // a file of the case may be in one of its folders
    std::error_code failed;
    fs::path above = fs::absolute(root_, failed);
    for (int i = 0; i < kDeepestFile; ++i, above = above.parent_path())
      if (fs::is_directory(above / "constant" / "polyMesh", failed)) {
        if (i > 0) root_ = above;
        return;
      }
  }

  ForeignMesh read() {
    const fs::path folder = root_ / "constant" / "polyMesh";
    std::error_code failed;
    if (!fs::is_directory(folder, failed)) {
      const bool parts = fs::is_directory(root_ / "processor0", failed);
      throw InputError(subject_,
                       fmt::format("its case has no mesh ({} expected{})", folder.string(),
                                   parts ? ", found parts of one: reconstructPar" : ""));
    }
    folders_ = time_folders(root_);
    for (const TimeFolder& time : folders_) mesh_.times.push_back(time.time);
    if (!folders_.empty())
      step_ = requested_step(options_, mesh_.times, subject_).value_or(folders_.size() - 1);
    mesh_.xyz = FoamFile(mesh_file("points")).points();
    read_cells();
    read_fields();
    return std::move(mesh_);
  }

 private:
  static constexpr int kDeepestFile = 4;

  /// A file of the mesh: the last one up to the step's time where the mesh moves or changes.
  [[nodiscard]] std::string mesh_file(const std::string& name) const {
    for (std::size_t i = folders_.empty() ? 0 : step_ + 1; i-- > 0;) {
      const fs::path moved = folders_[i].path / "polyMesh" / name;
      if (FoamFile::exists(moved.string())) return moved.string();
    }
    return (root_ / "constant" / "polyMesh" / name).string();
  }

  void read_cells() {
    FoamFile(mesh_file("faces")).faces(starts_, nodes_);
    const std::string owner_file = mesh_file("owner");
    const std::size_t faces = starts_.size() - 1;
    const std::vector<std::int64_t> owner = FoamFile(owner_file).labels(faces);
    const std::vector<std::int64_t> neighbour = FoamFile(mesh_file("neighbour")).labels(faces);
    if (owner.size() != faces || neighbour.size() > faces)
      throw InputError(owner_file,
                       fmt::format("does not fit the faces ({} entries expected, {} found)", faces,
                                   owner.size()));
    std::int64_t last = -1;
    for (const std::int64_t cell : owner) last = std::max(last, cell);
    for (const std::int64_t cell : neighbour) last = std::max(last, cell);
    // a cell has faces, and so there are fewer cells than faces
    if (last >= static_cast<std::int64_t>(faces))
      throw InputError(owner_file,
                       fmt::format("names cell {} (fewer than {} expected)", last, faces));
    std::vector<std::vector<std::size_t>> faces_of(static_cast<std::size_t>(last + 1));
    const auto note = [&](std::int64_t cell, std::size_t face) {
      if (cell >= 0) faces_of[static_cast<std::size_t>(cell)].push_back(face);
    };
    for (std::size_t f = 0; f < faces; ++f) note(owner[f], f);
    for (std::size_t f = 0; f < neighbour.size(); ++f) note(neighbour[f], f);
    for (std::size_t cell = 0; cell < faces_of.size(); ++cell)
      add_cell(faces_of[cell], owner, static_cast<std::int64_t>(cell));
  }

  void add_cell(const std::vector<std::size_t>& faces, const std::vector<std::int64_t>& owner,
                std::int64_t cell) {
    std::vector<std::vector<std::int64_t>> outward;
    for (const std::size_t face : faces) {
      std::vector<std::int64_t> nodes(nodes_.begin() + static_cast<long>(starts_[face]),
                                      nodes_.begin() + static_cast<long>(starts_[face + 1]));
      // a face turns counter-clockwise seen from outside of its owner
      if (owner[face] != cell) std::reverse(nodes.begin(), nodes.end());
      outward.push_back(std::move(nodes));
    }
    const auto found = cell_of_faces(outward);
    if (!found) {
      mesh_.add_polyhedron("polyhedron", outward);
      return;
    }
    mesh_.cell_types.push_back(mesh_.type_place(std::string(topology_of(found->kind).name),
                                                found->nodes.size(), converted_to(found->kind)));
    mesh_.cell_nodes.insert(mesh_.cell_nodes.end(), found->nodes.begin(), found->nodes.end());
  }

  void read_fields() {
    if (folders_.empty()) return;
    for (const std::string& name : files_in(folders_[step_].path))
      read_field((folders_[step_].path / name).string(), name);
  }

  void read_field(const std::string& path, const std::string& name) {
    if (!FoamFile::is_one(path)) {
      mesh_.notes.push_back(fmt::format("left out '{}', which is no file of OpenFOAM's", name));
      return;
    }
    const auto file = std::make_shared<FoamFile>(path);
    const bool on_cells =
        file->class_name().starts_with("vol") && file->class_name().ends_with("Field");
    const bool on_points =
        file->class_name().starts_with("point") && file->class_name().ends_with("Field");
    if (!on_cells && !on_points) {
      if (file->class_name().ends_with("Field"))
        mesh_.notes.push_back(fmt::format("left out '{}', a {}", name, file->class_name()));
      return;
    }
    const std::size_t count = on_cells ? mesh_.cell_count() : mesh_.point_count();
    auto found = file->internal_field(count);
    if (!found) {
      mesh_.notes.push_back(
          fmt::format("left out '{}', whose internalField its file does not tell", name));
      return;
    }
    const auto values = std::make_shared<openfoam::FieldValues>(std::move(*found));
    ForeignField field;
    field.name = name;
    field.unit = file->unit();
    field.location = on_cells ? FieldLocation::cell : FieldLocation::node;
    field.components = static_cast<std::uint32_t>(values->components);
    field.step = step_;
    field.values = [values] { return values->values; };
    mesh_.fields.push_back(std::move(field));
  }

  std::string subject_;
  ReadOptions options_;
  fs::path root_;
  std::vector<TimeFolder> folders_;
  std::size_t step_ = 0;
  ForeignMesh mesh_;
  std::vector<std::size_t> starts_;
  std::vector<std::int64_t> nodes_;
};

}  // namespace

Format openfoam_format() {
  Format format;
  format.name = "openfoam";
  format.extensions = {".foam", ".openfoam"};
  format.kinds = "tet4 pyr5 prism6 wedge7 brick8";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) {
    const std::size_t header = head.find("FoamFile");
    return header != std::string_view::npos &&
           head.find('{', header) == head.find_first_not_of(" \t\r\n", header + 8);
  };
  // a .foam file is there for its name alone
  format.contains = [](const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    return extension == ".foam" || extension == ".OpenFOAM";
  };
  read_through(format, [](const std::string& path, const ReadOptions& options) {
    return Reader(path, options).read();
  });
  return format;
}

}  // namespace hiac::formats
