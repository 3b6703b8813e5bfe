#include "hiac/tetrahedralize/cut_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/geometry/cell_volume.hpp"
#include "hiac/mesh/shape_functions.hpp"
#include "hiac/tetrahedralize/chosen_cut.hpp"

namespace hiac {
namespace {

constexpr NodeId kNone = std::numeric_limits<NodeId>::max();

// A node of the new mesh: a node of a cell, by its number there, or kCellCenter.
struct Entry {
  CellId cell;
  std::uint8_t number;
};

class Cutter {
 public:
  explicit Cutter(const ZooMesh& mesh) : mesh_(mesh) {}

  void keep(CellId cell) {
    for (std::size_t n = 0; n < node_count(mesh_.kinds[cell]); ++n)
      add_node({cell, static_cast<std::uint8_t>(n)});
    finish_cell(cell, mesh_.kinds[cell]);
  }

  void cut(CellId cell) {
    const double volume = signed_volume(mesh_, cell);
    const int hand = volume < 0 ? -1 : 1;
    const ChosenCut* best = nullptr;
    double least = 0;
    const std::vector<ChosenCut> cuts = possible_cuts(mesh_, cell);
    for (const ChosenCut& cut : cuts) {
      const double inverted = filled_by(cell, cut, -hand);
      if (best != nullptr && !(inverted < least)) continue;
      best = &cut;
      least = inverted;
    }
    result_.volume_change += std::abs(filled_by(cell, *best, hand) - std::abs(volume));
    if (filled_by(cell, *best, hand) == 0) ++result_.vanished;
    for (std::size_t k = 0; k < best->cut.count; ++k) {
      if (best->signs[k] != hand) continue;
      CornerTetrahedron t = best->cut.tetrahedra[k];
      if (hand < 0) std::swap(t[2], t[3]);
      for (const std::uint8_t corner : t) add_node({cell, corner});
      finish_cell(cell, CellKind::tetrahedron4);
      ++result_.tetrahedra;
    }
  }

  void count_volume(double volume) { result_.volume += std::abs(volume); }

  CutMesh finish() {
    drop_unused();
    ZooMesh& mesh = result_.mesh;
    mesh.xyz = at_nodes(mesh_.xyz.view(), 3);
    for (const Field& field : mesh_.fields) {
      const auto values = field.values.view();
      mesh.fields.push_back(field);
      mesh.fields.back().values =
          field.location == FieldLocation::node   ? at_nodes(values, field.components)
          : field.location == FieldLocation::cell ? at_cells(values, field.components)
                                                  : at_entries(values, field.components);
    }
    mesh.metadata = mesh_.metadata;
    mesh.kinds = std::move(kinds_);
    mesh.elems = std::move(elems_);
    mesh.nodes = std::move(nodes_);
    return std::move(result_);
  }

 private:
  void add_node(const Entry& entry) {
    entries_.push_back(entry);
    if (entry.number != kCellCenter) {
      nodes_.push_back(mesh_.cell_nodes(entry.cell)[entry.number]);
      return;
    }
    // the centres of a cell's tetrahedra are one node
    if (centres_.empty() || centres_.back() != entry.cell) centres_.push_back(entry.cell);
    const std::size_t node = mesh_.node_count() + centres_.size() - 1;
    if (node >= kNone)
      throw InputError("mesh", "its cells need too many nodes (at most 2^32 - 1 expected)");
    nodes_.push_back(static_cast<NodeId>(node));
  }

  void finish_cell(CellId parent, CellKind kind) {
    parents_.push_back(parent);
    kinds_.push_back(kind);
    elems_.push_back(nodes_.size());
  }

  // The volume of the tetrahedra that turn that way.
  [[nodiscard]] double filled_by(CellId cell, const ChosenCut& cut, int hand) const {
    double sum = 0;
    for (std::size_t k = 0; k < cut.cut.count; ++k)
      if (cut.signs[k] == hand) sum += volume_of(cell, cut.cut.tetrahedra[k]);
    return sum;
  }

  [[nodiscard]] double volume_of(CellId cell, const CornerTetrahedron& t) const {
    std::array<std::array<double, 3>, 4> at{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::vector<double> position = values_at(
          {cell, t[k]}, 3,
          [&](CellId of, std::size_t n) { return mesh_.position(mesh_.cell_nodes(of)[n]).data(); });
      std::copy(position.begin(), position.end(), at[k].begin());
    }
    const auto edge = [&](std::size_t k, std::size_t c) { return at[k][c] - at[0][c]; };
    double six = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
      six += edge(1, c) * (edge(2, d) * edge(3, e) - edge(2, e) * edge(3, d));
    }
    return std::abs(six) / 6;
  }

