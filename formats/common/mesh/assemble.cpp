#include "formats/common/mesh/assemble.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "formats/common/cells/cell_collector.hpp"
#include "formats/common/cells/reduce_cells.hpp"
#include "formats/common/io/bytes_behind.hpp"
#include "formats/common/io/one_line_errors.hpp"
#include "formats/common/mesh/block_choice.hpp"
#include "formats/common/mesh/gate.hpp"
#include "formats/common/mesh/node_resolver.hpp"
#include "formats/common/mesh/steps.hpp"
#include "hiac/base/error.hpp"
#include "hiac/mesh/fields/location_name.hpp"
#include "hiac/mesh/parts/chosen_tuples.hpp"

namespace hiac::formats {
namespace {

/// For every cell, whether it is in the requested block; empty: all cells are wanted.
std::vector<bool> wanted_cells(const ForeignMesh& foreign, const ReadOptions& options,
                               const std::string& subject) {
  if (!options.block) return {};
  std::vector<bool> wanted(foreign.cell_count(), false);
  std::vector<std::string> names;
  bool found = false;
  for (const ForeignBlock& block : foreign.blocks) {
    names.push_back(block.name);
    if (block.name != *options.block) continue;
    found = true;
    for (const IndexRange range : block.cells)
      std::fill(wanted.begin() + static_cast<std::ptrdiff_t>(range.begin),
                wanted.begin() + static_cast<std::ptrdiff_t>(range.end), true);
  }
  if (found) return wanted;
  throw no_such_block(*options.block, names, subject);
}

/// The fields of the requested step, or the last of each.
std::vector<const ForeignField*> chosen_fields(const ForeignMesh& foreign,
                                               std::optional<std::size_t> step) {
  std::vector<const ForeignField*> chosen;
  for (const ForeignField& field : foreign.fields) {
    if (step && field.step && *field.step != *step) continue;
    const auto known = std::find_if(chosen.begin(), chosen.end(), [&](const ForeignField* other) {
      return other->name == field.name && other->location == field.location;
    });
    if (known == chosen.end())
      chosen.push_back(&field);
    else if (!(field.step && (*known)->step && *field.step < *(*known)->step))
      *known = &field;
  }
  return chosen;
}

/// The steps at which the file's fields have values.
FieldSteps steps_of_fields(const ForeignMesh& foreign) {
  FieldSteps steps = foreign.field_steps;
  if (!steps.empty()) return steps;
  std::set<std::string> always;
  for (const ForeignField& field : foreign.fields) {
    if (field.step)
      steps[field.name].insert(*field.step);
    else
      always.insert(field.name);
  }
  for (const std::string& name : always) steps.erase(name);
  return steps;
}

/// Where the nodes of every cell begin in ForeignMesh::cell_nodes.
std::vector<std::uint64_t> cell_starts(const ForeignMesh& foreign) {
  std::vector<std::uint64_t> starts{0};
  starts.reserve(foreign.cell_count() + 1);
  for (const std::uint16_t type : foreign.cell_types)
    starts.push_back(starts.back() + foreign.types[type].nodes);
  return starts;
}

class Assembler {
 public:
  /// `reason`: why some cells cannot be converted.
  Assembler(ForeignMesh&& foreign, const ReadOptions& options, const std::string& subject,
            std::string reason)
      : foreign_(std::move(foreign)),
        options_(options),
        subject_(subject),
        reason_(std::move(reason)) {}

  Reading run() {
    step_ = requested_step(options_, foreign_.times, subject_);
    reading_.notes = std::move(foreign_.notes);
    reading_.mesh.metadata = std::move(foreign_.metadata);
    fields_ = chosen_fields(foreign_, step_);
    convert_cells();
    note_time();
    add_fields();
    pass_gate(reading_, used_, subject_);
    return std::move(reading_);
  }

 private:
  void convert_cells() {
    const std::vector<bool> wanted = wanted_cells(foreign_, options_, subject_);
    NodeResolver resolver(foreign_, subject_);
    CellCollector collector(options_, subject_,
                            [this](int type) { return foreign_.types[index(type)].name; });
    collector.reserve(foreign_.cell_count(), foreign_.cell_nodes.size());
    collector.explain(reason_);
    const bool any_corner = std::any_of(fields_.begin(), fields_.end(), [](const auto* field) {
      return field->location == FieldLocation::corner;
    });
    if (any_corner) collector.keep_places();
    collector.accept_mid_nodes([&](NodeId a, NodeId b) {
      if (made_.size() != resolver.made().size()) made_ = resolver.made();
      return distance_between(a, b) == 0;
    });
    std::size_t begin = 0;
    for (std::size_t cell = 0; cell < foreign_.cell_count(); ++cell) {
      const std::size_t type = foreign_.cell_types[cell];
      const std::size_t end = begin + foreign_.types[type].nodes;
      if (wanted.empty() || wanted[cell]) {
        const NodeResolver::Cell resolved = resolver.resolve(cell, begin);
        collector.add(cell, static_cast<int>(type), resolved.nodes, *resolved.conversion);
      }
      begin = end;
    }
    cells_ = collector.finish(foreign_.cell_count(), reading_.notes);
    made_ = resolver.made();
    note_replaced();
    if (!any_corner) foreign_.cell_nodes = {};
    finish_nodes();
  }

