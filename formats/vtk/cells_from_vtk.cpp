#include "formats/vtk/cells_from_vtk.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "formats/degenerate_cell.hpp"
#include "formats/vtk/cell_types.hpp"
#include "formats/vtk/dataset_cells.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::vtk {
namespace {

using Counts = std::map<std::string, std::size_t>;

std::string listed(const Counts& counts) {
  std::vector<std::string> parts;
  for (const auto& [name, count] : counts) parts.push_back(fmt::format("{} {}", count, name));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string name_with_nodes(int type, std::size_t nodes) {
  return nodes == 0 ? cell_type_name(type)
                    : fmt::format("{} of {} nodes", cell_type_name(type), nodes);
}

[[noreturn]] void refuse_node_count(std::size_t index, const StoredCell& cell,
                                    const std::string& subject) {
  throw InputError(subject, fmt::format("cell {}: a {} cannot have {} nodes", index,
                                        cell_type_name(cell.type), cell.points.size()));
}

/// The cell's nodes in the order of the zoo's kind.
void order_nodes(const StoredCell& cell, std::size_t count,
                 std::span<const std::uint8_t> permutation, std::vector<NodeId>& nodes) {
  nodes.resize(count);
  for (std::size_t n = 0; n < count; ++n)
    nodes[n] = static_cast<NodeId>(cell.points[permutation.empty() ? n : permutation[n]]);
}

class Converter {
 public:
  Converter(vtkDataSet& dataset, const ReadOptions& options, const std::string& subject)
      : cells_(dataset, subject), options_(options), subject_(subject) {}

  ConvertedCells run(std::vector<std::string>& notes) {
    if (cells_.count() >= kNoCell || cells_.point_count() > std::size_t{kNoCell} + 1)
      throw InputError(subject_, fmt::format("too large (at most {} cells and {} points expected, "
                                             "{} and {} found)",
                                             kNoCell - 1, std::size_t{kNoCell} + 1, cells_.count(),
                                             cells_.point_count()));
    result_.kinds.reserve(cells_.count());
    result_.elems.reserve(cells_.count() + 1);
    result_.nodes.reserve(cells_.entry_count());
    result_.elems.push_back(0);
    for (std::size_t i = 0; i < cells_.count(); ++i) convert(i);
    refuse_unsupported();
    write_notes(notes);
    finish_kept();
    return std::move(result_);
  }

 private:
  void convert(std::size_t index) {
    const StoredCell cell = cells_.cell(index);
    if (cells_.is_ghost(index) || cells_.has_hidden_point(cell.points)) {
      ++ghosts_;
      return;
    }
    const CellConversion conversion = conversion_of(cell.type, cell.points.size());
    switch (conversion.fate) {
      case CellFate::converted:
        if (cell.points.size() > node_count(conversion.kind))
          ++extra_nodes_[name_with_nodes(cell.type, cell.points.size())];
        add(index, conversion.kind, conversion.permutation, cell);
        return;
      case CellFate::no_volume:
        ++surfaces_[cell_type_name(cell.type)];
        return;
      case CellFate::wrong:
        refuse_node_count(index, cell, subject_);
      case CellFate::unsupported:
        break;
    }
    if (options_.corners_of_unsupported && conversion.corners) {
      ++reduced_[name_with_nodes(cell.type, cell.points.size())];
      add(index, *conversion.corners, {}, cell);
      return;
    }
    ++unsupported_[name_with_nodes(cell.type, cell.points.size())];
    any_reducible_ |= conversion.corners.has_value();
  }

  void add(std::size_t index, CellKind kind, std::span<const std::uint8_t> permutation,
           const StoredCell& cell) {
    order_nodes(cell, node_count(kind), permutation, scratch_);
    if (TrueKinds::has_repeated_corner(kind, scratch_)) return add_true_kind(index, kind, cell);
    result_.nodes.insert(result_.nodes.end(), scratch_.begin(), scratch_.end());
    finish_cell(index, kind);
  }

  void add_true_kind(std::size_t index, CellKind kind, const StoredCell& cell) {
    const TrueCell found = true_kinds_.find(kind, scratch_);
    if (!found.problem.empty()) {
      ++unsupported_[fmt::format("{} that {}", cell_type_name(cell.type), found.problem)];
      if (unsupported_.size() == 1 && first_problem_.empty())
        first_problem_ =
            fmt::format("; the first is cell {} with nodes {}", index, fmt::join(scratch_, " "));
      return;
    }
    ++true_cells_[fmt::format("{} to {}", kind_name(kind), kind_name(found.kind))];
    for (std::size_t n = 0; n < node_count(found.kind); ++n)
      result_.nodes.push_back(scratch_[found.nodes[n]]);
    finish_cell(index, found.kind);
  }

  void finish_cell(std::size_t index, CellKind kind) {
    if (result_.all_kept && index != result_.kinds.size()) start_kept();
    result_.kinds.push_back(kind);
    result_.elems.push_back(result_.nodes.size());
    if (!result_.all_kept) result_.kept.push_back(static_cast<CellId>(index));
  }

  /// From the first gap on, it has to be noted which cells are kept.
  void start_kept() {
    result_.all_kept = false;
    for (CellId i = 0; i < result_.kinds.size(); ++i) result_.kept.push_back(i);
  }

  void finish_kept() {
    if (result_.all_kept && result_.kinds.size() != cells_.count()) start_kept();
  }

  void refuse_unsupported() const {
    if (unsupported_.empty() || options_.skip_unsupported) return;
    throw InputError(subject_,
                     fmt::format("holds volume cells that cannot be converted: {}{} "
                                 "(--skip-unsupported leaves them out{})",
                                 listed(unsupported_), first_problem_,
                                 any_reducible_ ? ", --corners-only takes their corners" : ""));
  }

  void write_notes(std::vector<std::string>& notes) const {
    if (!surfaces_.empty())
      notes.push_back(fmt::format("dropped cells without volume: {}", listed(surfaces_)));
    if (ghosts_ > 0) notes.push_back(fmt::format("dropped {} ghost or hidden cells", ghosts_));
    if (!unsupported_.empty())
      notes.push_back(fmt::format("skipped unsupported cells: {}", listed(unsupported_)));
    if (!reduced_.empty())
      notes.push_back(fmt::format("kept the corners alone of: {}", listed(reduced_)));
    if (!extra_nodes_.empty())
      notes.push_back(fmt::format("took the first nodes of cells of linear types with more: {}",
                                  listed(extra_nodes_)));
    if (!true_cells_.empty())
      notes.push_back(
          fmt::format("cells with repeated nodes became their true kind: {}", listed(true_cells_)));
  }

  DatasetCells cells_;
  const ReadOptions& options_;
  std::string subject_;
  ConvertedCells result_;
  TrueKinds true_kinds_;
  std::vector<NodeId> scratch_;
  std::size_t ghosts_ = 0;
  Counts surfaces_;
  Counts unsupported_;
  Counts reduced_;
  Counts true_cells_;
  Counts extra_nodes_;
  std::string first_problem_;
  bool any_reducible_ = false;
};

}  // namespace

ConvertedCells convert_cells(vtkDataSet& dataset, const ReadOptions& options,
                             const std::string& subject, std::vector<std::string>& notes) {
  return Converter(dataset, options, subject).run(notes);
}

namespace {

std::string fate_of(CellKind kind, std::span<const NodeId> nodes, TrueKinds& true_kinds) {
  if (!TrueKinds::has_repeated_corner(kind, nodes)) return std::string(kind_name(kind));
  const TrueCell found = true_kinds.find(kind, nodes);
  return std::string(found.problem.empty() ? kind_name(found.kind) : "unsupported");
}

}  // namespace

std::vector<CellCount> count_cells(vtkDataSet& dataset, const std::string& subject) {
  DatasetCells cells(dataset, subject);
  TrueKinds true_kinds;
  std::vector<NodeId> nodes;
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    const StoredCell cell = cells.cell(i);
    const CellConversion conversion = conversion_of(cell.type, cell.points.size());
    std::string name = cell_type_name(cell.type);
    std::string fate;
    switch (conversion.fate) {
      case CellFate::converted: {
        order_nodes(cell, node_count(conversion.kind), conversion.permutation, nodes);
        fate = fate_of(conversion.kind, nodes, true_kinds);
        break;
      }
      case CellFate::no_volume:
        fate = "dropped (no volume)";
        break;
      case CellFate::wrong:
        refuse_node_count(i, cell, subject);
      case CellFate::unsupported:
        name = name_with_nodes(cell.type, cell.points.size());
        fate = "unsupported";
        break;
    }
    if (cells.is_ghost(i) || cells.has_hidden_point(cell.points)) fate = "dropped (ghost)";
    ++counts[{name, fate}];
  }
  std::vector<CellCount> result;
  for (const auto& [key, count] : counts) result.push_back({key.first, count, key.second});
  return result;
}

}  // namespace hiac::formats::vtk