  // `tuple_of(cell, n)` points to the values of the cell's node n.
  template <typename TupleOf>
  [[nodiscard]] std::vector<double> values_at(const Entry& entry, std::size_t width,
                                              const TupleOf& tuple_of) const {
    if (entry.number != kCellCenter) {
      const double* tuple = tuple_of(entry.cell, entry.number);
      return {tuple, tuple + width};
    }
    const CellKind kind = mesh_.kinds[entry.cell];
    std::array<double, kMaxNodesPerCell> shape;
    shape_functions<double>(kind, reference_center(kind), shape);
    std::vector<double> values(width, 0.0);
    for (std::size_t n = 0; n < node_count(kind); ++n)
      for (std::size_t c = 0; c < width; ++c) values[c] += shape[n] * tuple_of(entry.cell, n)[c];
    return values;
  }

  // Renumbers the nodes that are used, in their order.
  void drop_unused() {
    std::vector<NodeId> number(mesh_.node_count() + centres_.size(), kNone);
    for (const NodeId node : nodes_) number[node] = 0;
    for (NodeId node = 0; node < number.size(); ++node) {
      if (number[node] == kNone) continue;
      number[node] = static_cast<NodeId>(used_.size());
      used_.push_back(node);
    }
    for (NodeId& node : nodes_) node = number[node];
    result_.dropped_nodes = mesh_.node_count() + centres_.size() - used_.size();
  }

  [[nodiscard]] SharedArray<double> at_nodes(std::span<const double> values,
                                             std::size_t width) const {
    std::vector<double> result;
    result.reserve(used_.size() * width);
    const auto tuple_of = [&](CellId cell, std::size_t n) {
      return &values[mesh_.cell_nodes(cell)[n] * width];
    };
    for (const NodeId node : used_) {
      if (node < mesh_.node_count()) {
        const auto tuple = values.subspan(node * width, width);
        result.insert(result.end(), tuple.begin(), tuple.end());
        continue;
      }
      const std::vector<double> made =
          values_at({centres_[node - mesh_.node_count()], kCellCenter}, width, tuple_of);
      result.insert(result.end(), made.begin(), made.end());
    }
    return result;
  }

  [[nodiscard]] SharedArray<double> at_entries(std::span<const double> values,
                                               std::size_t width) const {
    std::vector<double> result;
    result.reserve(entries_.size() * width);
    for (const Entry& entry : entries_) {
      const std::vector<double> tuple = values_at(entry, width, [&](CellId cell, std::size_t n) {
        return &values[(mesh_.elems[cell] + n) * width];
      });
      result.insert(result.end(), tuple.begin(), tuple.end());
    }
    return result;
  }

  [[nodiscard]] SharedArray<double> at_cells(std::span<const double> values,
                                             std::size_t width) const {
    std::vector<double> result;
    result.reserve(parents_.size() * width);
    for (const CellId cell : parents_) {
      const auto tuple = values.subspan(cell * width, width);
      result.insert(result.end(), tuple.begin(), tuple.end());
    }
    return result;
  }

  const ZooMesh& mesh_;
  CutMesh result_;
  std::vector<CellKind> kinds_;
  std::vector<std::uint64_t> elems_{0};
  std::vector<NodeId> nodes_;    // centres are numbered after the given nodes
  std::vector<Entry> entries_;   // one for every entry of nodes_
  std::vector<CellId> parents_;  // of every cell
  std::vector<CellId> centres_;  // the cells that got a node in their centre
  std::vector<NodeId> used_;
};

}  // namespace

CutMesh cut_cells(const ZooMesh& mesh, std::span<const CellId> cells) {
  Cutter cutter(mesh);
  auto next = cells.begin();
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    cutter.count_volume(signed_volume(mesh, cell));
    if (next != cells.end() && *next == cell) {
      cutter.cut(cell);
      ++next;
    } else {
      cutter.keep(cell);
    }
  }
  return cutter.finish();
}

CutMesh leave_out_cells(const ZooMesh& mesh, std::span<const CellId> cells) {
  Cutter cutter(mesh);
  auto next = cells.begin();
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    if (next != cells.end() && *next == cell)
      ++next;
    else
      cutter.keep(cell);
  }
  return cutter.finish();
}

}  // namespace hiac