  /// The value of a point, or of a node that was made between two.
  [[nodiscard]] double value_at(std::span<const double> values, std::size_t width, NodeId node,
                                std::size_t component) const {
    const std::size_t points = foreign_.point_count();
    if (node < points) return values[node * width + component];
    const auto& [a, b] = made_[node - points];
    return (values[a * width + component] + values[b * width + component]) / 2;
  }

  [[nodiscard]] double distance_between(NodeId a, NodeId b) const {
    std::array<double, 3> edge{};
    for (std::size_t c = 0; c < 3; ++c)
      edge[c] = value_at(foreign_.xyz, 3, a, c) - value_at(foreign_.xyz, 3, b, c);
    return std::hypot(edge[0], edge[1], edge[2]);
  }

  /// Says how far mid-edge nodes that were left out lie from the nodes in their place, and how much
  /// their values differ.
  void note_replaced() {
    if (cells_.replaced.empty()) return;
    double farthest = 0;
    for (const auto& [node, by] : cells_.replaced)
      farthest = std::max(farthest, distance_between(node, by));
    std::string note = fmt::format(
        "{} mid-edge nodes of cells with repeated corners do not follow the corners and were left "
        "out: nodes move by up to {:.3g}",
        cells_.replaced.size(), farthest);
    for (const ForeignField* field : fields_) {
      if (field->location != FieldLocation::node) continue;
      const std::vector<double> values = field->values();
      if (values.size() != field->components * points_) continue;
      double error = 0;
      for (const auto& [node, by] : cells_.replaced)
        for (std::size_t c = 0; c < field->components; ++c)
          error = std::max(error, std::abs(value_at(values, field->components, node, c) -
                                           value_at(values, field->components, by, c)));
      note += fmt::format(", field '{}' errs by up to {:.3g}", field->name, error);
    }
    reading_.notes.push_back(std::move(note));
  }

  static std::size_t index(int type) { return static_cast<std::size_t>(type); }

  void finish_nodes() {
    if (!made_.empty())
      reading_.notes.push_back(
          fmt::format("{} mid-edge nodes that cells leave out were put in the middle of their "
                      "straight edges, with the mean of the fields at their ends",
                      made_.size()));
    used_ = use_points(cells_.nodes, foreign_.point_count() + made_.size(), reading_.notes);
    reading_.mesh.xyz = node_values(std::move(foreign_.xyz), 3);
    reading_.mesh.kinds = std::move(cells_.kinds);
    reading_.mesh.elems = std::move(cells_.elems);
    reading_.mesh.nodes = std::move(cells_.nodes);
  }

  /// Values of the file's points as values of the mesh's nodes.
  std::vector<double> node_values(std::vector<double>&& values, std::size_t width) const {
    for (const auto& [a, b] : made_)
      for (std::size_t c = 0; c < width; ++c)
        values.push_back((values[a * width + c] + values[b * width + c]) / 2);
    return used_.all ? std::move(values)
                     : chosen_tuples(std::span<const double>(values), width, used_.chosen);
  }

  std::vector<double> corner_values(const std::vector<double>& values, std::size_t width) const {
    const std::vector<std::uint64_t> starts = cell_starts(foreign_);
    std::vector<double> result;
    result.reserve(cells_.places.size() * width);
    for (CellId cell = 0; cell < reading_.mesh.cell_count(); ++cell) {
      const std::size_t stored = cells_.all_kept ? cell : cells_.kept[cell];
      const CellConversion& conversion = foreign_.types[foreign_.cell_types[stored]].conversion;
      for (std::size_t e = reading_.mesh.elems[cell]; e < reading_.mesh.elems[cell + 1]; ++e) {
        std::pair<std::size_t, std::size_t> places{cells_.places[e], cells_.places[e]};
        if (foreign_.cell_nodes[starts[stored] + places.first] == kLeftOutNode)
          places = edge_ends(conversion, places.first);
        const double* a = &values[(starts[stored] + places.first) * width];
        const double* b = &values[(starts[stored] + places.second) * width];
        for (std::size_t c = 0; c < width; ++c)
          result.push_back(places.first == places.second ? a[c] : (a[c] + b[c]) / 2);
      }
    }
    return result;
  }

  [[nodiscard]] std::size_t tuples_of(FieldLocation location) const {
    if (location == FieldLocation::node) return points_;
    return location == FieldLocation::cell ? foreign_.cell_count() : entries_;
  }

