#include "formats/openfoam/openfoam.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "formats/common/cells/face_cells.hpp"
#include "formats/common/io/printable.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/pieces/piece_field.hpp"
#include "formats/openfoam/case_part.hpp"
#include "formats/openfoam/foam_file.hpp"
#include "formats/openfoam/joined_parts.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats {
namespace {

using openfoam::CasePart;
using openfoam::FoamFile;
using openfoam::time_folders;
using openfoam::TimeFolder;
namespace fs = std::filesystem;

/// Files of a case may lie this many folders below its root.
constexpr int kDeepestFile = 4;

bool is_folder(const fs::path& path) {
  std::error_code failed;
  return fs::is_directory(path, failed);
}

/// A mesh folder may hold only the input of a mesh generator and no mesh.
bool has_mesh(const fs::path& root) {
  const fs::path folder = root / "constant" / "polyMesh";
  return FoamFile::exists((folder / "owner").string()) ||
         FoamFile::exists((folder / "points").string());
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

class OpenFoamReader {
 public:
  OpenFoamReader(const std::string& path, const ReadOptions& options)
      : subject_(path), options_(options), root_(fs::path(path).parent_path()) {
    if (root_.empty()) root_ = ".";
    // the given file may be in a subfolder of the case
    std::error_code failed;
    fs::path above = fs::absolute(root_, failed);
    for (int i = 0; i < kDeepestFile; ++i, above = above.parent_path())
      if (has_mesh(above) || has_mesh(above / "processor0")) {
        if (i > 0) root_ = above;
        return;
      }
  }

  ForeignMesh read() {
    find_parts();
    choose_step();
    for (CasePart& part : parts_) {
      part.read_mesh();
      mesh_.notes.insert(mesh_.notes.end(), part.notes.begin(), part.notes.end());
    }
    if (parts_.size() > 1) join();
    if (parts_.size() == 1) mesh_.xyz = std::move(parts_.front().xyz);
    add_cells();
    read_fields();
    if (PieceMarking::is_on() && parts_.size() > 1) mark_parts();
    return std::move(mesh_);
  }

 private:
  /// The case itself, or its parts if it has no mesh or if they have later results.
  void find_parts() {
    std::vector<CasePart> parts;
    for (fs::path root = part_folder(0); has_mesh(root); root = part_folder(parts.size())) {
      CasePart part;
      part.root = root;
      part.folders = time_folders(root);
      parts.push_back(std::move(part));
    }
    const std::vector<TimeFolder> folders = time_folders(root_);
    const bool whole = has_mesh(root_);
    const bool later = !parts.empty() && !parts.front().folders.empty() &&
                       (folders.empty() || parts.front().folders.back().time > folders.back().time);
    if (whole && !later) {
      parts_.emplace_back();
      parts_.front().root = root_;
      parts_.front().folders = folders;
      return;
    }
    if (parts.empty()) refuse_missing_mesh();
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(root_, failed)) {
      const std::string name = entry.path().filename().string();
      std::size_t number = 0;
      const auto [end, error] = std::from_chars(name.data() + std::min(name.size(), kPart.size()),
                                                name.data() + name.size(), number);
      if (name.starts_with(kPart) && error == std::errc() && end == name.data() + name.size() &&
          number >= parts.size() && has_mesh(entry.path()))
        throw InputError(subject_, fmt::format("of its case's parts, {} has no mesh (that of {} "
                                               "found)",
                                               part_folder(parts.size()).string(), name));
    }
    parts_ = std::move(parts);
    mesh_.notes.push_back(
        fmt::format("joined the {} parts of a decomposed case{}", parts_.size(),
                    whole ? ", which have later times than the case itself" : ""));
  }

  [[nodiscard]] fs::path part_folder(std::size_t number) const {
    return root_ / fmt::format("{}{}", kPart, number);
  }

  [[noreturn]] void refuse_missing_mesh() const {
    std::string found;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(root_, failed)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("processors"))
        found = fmt::format(", found collated parts, which are not read: {}", printable(name));
    }
    throw InputError(subject_, fmt::format("its case has no mesh ({} expected{})",
                                           (root_ / "constant" / "polyMesh").string(), found));
  }

  /// The steps are the times that all parts have.
  void choose_step() {
    const auto in_all = [this](const TimeFolder& folder) {
      return std::all_of(parts_.begin(), parts_.end(), [&](const CasePart& part) {
        return is_folder(part.root / folder.path.filename());
      });
    };
    const std::vector<TimeFolder> first = parts_.front().folders;
    std::vector<TimeFolder> common;
    std::copy_if(first.begin(), first.end(), std::back_inserter(common), in_all);
    if (common.size() < first.size())
      mesh_.notes.push_back(
          fmt::format("left out {} times that not all parts have", first.size() - common.size()));
    for (const TimeFolder& folder : common) {
      mesh_.times.push_back(folder.time);
      step_names_.push_back(folder.path.filename());
    }
    if (common.empty()) {
      for (CasePart& part : parts_) part.folders.clear();
      return;
    }
    step_ = requested_step(options_, mesh_.times, subject_).value_or(common.size() - 1);
    for (CasePart& part : parts_) {
      // a part may have time folders that other parts do not have
      const auto same = [&](const TimeFolder& folder) {
        return folder.path.filename() == common[step_].path.filename();
      };
      part.step = static_cast<std::size_t>(
          std::find_if(part.folders.begin(), part.folders.end(), same) - part.folders.begin());
    }
  }

  void join() {
    joined_ = openfoam::join_parts(parts_);
    mesh_.notes.insert(mesh_.notes.end(), joined_.notes.begin(), joined_.notes.end());
    mesh_.xyz.resize(3 * joined_.points);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t i = 0; i < parts_[p].point_count(); ++i)
        std::copy_n(&parts_[p].xyz[3 * i], 3, &mesh_.xyz[3 * joined_.point_places[p][i]]);
  }

  void add_cells() {
    if (parts_.size() == 1) {
      for (std::size_t cell = 0; cell < parts_.front().faces_of.size(); ++cell)
        add_cell(parts_.front().outward_faces(cell));
      return;
    }
    for (const auto& [p, cell] : joined_.cells) {
      auto faces = parts_[p].outward_faces(cell);
      const std::vector<std::size_t>& places = joined_.point_places[p];
      for (auto& face : faces)
        for (std::int64_t& node : face) {
          if (node < 0 || static_cast<std::uint64_t>(node) >= places.size())
            throw InputError(
                parts_[p].mesh_file("faces"),
                fmt::format("there is no point {} ({} points found)", node, places.size()));
          node = static_cast<std::int64_t>(places[static_cast<std::size_t>(node)]);
        }
      add_cell(faces);
    }
  }

  void mark_parts() {
    std::vector<double> marks;
    for (const auto& [p, cell] : joined_.cells) marks.push_back(static_cast<double>(p));
    mesh_.fields.push_back(
        field_of(std::string(kPieceField), FieldLocation::cell, 1, std::move(marks)));
  }

  void add_cell(const std::vector<std::vector<std::int64_t>>& outward) {
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
    if (parts_.front().folders.empty()) return;
    for (const std::string& name : files_in(folder_of(parts_.front()))) read_field(name);
    find_field_steps();
  }

  /// The steps of the fields that the case has, those that the chosen step lacks included.
  void find_field_steps() {
    const CasePart& part = parts_.front();
    for (std::size_t step = 0; step < mesh_.times.size(); ++step)
      for (const std::string& name : files_in(part.root / step_names_[step])) {
        const auto [known, is_new] = mesh_.field_steps.try_emplace(name);
        if (is_new && !is_field((part.root / step_names_[step] / name).string()))
          no_fields_.insert(name);
        known->second.insert(step);
      }
    for (const std::string& name : no_fields_) mesh_.field_steps.erase(name);
  }

  static bool is_field(const std::string& path) try {
    if (!FoamFile::exists(path) || !FoamFile::is_one(path)) return false;
    const std::string type = FoamFile(path).class_name();
    return type.ends_with("Field") && (type.starts_with("vol") || type.starts_with("point"));
  } catch (const InputError&) {
    return false;  // a damaged file of another step is no concern of this one
  }

  static const fs::path& folder_of(const CasePart& part) { return part.folders[part.step].path; }

  void leave_out(const std::string& name, std::string_view why) {
    mesh_.notes.push_back(fmt::format("left out '{}', {}", name, why));
  }

  void read_field(const std::string& name) {
    std::vector<openfoam::FieldValues> values;
    ForeignField field;
    field.name = name;
    for (const CasePart& part : parts_) {
      const std::string path = (folder_of(part) / name).string();
      if (!FoamFile::exists(path)) return leave_out(name, "which not all parts have");
      if (!FoamFile::is_one(path)) return leave_out(name, "which is no file of OpenFOAM's");
      FoamFile file(path);
      const bool on_cells = file.class_name().starts_with("vol");
      if (!file.class_name().ends_with("Field")) return;
      if (!on_cells && !file.class_name().starts_with("point"))
        return leave_out(name, fmt::format("a {}", file.class_name()));
      auto found = file.internal_field(on_cells ? part.faces_of.size() : points_of(part));
      if (!found) return leave_out(name, "whose internalField its file does not tell");
      const FieldLocation location = on_cells ? FieldLocation::cell : FieldLocation::node;
      if (!values.empty() &&
          (field.location != location || values.front().components != found->components))
        throw InputError(path, "is of another kind than in the part before it");
      if (values.empty()) field.unit = file.unit();
      field.location = location;
      values.push_back(std::move(*found));
    }
    field.components = static_cast<std::uint32_t>(values.front().components);
    field.step = step_;
    const auto whole = std::make_shared<std::vector<double>>(
        parts_.size() == 1 ? std::move(values.front().values) : of_whole(field, values));
    field.values = [whole] { return *whole; };
    mesh_.fields.push_back(std::move(field));
  }

  [[nodiscard]] std::size_t points_of(const CasePart& part) const {
    return parts_.size() == 1 ? mesh_.point_count() : part.point_count();
  }

  /// Assembles the values of the whole mesh from those of the parts; a point that parts share gets
  /// one value.
  [[nodiscard]] std::vector<double> of_whole(
      const ForeignField& field, const std::vector<openfoam::FieldValues>& values) const {
    const std::size_t width = field.components;
    std::vector<double> whole;
    if (field.location == FieldLocation::cell) {
      whole.reserve(width * joined_.cells.size());
      for (const auto& [p, cell] : joined_.cells) {
        const auto first = values[p].values.begin() + static_cast<long>(width * cell);
        whole.insert(whole.end(), first, first + static_cast<long>(width));
      }
      return whole;
    }
    whole.resize(width * joined_.points);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t i = 0; i < parts_[p].point_count(); ++i)
        std::copy_n(values[p].values.begin() + static_cast<long>(width * i), width,
                    whole.begin() + static_cast<long>(width * joined_.point_places[p][i]));
    return whole;
  }

  static constexpr std::string_view kPart = "processor";
  std::string subject_;
  ReadOptions options_;
  fs::path root_;
  std::size_t step_ = 0;
  std::vector<fs::path> step_names_;  ///< the folders' names
  std::set<std::string> no_fields_;   ///< files that hold something else
  ForeignMesh mesh_;
  std::vector<CasePart> parts_;  ///< one: the case itself
  openfoam::JoinedParts joined_;
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
    if (header == std::string_view::npos) return false;
    const std::size_t next = head.find_first_not_of(" \t\r\n", header + 8);
    return next != std::string_view::npos && head[next] == '{';
  };
  // a .foam file only marks the folder of the case
  format.contains = [](const std::string& path) {
    const std::string extension = fs::path(path).extension().string();
    return extension == ".foam" || extension == ".OpenFOAM";
  };
  read_through(format, [](const std::string& path, const ReadOptions& options) {
    return OpenFoamReader(path, options).read();
  });
  return format;
}

}  // namespace hiac::formats
