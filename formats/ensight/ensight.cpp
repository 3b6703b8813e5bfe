#include "formats/ensight/ensight.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "formats/common/io/text_cursor.hpp"
#include "formats/common/mesh/assemble.hpp"
#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"
#include "formats/common/mesh/steps.hpp"
#include "formats/common/mesh/structured.hpp"
#include "formats/ensight/case_file.hpp"
#include "formats/ensight/element_types.hpp"
#include "formats/ensight/gold_file.hpp"
#include "formats/ensight/six_file.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/special_values.hpp"

namespace hiac::formats {
namespace {

using ensight::Element;
using ensight::elements;
using ensight::GoldFile;

/// The cells of one part that are listed under one element name.
struct Section {
  std::string name;
  std::size_t first;
  std::size_t count;              ///< in the file
  std::vector<std::size_t> kept;  ///< of a block with hidden cells; empty: all
  [[nodiscard]] std::size_t cells() const { return kept.empty() ? count : kept.size(); }
};

struct Part {
  std::size_t first_point = 0;
  std::size_t points = 0;
  std::vector<Section> sections;
};
using Parts = std::map<std::int64_t, Part>;

class Geometry {
 public:
  /// If the file holds several steps, the given one is read.
  Geometry(const std::string& path, std::size_t step, ForeignMesh& mesh)
      : file_(GoldFile::open_geometry(path)), mesh_(mesh) {
    file_.select_step(step);
  }

  Parts read() {
    file_.text();
    file_.text();
    node_ids_ = has_ids(file_.text());
    element_ids_ = has_ids(file_.text());
    while (!file_.at_end()) {
      const std::string line = file_.text();
      if (line == "extents")
        file_.reals(6);
      else if (line == "part")
        read_part();
      else if (!line.empty())
        file_.fail(fmt::format("'part' expected ({} found)", shown(line)));
    }
    return std::move(parts_);
  }
  [[nodiscard]] const ensight::Encoding& encoding() const { return file_.encoding(); }

 private:
  static bool has_ids(const std::string& line) {
    return line.ends_with("given") || line.ends_with("ignore");
  }

  void read_part() {
    Part& part = parts_[file_.part_number()];
    part.first_point = mesh_.point_count();
    const std::string name = file_.text();
    const std::size_t first_cell = mesh_.cell_count();
    while (!file_.at_end()) {
      const std::string line = file_.text(true);
      if (line == "part") break;
      file_.text();
      if (line == "coordinates")
        read_coordinates(part);
      else if (line.starts_with("block"))
        read_block(line, part);
      else if (!line.empty())
        read_section(line, part);
    }
    mesh_.blocks.push_back({name, {{first_cell, mesh_.cell_count()}}});
  }

  void add_points(const std::array<std::vector<double>, 3>& axes, Part& part) {
    part.points = axes[0].size();
    for (std::size_t i = 0; i < part.points; ++i)
      mesh_.xyz.insert(mesh_.xyz.end(), {axes[0][i], axes[1][i], axes[2][i]});
  }

  void read_coordinates(Part& part) {
    const std::size_t count = file_.count();
    if (node_ids_) file_.wholes(count);
    std::array<std::vector<double>, 3> axes;
    for (auto& axis : axes) axis = file_.reals(count);
    add_points(axes, part);
  }

  void read_block(const std::string& line, Part& part) {
    const auto says = [&](const char* word) { return line.find(word) != std::string::npos; };
    if (says("range") || says("with_ghost"))
      file_.fail(
          fmt::format("'{}' is not read (a block without ranges and ghosts expected)", line));
    const std::vector<std::int64_t> extents = file_.wholes(3);
    const bool listed = !says("uniform") && !says("rectilinear");
    // a block given by its axes takes few bytes: accept no more points than this
    constexpr std::size_t kMostUnlisted = std::size_t{1} << 24;
    const StructuredBlock block = structured_block(
        extents, listed ? std::size_t{1} << 31 : kMostUnlisted, "a block of a part");
    const std::size_t count = block.point_count();
    std::array<std::vector<double>, 3> axes;
    if (listed)
      for (auto& axis : axes) axis = file_.reals(count);
    else
      axes = axes_of(block, says("uniform"));
    std::vector<bool> hidden;
    if (says("iblanked"))
      for (const std::int64_t blank : file_.wholes(count)) hidden.push_back(blank == 0);
    add_points(axes, part);
    const std::size_t first = mesh_.cell_count();
    std::vector<std::size_t> kept = add_bricks(mesh_, block, part.first_point, hidden, "");
    part.sections.push_back({"block", first, block.cell_count(), std::move(kept)});
  }