  void add_fields() {
    for (const ForeignField* field : fields_) {
      std::vector<double> values = field->values();
      const std::size_t width = field->components;
      if (values.size() != width * tuples_of(field->location))
        throw InputError(
            subject_, fmt::format("field '{}' does not fit ({} values expected, {} "
                                  "found)",
                                  field->name, width * tuples_of(field->location), values.size()));
      if (field->location == FieldLocation::node)
        values = node_values(std::move(values), width);
      else if (field->location == FieldLocation::corner)
        values = corner_values(values, width);
      else if (!cells_.all_kept)
        values = chosen_tuples(std::span<const double>(values), width, cells_.kept);
      reading_.mesh.fields.push_back(
          {field->name, field->unit, field->location, field->components, std::move(values)});
    }
  }

  /// Adds the time of the fields to the metadata; a note names the fields that have another time.
  void note_time() {
    std::optional<std::size_t> last = step_;
    for (const ForeignField* field : fields_)
      if (!step_ && field->step && (!last || *field->step > *last)) last = field->step;
    if (!last || *last >= foreign_.times.size()) return;
    reading_.mesh.metadata.emplace_back("time", fmt::format("{}", foreign_.times[*last]));
    // without a request, fields that a later step does not have are those of their own last step
    if (step_ || !foreign_.field_steps.empty())
      note_absent_fields(steps_of_fields(foreign_), foreign_.times, *last, reading_.notes);
    if (step_ || foreign_.times.size() < 2) return;
    reading_.notes.push_back(last_step_note(foreign_.times.size(), foreign_.times[*last]));
    for (const ForeignField* field : fields_)
      if (field->step && *field->step != *last)
        reading_.notes.push_back(fmt::format("field '{}' is of time {}, its last", field->name,
                                             foreign_.times[*field->step]));
  }

  ForeignMesh foreign_;
  const ReadOptions& options_;
  const std::string& subject_;
  std::string reason_;
  std::size_t points_ = foreign_.point_count();
  std::size_t entries_ = foreign_.cell_nodes.size();
  std::optional<std::size_t> step_;
  std::vector<const ForeignField*> fields_;
  ConvertedCells cells_;
  std::vector<std::pair<NodeId, NodeId>> made_;
  UsedPoints used_;
  Reading reading_;
};

std::vector<CellCount> count_cells(const ForeignMesh& foreign, const std::string& subject) {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  NodeResolver resolver(foreign, subject);
  TrueKinds true_kinds;
  std::size_t begin = 0;
  for (std::size_t cell = 0; cell < foreign.cell_count(); ++cell) {
    const ForeignType& type = foreign.types[foreign.cell_types[cell]];
    const NodeResolver::Cell resolved = resolver.resolve(cell, begin);
    begin += type.nodes;
    const bool by_faces =
        std::binary_search(foreign.polyhedra.cells.begin(), foreign.polyhedra.cells.end(), cell);
    ++counts[{type.name, by_faces ? "what its faces make it"
                                  : fate_of(*resolved.conversion, resolved.nodes, true_kinds)}];
  }
  std::vector<CellCount> result;
  for (const auto& [key, count] : counts) result.push_back({key.first, count, key.second});
  return result;
}

}  // namespace

Reading assemble_piece(ForeignMesh&& foreign, const ReadOptions& options,
                       const std::string& subject) {
  const auto step = requested_step(options, foreign.times, subject);
  std::string reason = reduce_cells(foreign, options, chosen_fields(foreign, step), subject);
  return Assembler(std::move(foreign), options, subject, std::move(reason)).run();
}

Reading assemble(ForeignMesh&& foreign, const ReadOptions& options, const std::string& subject) {
  Reading reading = assemble_piece(std::move(foreign), options, subject);
  finish_reading(reading, subject);
  return reading;
}

Inventory inventory_of(const ForeignMesh& foreign, std::string_view format,
                       const std::string& subject) {
  Inventory inventory;
  inventory.format = format;
  inventory.points = foreign.point_count();
  inventory.cells = count_cells(foreign, subject);
  for (const ForeignField* field : chosen_fields(foreign, std::nullopt)) {
    FieldSummary summary{field->name, std::string(location_name(field->location)), field->type,
                         field->components};
    const std::vector<double> values = field->values();
    summary.tuples = values.size() / field->components;
    summarize_values(values, summary);
    inventory.fields.push_back(std::move(summary));
  }
  inventory.times = foreign.times;
  for (const ForeignBlock& block : foreign.blocks) inventory.blocks.push_back(block.name);
  inventory.notes = foreign.notes;
  note_partial_fields(steps_of_fields(foreign), foreign.times.size(), inventory.notes);
  note_bytes_behind_container(subject, inventory.notes);
  return inventory;
}

void read_through(
    Format& format,
    std::function<ForeignMesh(const std::string& path, const ReadOptions& options)> open) {
  format.read = [open](const std::string& path, const ReadOptions& options) {
    return with_errors_of_one_line([&] { return assemble(open(path, options), options, path); });
  };
  format.inspect = [open = std::move(open), name = format.name](const std::string& path) {
    return with_errors_of_one_line([&] { return inventory_of(open(path, {}), name, path); });
  };
}

}  // namespace hiac::formats
