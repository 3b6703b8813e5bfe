#include "formats/med/med.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/common/io/isolated.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/hdf5/hdf5_file.hpp"
#include "formats/hdf5/hdf5_model.hpp"
#include "formats/med/element_types.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats {
namespace {

constexpr std::int64_t kNoTime = -1;
constexpr std::size_t kNameWidth = 16;
const std::string kMeshes = "/ENS_MAA";
const std::string kFields = "/CHA";
const std::string kWholeProfile = "MED_NO_PROFILE_INTERNAL";

/// The cells of one element type: where they begin in the mesh.
struct Cells {
  std::size_t first;
  std::size_t count;
  std::size_t nodes;
  std::size_t first_entry;
};
using CellsByType = std::map<std::string, Cells>;

/// A step by its number and its order within the number.
using StepKey = std::pair<std::int64_t, std::int64_t>;

/// The data needed to read the values of one field at one step.
struct FieldPart {
  std::shared_ptr<hdf5::File> file;
  std::string step;  ///< the group
  std::size_t components;
  std::size_t points;
  std::size_t cells;
  std::size_t entries;
  CellsByType by_type;

  /// Puts the values of one support ("NOE", "MAI.TE4", "NOE.TE4") into their places: tuple t of
  /// item i goes to `place(i) + t`.
  template <typename Place>
  void put(const std::string& support, std::size_t items, std::size_t tuples, const Place& place,
           std::vector<double>& values) const {
    for (const std::string& profile : file->children(step + "/" + support)) {
      const std::string group = step + "/" + support + "/" + profile;
      const std::vector<double> stored = file->reals(group + "/CO");
      const std::vector<std::size_t> chosen = items_of(profile, items);
      if (stored.size() != components * chosen.size() * tuples)
        file->fail(group + "/CO", fmt::format("holds {} values ({} expected)", stored.size(),
                                              components * chosen.size() * tuples));
      for (std::size_t c = 0; c < components; ++c)
        for (std::size_t i = 0; i < chosen.size(); ++i)
          for (std::size_t t = 0; t < tuples; ++t)
            values[(place(chosen[i]) + t) * components + c] =
                stored[(c * chosen.size() + i) * tuples + t];
    }
  }

  [[nodiscard]] std::vector<double> on_nodes() const {
    std::vector<double> values(points * components, kNaN);
    put(
        "NOE", points, 1, [](std::size_t i) { return i; }, values);
    return values;
  }

  [[nodiscard]] std::vector<double> on_cells() const {
    std::vector<double> values(cells * components, kNaN);
    for (const auto& entry : by_type) {
      const auto& group = entry.second;
      const std::string name = "MAI." + entry.first;
      if (file->has(step + "/" + name))
        put(
            name, group.count, 1, [&](std::size_t i) { return group.first + i; }, values);
    }
    return values;
  }

  [[nodiscard]] std::vector<double> on_corners() const {
    std::vector<double> values(entries * components, kNaN);
    for (const auto& entry : by_type) {
      const auto& group = entry.second;
      const std::string name = "NOE." + entry.first;
      if (file->has(step + "/" + name))
        put(
            name, group.count, group.nodes,
            [&](std::size_t i) { return group.first_entry + i * group.nodes; }, values);
    }
    return values;
  }