  /// The points of a block that is given by its coordinates along three axes, or by an origin and a
  /// spacing.
  std::array<std::vector<double>, 3> axes_of(const StructuredBlock& block, bool uniform) {
    std::array<std::vector<double>, 3> along;
    if (uniform) {
      const std::vector<double> origin = file_.reals(3);
      const std::vector<double> spacing = file_.reals(3);
      for (std::size_t d = 0; d < 3; ++d)
        for (std::size_t i = 0; i < block.points[d]; ++i)
          along[d].push_back(origin[d] + static_cast<double>(i) * spacing[d]);
    } else {
      for (std::size_t d = 0; d < 3; ++d) along[d] = file_.reals(block.points[d]);
    }
    std::array<std::vector<double>, 3> axes;
    for (const double z : along[2])
      for (const double y : along[1])
        for (const double x : along[0]) {
          axes[0].push_back(x);
          axes[1].push_back(y);
          axes[2].push_back(z);
        }
    return axes;
  }

  void read_section(const std::string& line, Part& part) {
    const bool ghost = line.starts_with("g_");
    const std::string name = ghost ? line.substr(2) : line;
    if (name == "nsided" || name == "nfaced") return read_polytopes(name, part);
    const auto found = elements().find(name);
    if (found == elements().end())
      file_.fail(fmt::format("an element's name expected ({} found)", shown(line)));
    const Element& element = found->second;
    const std::size_t count = file_.count(4 * element.nodes);
    if (element_ids_) file_.wholes(count);
    const std::vector<std::int64_t> nodes = file_.wholes(count * element.nodes);
    part.sections.push_back({line, mesh_.cell_count(), count, {}});
    const CellConversion conversion = ghost ? kNoVolume : element.conversion;
    mesh_.cell_types.insert(mesh_.cell_types.end(), count,
                            mesh_.type_place(line, element.nodes, conversion));
    for (std::size_t i = 0; i < nodes.size(); ++i)
      mesh_.cell_nodes.push_back(point_of(nodes, i, name, part));
  }

  /// The point that is a part's node, which stands at that place in the list read last.
  std::int64_t point_of(const std::vector<std::int64_t>& nodes, std::size_t place,
                        const std::string& name, const Part& part) const {
    const std::int64_t node = nodes[place];
    if (node < 1 || static_cast<std::uint64_t>(node) > part.points)
      file_.fail(fmt::format("{} names node {} (1 to {} expected)", name, node, part.points),
                 place);
    return static_cast<std::int64_t>(part.first_point) + node - 1;
  }

  /// Reads as many numbers as the sum of these counts, which are the list read last.
  std::vector<std::int64_t> counted(const std::vector<std::int64_t>& counts) {
    std::size_t total = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (counts[i] < 0 || counts[i] > std::int64_t{1} << 31)
        file_.fail("a number of nodes expected", i);
      total += static_cast<std::size_t>(counts[i]);
    }
    return file_.wholes(total);
  }

  /// Polygons are only counted; polyhedra are read with their faces.
  void read_polytopes(const std::string& name, Part& part) {
    const std::size_t count = file_.count();
    if (element_ids_) file_.wholes(count);
    const std::vector<std::int64_t> sizes = file_.wholes(count);
    const std::vector<std::int64_t> next = counted(sizes);
    part.sections.push_back({name, mesh_.cell_count(), count, {}});
    if (name == "nsided") {
      mesh_.cell_types.insert(mesh_.cell_types.end(), count, mesh_.type_place(name, 0, kNoVolume));
      return;
    }
    const std::vector<std::int64_t> nodes = counted(next);
    std::size_t face = 0;
    std::size_t at = 0;
    for (const std::int64_t size : sizes) {
      std::vector<std::vector<std::int64_t>> faces(static_cast<std::size_t>(size));
      for (std::vector<std::int64_t>& own : faces)
        for (std::int64_t n = next[face++]; n > 0; --n)
          own.push_back(point_of(nodes, at++, name, part));
      mesh_.add_polyhedron(name, faces);
    }
  }

