#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/common/cells/cell_conversion.hpp"
#include "formats/common/cells/degenerate_cell.hpp"
#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// The cells of a file that go into a zoo mesh; nodes are still the file's points.
struct ConvertedCells {
  std::vector<CellKind> kinds;
  std::vector<std::uint64_t> elems;
  std::vector<NodeId> nodes;
  bool all_kept = true;
  std::vector<CellId> kept;  ///< the file's cell of every cell; empty when all were kept
  /// For every entry of `nodes` its place among the nodes of the file's cell; empty unless
  /// requested (keep_places).
  std::vector<std::uint8_t> places;
  /// Mid-edge nodes of cells with repeated corners that were left out, and the nodes that take
  /// their place in the true cell.
  std::vector<std::pair<NodeId, NodeId>> replaced;
};

/// Converts a file's cells one after the other: it puts nodes into the zoo's order, gives cells
/// with repeated nodes their true kind, and counts the cells left out, for the notes or for the
/// refusal. The cells of every reader pass through this class.
class CellCollector {
 public:
  /// The name of a cell type in the format's own words.
  using TypeName = std::function<std::string(int type)>;

  CellCollector(const ReadOptions& options, std::string subject, TypeName type_name);

  /// Reserves memory for that many cells and entries; the caller has checked that they exist.
  void reserve(std::size_t cells, std::size_t entries);
  /// From now on ConvertedCells::places is kept.
  void keep_places() { keep_places_ = true; }

  /// Cells with repeated corners whose mid-edge nodes do not follow take their true kind where
  /// `same_place` says of these nodes that they lie where they should (and, with
  /// ReadOptions::approximate, anywhere).
  void accept_mid_nodes(std::function<bool(NodeId, NodeId)> same_place) {
    same_place_ = std::move(same_place);
  }

  /// Says why cells are unsupported, for the message that refuses them.
  void explain(const std::string& reason) { reason_ = reason; }

  /// Adds the file's cell number `index` (rising). `nodes` are numbers of existing points.
  /// Throws InputError when the conversion says that the number of nodes is wrong.
  void add(std::size_t index, int type, std::span<const NodeId> nodes,
           const CellConversion& conversion);

  /// Writes the notes and gives the cells. `total` is the number of the file's cells. Throws
  /// InputError naming the volume cells that cannot be converted, unless they are to be skipped.
  ConvertedCells finish(std::size_t total, std::vector<std::string>& notes);

 private:
  /// By type and number of nodes; 0 where the number does not matter.
  using Counts = std::map<std::pair<int, std::size_t>, std::size_t>;

  void convert(std::size_t index, int type, std::span<const NodeId> nodes, CellKind kind,
               std::span<const std::uint8_t> permutation);
  bool takes_true_kind(const TrueCell& found);
  void add_true_kind(std::size_t index, int type, CellKind kind);
  void finish_cell(std::size_t index, CellKind kind);
  void start_kept();
  [[nodiscard]] std::string listed(const Counts& counts) const;
  [[nodiscard]] std::string listed_unsupported() const;
  void write_notes(std::vector<std::string>& notes) const;

  const ReadOptions& options_;
  std::string subject_;
  TypeName type_name_;
  bool keep_places_ = false;
  ConvertedCells result_;
  TrueKinds true_kinds_;
  std::vector<NodeId> ordered_;
  std::vector<std::uint8_t> places_;
  Counts surfaces_;
  Counts unsupported_;
  Counts reduced_;
  Counts extra_nodes_;
  std::map<std::string, std::size_t> problems_;  ///< unsupported because of their nodes
  std::map<std::string, std::size_t> true_cells_;
  std::function<bool(NodeId, NodeId)> same_place_;
  std::string first_problem_;
  std::string reason_;
  bool any_reducible_ = false;
};

/// The conversion of such a cell, in the words of an inventory: "tetrahedron4", "dropped (no
/// volume)", "unsupported". `nodes` are in the file's order.
std::string fate_of(const CellConversion& conversion, std::span<const NodeId> nodes,
                    TrueKinds& true_kinds);

}  // namespace hiac::formats