 private:
  /// The items in a profile: all of them, or those that it lists, counted from 1.
  [[nodiscard]] std::vector<std::size_t> items_of(const std::string& profile,
                                                  std::size_t items) const {
    std::vector<std::size_t> chosen;
    if (profile == kWholeProfile) {
      for (std::size_t i = 0; i < items; ++i) chosen.push_back(i);
      return chosen;
    }
    const std::string list = "/PROFILS/" + profile + "/PFL";
    for (const std::int64_t item : file->integers(list)) {
      if (item < 1 || static_cast<std::uint64_t>(item) > items)
        file->fail(list, fmt::format("names item {} (1 to {} expected)", item, items));
      chosen.push_back(static_cast<std::size_t>(item - 1));
    }
    return chosen;
  }
};

/// The part of MED's fixed-width lists that belongs to one component.
std::string name_at(const std::string& list, std::size_t component) {
  if (component * kNameWidth >= list.size()) return {};
  std::string name = list.substr(component * kNameWidth, kNameWidth);
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

/// The unit that all components have, or nothing.
std::string common_unit(const std::string& units, std::size_t components) {
  for (std::size_t c = 1; c < components; ++c)
    if (name_at(units, c) != name_at(units, 0)) return {};
  return name_at(units, 0);
}

class MedReader {
 public:
  explicit MedReader(const std::string& path) : file_(std::make_shared<hdf5::File>(path)) {}

  ForeignMesh read() {
    check_version();
    choose_mesh();
    read_points();
    read_cells();
    read_groups();
    read_fields();
    return std::move(mesh_);
  }

 private:
  void check_version() const {
    const auto major = file_->integer_attribute("/INFOS_GENERALES", "MAJ");
    if (!file_->is_group(kMeshes)) file_->fail(kMeshes, "is not there (a mesh expected)");
    if (major && *major < 3)
      file_->fail(
          "/INFOS_GENERALES",
          fmt::format("MED version {} (3 or later expected; medimport makes it so)", *major));
  }

  void choose_mesh() {
    const std::vector<std::string> meshes = file_->children(kMeshes);
    if (meshes.empty()) file_->fail(kMeshes, "holds no mesh");
    name_ = meshes.front();
    group_ = kMeshes + "/" + name_;
    if (meshes.size() > 1)
      mesh_.notes.push_back(fmt::format(
          "read the mesh '{}' alone; the file has {} more: {}", name_, meshes.size() - 1,
          fmt::join(std::vector(meshes.begin() + 1, meshes.end()), ", ")));
    if (file_->integer_attribute(group_, "TYP").value_or(0) != 0)
      file_->fail(group_, "is a structured mesh (an unstructured one expected)");
    if (file_->integer_attribute(group_, "REP").value_or(0) != 0)
      file_->fail(group_, "has cylindrical or spherical coordinates (Cartesian ones expected)");
    std::vector<std::pair<StepKey, std::string>> steps;
    for (const std::string& step : file_->children(group_)) {
      const std::string path = group_ + "/" + step;
      steps.emplace_back(key_of(path), path);
    }
    std::sort(steps.begin(), steps.end());
    // a later step of a moving mesh may contain only coordinates
    for (const auto& [key, step] : steps) {
      if (file_->has(step + "/NOE/COO")) points_step_ = step;
      if (file_->is_group(step + "/MAI")) cells_step_ = step;
    }
    if (points_step_.empty()) file_->fail(group_, "has no points");
    if (steps.size() > 1)
      mesh_.notes.push_back(
          fmt::format("the mesh has {} steps of its own: took the last", steps.size()));
  }

  [[nodiscard]] StepKey key_of(const std::string& group) const {
    return {file_->integer_attribute(group, "NDT").value_or(kNoTime),
            file_->integer_attribute(group, "NOR").value_or(kNoTime)};
  }

  void read_points() {
    const auto dimensions =
        static_cast<std::size_t>(file_->integer_attribute(group_, "ESP").value_or(3));
    const std::string dataset = points_step_ + "/NOE/COO";
    const std::vector<double> stored = file_->reals(dataset);
    if (dimensions < 1 || dimensions > 3 || stored.size() % dimensions != 0)
      file_->fail(dataset, fmt::format("{} coordinates do not fit {} dimensions", stored.size(),
                                       dimensions));
    const std::size_t count = stored.size() / dimensions;
    mesh_.xyz.assign(3 * count, 0);
    for (std::size_t d = 0; d < dimensions; ++d)
      for (std::size_t i = 0; i < count; ++i) mesh_.xyz[3 * i + d] = stored[d * count + i];
    mesh_.first_node = 1;
    const std::string units = file_->text_attribute(group_, "UNI").value_or("");
    if (const std::string unit = common_unit(units, dimensions); !unit.empty())
      mesh_.metadata.emplace_back("length unit", unit);
  }

  void read_cells() {
    const std::string group = cells_step_ + "/MAI";
    if (cells_step_.empty()) return;
    for (const std::string& name : file_->children(group)) {
      const auto element = med::element_named(name);
      const std::string dataset = group + "/" + name + "/NOD";
      if (!element) {
        add_unknown(name, group + "/" + name);
        continue;
      }
      const std::vector<std::int64_t> stored = file_->integers(dataset);
      if (stored.size() % element->nodes != 0)
        file_->fail(dataset, fmt::format("{} nodes make no whole number of cells of {}",
                                         stored.size(), element->nodes));
      const Cells cells{mesh_.cell_count(), stored.size() / element->nodes, element->nodes,
                        mesh_.cell_nodes.size()};
      for (std::size_t i = 0; i < cells.count; ++i)
        for (std::size_t n = 0; n < cells.nodes; ++n)
          mesh_.cell_nodes.push_back(stored[n * cells.count + i]);
      mesh_.cell_types.insert(mesh_.cell_types.end(), cells.count,
                              mesh_.type_place(name, cells.nodes, element->conversion));
      cells_.emplace(name, cells);
    }
  }

  /// Polygons have no volume; other unknown types are counted for the refusal.
  void add_unknown(const std::string& name, const std::string& group) {
    if (name.starts_with("POE")) return add_polyhedra(name, group);
    const std::string index = group + "/IND";
    const std::uint64_t count =
        file_->has(index) ? file_->integers(index).size() : std::uint64_t{1};
    const bool polygons = name.starts_with("POG");
    mesh_.cell_types.insert(mesh_.cell_types.end(), count > 1 ? count - 1 : 1,
                            mesh_.type_place(name, 0, polygons ? kNoVolume : kUnsupported));
  }

  /// IFN gives the start of every polyhedron's faces in INN, which gives the start of every face's
  /// nodes in NOD; all count from 1.
  void add_polyhedra(const std::string& name, const std::string& group) {
    const std::vector<std::int64_t> faces_at = file_->integers(group + "/IFN");
    const std::vector<std::int64_t> nodes_at = file_->integers(group + "/INN");
    const std::vector<std::int64_t> nodes = file_->integers(group + "/NOD");
    const Cells cells{mesh_.cell_count(), faces_at.size() - (faces_at.empty() ? 0 : 1), 0,
                      mesh_.cell_nodes.size()};
    const auto check = [&](std::int64_t begin, std::int64_t end, std::size_t limit) {
      if (begin < 1 || end < begin || static_cast<std::uint64_t>(end) > limit)
        file_->fail(group,
                    fmt::format("does not fit itself (entries {} to {} of {})", begin, end, limit));
    };
    for (std::size_t cell = 0; cell < cells.count; ++cell) {
      check(faces_at[cell], faces_at[cell + 1], nodes_at.size());
      std::vector<std::vector<std::int64_t>> faces;
      for (auto face = static_cast<std::size_t>(faces_at[cell]);
           face < static_cast<std::size_t>(faces_at[cell + 1]); ++face) {
        check(nodes_at[face - 1], nodes_at[face], nodes.size() + 1);
        faces.emplace_back(nodes.begin() + static_cast<std::ptrdiff_t>(nodes_at[face - 1] - 1),
                           nodes.begin() + static_cast<std::ptrdiff_t>(nodes_at[face] - 1));
      }
      mesh_.add_polyhedron(name, faces);
    }
    cells_.emplace(name, cells);
  }

  /// The groups of cells; a group is a union of families.
  void read_groups() {
    std::map<std::int64_t, std::vector<std::string>> groups_of;
    const std::string families = "/FAS/" + name_ + "/ELEME";
    if (!file_->is_group(families)) return;
    for (const std::string& family : file_->children(families)) {
      const std::string group = families + "/" + family;
      const auto number = file_->integer_attribute(group, "NUM");
      if (number && file_->has(group + "/GRO/NOM"))
        groups_of[*number] = file_->texts(group + "/GRO/NOM");
    }
    std::map<std::string, std::vector<IndexRange>> blocks;
    for (const auto& [name, cells] : cells_) {
      const std::string dataset = cells_step_ + "/MAI/" + name + "/FAM";
      if (!file_->has(dataset)) continue;
      const std::vector<std::int64_t> numbers = file_->integers(dataset);
      if (numbers.size() != cells.count)
        file_->fail(dataset,
                    fmt::format("holds {} numbers ({} expected)", numbers.size(), cells.count));
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto found = groups_of.find(numbers[i]);
        if (found == groups_of.end()) continue;
        for (const std::string& block : found->second) {
          auto& ranges = blocks[block];
          if (!ranges.empty() && ranges.back().end == cells.first + i)
            ++ranges.back().end;
          else
            ranges.push_back({cells.first + i, cells.first + i + 1});
        }
      }
    }
    for (auto& [name, ranges] : blocks) mesh_.blocks.push_back({name, std::move(ranges)});
  }

  void read_fields() {
    if (!file_->is_group(kFields)) return;
    std::vector<std::string> fields;
    for (const std::string& field : file_->children(kFields)) {
      const std::string group = kFields + "/" + field;
      if (file_->text_attribute(group, "MAI").value_or(name_) == name_) fields.push_back(field);
    }
    read_times(fields);
    for (const std::string& field : fields) read_field(field);
  }

  void read_times(const std::vector<std::string>& fields) {
    std::map<StepKey, double> times;
    for (const std::string& field : fields)
      for (const std::string& step : file_->children(kFields + "/" + field)) {
        const std::string group = kFields + "/" + field + "/" + step;
        const StepKey key = key_of(group);
        if (key == StepKey{kNoTime, kNoTime}) continue;
        const std::vector<double> time = file_->real_attribute(group, "PDT");
        times.emplace(key, time.empty() ? 0 : time.front());
      }
    for (const auto& [key, time] : times) {
      step_of_.emplace(key, mesh_.times.size());
      mesh_.times.push_back(time);
    }
  }

  void read_field(const std::string& name) {
    const std::string group = kFields + "/" + name;
    const std::int64_t components = file_->integer_attribute(group, "NCO").value_or(0);
    if (components < 1 || components > 1000)
      file_->fail(group, fmt::format("has {} components (1 to 1000 expected)", components));
    std::set<std::string> left_out;
    for (const std::string& step : file_->children(group)) {
      const std::string path = group + "/" + step;
      const FieldPart part{file_,
                           path,
                           static_cast<std::size_t>(components),
                           mesh_.point_count(),
                           mesh_.cell_count(),
                           mesh_.cell_nodes.size(),
                           cells_};
      bool nodes = false;
      bool cells = false;
      bool corners = false;
      for (const std::string& support : file_->children(path)) {
        nodes |= support == "NOE";
        if (support.starts_with("MAI.") || support.starts_with("NOE.")) {
          const bool whole = is_one_a_cell(path + "/" + support);
          cells |= support.starts_with("MAI.") && whole;
          corners |= support.starts_with("NOE.");
          if (support.starts_with("MAI.") && !whole) left_out.insert("integration points");
        } else if (support != "NOE") {
          left_out.insert(support);
        }
      }
      const bool at_points = left_out.contains("integration points");
      if (nodes) add_field(name, path, FieldLocation::node, [part] { return part.on_nodes(); });
      if (cells && !at_points)
        add_field(name, path, FieldLocation::cell, [part] { return part.on_cells(); });
      if (corners)
        add_field(name, path, FieldLocation::corner, [part] { return part.on_corners(); });
    }
    if (!left_out.empty())
      mesh_.notes.push_back(
          fmt::format("left out field '{}' at {}", name, fmt::join(left_out, ", ")));
  }

  /// Whether a field on cells has one value per cell rather than several at integration points.
  [[nodiscard]] bool is_one_a_cell(const std::string& support) const {
    for (const std::string& profile : file_->children(support))
      if (file_->integer_attribute(support + "/" + profile, "NGA").value_or(1) > 1) return false;
    return true;
  }

  void add_field(const std::string& name, const std::string& step, FieldLocation location,
                 std::function<std::vector<double>()> values) {
    const std::string group = kFields + "/" + name;
    ForeignField field;
    field.name = name;
    field.location = location;
    field.components =
        static_cast<std::uint32_t>(file_->integer_attribute(group, "NCO").value_or(1));
    field.unit = common_unit(file_->text_attribute(group, "UNI").value_or(""), field.components);
    if (const auto found = step_of_.find(key_of(step)); found != step_of_.end())
      field.step = found->second;
    field.values = std::move(values);
    mesh_.fields.push_back(std::move(field));
  }

  std::shared_ptr<hdf5::File> file_;
  ForeignMesh mesh_;
  std::string name_;
  std::string group_;
  std::string points_step_;
  std::string cells_step_;
  CellsByType cells_;
  std::map<StepKey, std::size_t> step_of_;
};

ForeignMesh med_mesh(const std::string& path) {
  return read_isolated(path, "the HDF5 library",
                       [](const std::string& file) { return MedReader(file).read(); });
}

}  // namespace

Format med_format() {
  Format format;
  format.name = "med";
  format.extensions = {".med", ".rmed", ".mmed"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 brick8,20";
  format.fields = "node, cell, corner";
  format.time_steps = "several";
  format.recognizes = [](std::string_view) { return false; };
  format.contains = [](const std::string& path) { return hdf5::model_of(path) == "med"; };
  read_through(format, [](const std::string& path, const ReadOptions&) { return med_mesh(path); });
  return format;
}

}  // namespace hiac::formats