  GoldFile file_;
  ForeignMesh& mesh_;
  Parts parts_;
  bool node_ids_ = false;
  bool element_ids_ = false;
};

/// Reads the files of a variable.
struct VariableReader {
  Parts parts;
  ensight::Encoding encoding;
  std::size_t points = 0;
  std::size_t cells = 0;

  [[nodiscard]] std::vector<double> read(const std::string& path, std::size_t step,
                                         FieldLocation location, std::size_t width) const {
    GoldFile file(path, encoding);
    file.select_step(step);
    file.text();
    std::vector<double> values((location == FieldLocation::node ? points : cells) * width, kNaN);
    const Part* part = nullptr;
    while (!file.at_end()) {
      const std::string line = file.text();
      if (line.empty()) continue;
      if (line == "part") {
        const auto found = parts.find(file.part_number());
        if (found == parts.end()) file.fail("the number of a part of the geometry expected");
        part = &found->second;
        continue;
      }
      if (part == nullptr) file.fail(fmt::format("'part' expected ({} found)", shown(line)));
      read_values(file, line, *part, location, width, values);
    }
    return values;
  }

 private:
  static void read_values(GoldFile& file, const std::string& line, const Part& part,
                          FieldLocation location, std::size_t width, std::vector<double>& values) {
    const std::string name = line.substr(0, line.find(' '));
    const Section* section = nullptr;
    if (location == FieldLocation::cell) {
      for (const Section& one : part.sections)
        if (one.name == name) section = &one;
      if (section == nullptr)
        file.fail(fmt::format("an element's name of the part expected ({} found)", shown(line)));
    } else if (name != "coordinates" && name != "block") {
      file.fail(fmt::format("'coordinates' or 'block' expected ({} found)", shown(line)));
    }
    const bool undefined = line.ends_with("undef");
    const double absent = undefined ? file.reals(1).front() : kNaN;
    const std::size_t count = section == nullptr ? part.points : section->count;
    const std::size_t first = section == nullptr ? part.first_point : section->first;
    const std::vector<std::size_t> places = places_of(file, line, count, section);
    for (std::size_t c = 0; c < width; ++c) {
      const std::vector<double> column = file.reals(places.size());
      const std::size_t place = ensight::component_place(c, width);
      for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i] != kHidden)
          values[(first + places[i]) * width + place] =
              undefined && column[i] == absent ? kNaN : column[i];
    }
  }

  static constexpr std::size_t kHidden = static_cast<std::size_t>(-1);

  /// For every value of a component, the place of its node or cell among those that were kept.
  /// Partial values come with a list of their nodes or cells.
  static std::vector<std::size_t> places_of(GoldFile& file, const std::string& line,
                                            std::size_t count, const Section* section) {
    std::vector<std::size_t> places(count, kHidden);
    if (section != nullptr && !section->kept.empty())
      for (std::size_t i = 0; i < section->kept.size(); ++i) places[section->kept[i]] = i;
    else
      std::iota(places.begin(), places.end(), std::size_t{0});
    if (!line.ends_with("partial")) return places;
    std::vector<std::size_t> chosen;
    for (const std::int64_t number : file.wholes(file.count())) {
      if (number < 1 || static_cast<std::uint64_t>(number) > count)
        file.fail(
            fmt::format("a place of partial values (1 to {} expected, {} found)", count, number),
            chosen.size());
      chosen.push_back(places[static_cast<std::size_t>(number) - 1]);
    }
    return chosen;
  }
};

/// The distinct times of all sets, rising.
std::vector<double> times_of(const std::vector<ensight::TimeSet>& sets) {
  std::vector<double> times;
  for (const ensight::TimeSet& set : sets)
    times.insert(times.end(), set.times.begin(), set.times.end());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Reads a variable's file at a step.
using ReadVariable = std::function<std::vector<double>(const std::string& path, std::size_t step,
                                                       FieldLocation location, std::size_t width)>;

/// Adds the geometry to the mesh; returns the reader of its variables.
ReadVariable read_geometry(const ensight::CaseFile& parsed, const std::string& path,
                           std::size_t step, ForeignMesh& mesh) {
  if (parsed.version_6) {
    const auto six = std::make_shared<ensight::SixMesh>();
    six->read(path, mesh);
    return [six](const std::string& file, std::size_t, FieldLocation location, std::size_t width) {
      return six->values(file, location, width);
    };
  }
  Geometry geometry(path, step, mesh);
  const auto reader = std::make_shared<VariableReader>();
  reader->parts = geometry.read();
  reader->encoding = geometry.encoding();
  reader->points = mesh.point_count();
  reader->cells = mesh.cell_count();
  return [reader](const std::string& file, std::size_t at, FieldLocation location,
                  std::size_t width) { return reader->read(file, at, location, width); };
}

/// The steps of the mesh at which all files of a variable exist; empty if it has one file for all.
std::set<std::size_t> steps_with_files(const ensight::Variable& variable, const std::string& path,
                                       const ensight::TimeSet* set,
                                       const std::vector<double>& times) {
  std::set<std::size_t> steps;
  if (set == nullptr || set->file_numbers.empty()) return steps;
  std::map<std::size_t, bool> known;  // by step of the set
  for (std::size_t step = 0; step < times.size(); ++step) {
    const std::size_t own = set->step_at(times[step]);
    const auto [there, is_new] = known.try_emplace(own, true);
    if (is_new)
      for (const std::string& file : variable.files)
        there->second &= std::filesystem::exists(ensight::file_of_step(path, file, set, own));
    if (there->second) steps.insert(step);
  }
  return steps;
}

ForeignMesh ensight_mesh(const std::string& path, const ReadOptions& options) {
  ForeignMesh mesh;
  const ensight::CaseFile parsed = ensight::read_case_file(path);
  mesh.notes = parsed.notes;
  mesh.times = times_of(parsed.time_sets);
  const std::size_t last = mesh.times.empty() ? 0 : mesh.times.size() - 1;
  const std::size_t step = requested_step(options, mesh.times, path).value_or(last);
  // every set has its own steps; the one that is current at the requested time is taken
  const auto step_of = [&](const ensight::TimeSet* set) {
    return set == nullptr || mesh.times.empty() ? 0 : set->step_at(mesh.times[step]);
  };
  const ensight::TimeSet* geometry_set = parsed.time_set(parsed.geometry_time_set, parsed.geometry);
  const std::size_t geometry_step = step_of(geometry_set);
  const ReadVariable read = read_geometry(
      parsed, ensight::file_of_step(path, parsed.geometry, geometry_set, geometry_step),
      geometry_step, mesh);
  for (const ensight::Variable& variable : parsed.variables) {
    const ensight::TimeSet* set = parsed.time_set(variable.time_set, variable.files.front());
    const std::size_t own = step_of(set);
    const std::set<std::size_t> steps = steps_with_files(variable, path, set, mesh.times);
    mesh.field_steps[variable.name] = steps;
    // a variable without any file is an error of its first one
    if (!steps.empty() && !steps.contains(step)) continue;
    std::vector<std::string> files;
    for (const std::string& file : variable.files)
      files.push_back(ensight::file_of_step(path, file, set, own));
    ForeignField field;
    field.name = variable.name;
    field.location = variable.location;
    field.components = static_cast<std::uint32_t>(variable.components * files.size());
    if (set != nullptr && !mesh.times.empty()) field.step = step;
    field.type = "float";
    field.values = [read, variable, files, own] {
      std::vector<double> values = read(files[0], own, variable.location, variable.components);
      if (files.size() == 1) return values;
      const std::vector<double> imaginary =
          read(files[1], own, variable.location, variable.components);
      std::vector<double> pairs;
      for (std::size_t i = 0; i < values.size(); ++i) {
        pairs.push_back(values[i]);
        pairs.push_back(imaginary[i]);
      }
      return pairs;
    };
    mesh.fields.push_back(std::move(field));
  }
  return mesh;
}

/// Whether a section FORMAT states an EnSight type. Other sections may be long and come before it,
/// and GEOMETRY may come last.
bool begins_case(std::string_view head) {
  TextCursor cursor(head, "");
  bool format = false;
  while (!cursor.at_end()) {
    const std::string_view line = trimmed(cursor.line());
    if (line.starts_with("type:")) return format && trimmed(line.substr(5)).starts_with("ensight");
    if (line == "FORMAT") format = true;
  }
  return false;
}

}  // namespace

Format ensight_format() {
  Format format;
  format.name = "ensight";
  format.extensions = {".case", ".encas"};
  format.kinds = "tet4,10 pyr5,13 prism6,15 brick8,20";
  format.fields = "node, cell";
  format.time_steps = "several";
  format.recognizes = [](std::string_view head) { return begins_case(head); };
  read_through(format, ensight_mesh);
  return format;
}

}  // namespace hiac::formats
