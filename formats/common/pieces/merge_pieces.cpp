#include "formats/common/pieces/merge_pieces.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "formats/common/pieces/common_nodes.hpp"
#include "hiac/base/error.hpp"
#include "hiac/mesh/parts/keep_cells.hpp"

namespace hiac::formats {
namespace {

/// Concatenates one array of all pieces and releases the pieces' own arrays.
template <typename T, typename Member>
std::vector<T> joined(std::vector<Reading>& pieces, const Member& member) {
  std::size_t total = 0;
  for (Reading& piece : pieces) total += member(piece.mesh).size();
  std::vector<T> all;
  all.reserve(total);
  for (Reading& piece : pieces) {
    SharedArray<T>& part = member(piece.mesh);
    all.insert(all.end(), part.begin(), part.end());
    part = {};
  }
  return all;
}

/// Index of the first node of every piece, followed by the number of nodes.
std::vector<std::size_t> node_offsets(const std::vector<Reading>& pieces) {
  std::vector<std::size_t> offsets{0};
  for (const Reading& piece : pieces) offsets.push_back(offsets.back() + piece.mesh.node_count());
  return offsets;
}

void require_same_fields(const ZooMesh& first, const ZooMesh& other, const std::string& subject) {
  const auto same = [](const Field& a, const Field& b) {
    return a.name == b.name && a.location == b.location && a.components == b.components;
  };
  if (!std::equal(first.fields.begin(), first.fields.end(), other.fields.begin(),
                  other.fields.end(), same))
    throw InputError(subject, "its pieces do not carry the same fields");
}

std::vector<double> compacted(std::span<const double> values, std::size_t width,
                              const std::vector<NodeId>& kept) {
  std::vector<double> result;
  result.reserve(kept.size() * width);
  for (const NodeId node : kept)
    for (std::size_t c = 0; c < width; ++c) result.push_back(values[node * width + c]);
  return result;
}

/// Merges the nodes that are one (CommonNodes::first); returns how many were removed.
std::size_t merge_nodes(ZooMesh& mesh, std::vector<NodeId> number) {
  std::vector<NodeId> kept;
  for (NodeId node = 0; node < number.size(); ++node) {
    // the first one precedes the others
    if (number[node] == node) {
      number[node] = static_cast<NodeId>(kept.size());
      kept.push_back(node);
    } else {
      number[node] = number[number[node]];
    }
  }
  const std::size_t gone = number.size() - kept.size();
  if (gone == 0) return 0;
  std::vector<NodeId> nodes(mesh.nodes.begin(), mesh.nodes.end());
  for (NodeId& node : nodes) node = number[node];
  mesh.nodes = std::move(nodes);
  for (Field& field : mesh.fields)
    if (field.location == FieldLocation::node)
      field.values = compacted(field.values.view(), field.components, kept);
  mesh.xyz = compacted(mesh.xyz.view(), 3, kept);
  return gone;
}

/// For every node whether cells of several pieces have it.
std::vector<bool> nodes_of_several_pieces(const ZooMesh& mesh,
                                          std::span<const std::size_t> piece_ends) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> piece_of(mesh.node_count(), kNone);
  std::vector<bool> several(mesh.node_count(), false);
  std::uint32_t piece = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    while (cell == piece_ends[piece]) ++piece;
    for (std::uint64_t entry = mesh.elems[cell]; entry < mesh.elems[cell + 1]; ++entry) {
      std::uint32_t& known = piece_of[mesh.nodes[entry]];
      if (known != kNone && known != piece) several[mesh.nodes[entry]] = true;
      known = piece;
    }
  }
  return several;
}

/// Leaves out the cells that an earlier piece has, too: ghosts that the file does not mark.
void leave_out_copies(ZooMesh& mesh, std::span<const std::size_t> piece_ends,
                      std::vector<std::string>& notes) {
  const auto nodes_of = [&](CellId cell) {
    const auto all = mesh.nodes.view();
    return all.subspan(mesh.elems[cell], mesh.elems[cell + 1] - mesh.elems[cell]);
  };
  std::vector<std::pair<std::vector<NodeId>, CellId>> candidates;
  const std::vector<bool> shared = nodes_of_several_pieces(mesh, piece_ends);
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto nodes = nodes_of(cell);
    if (!std::ranges::all_of(nodes, [&](NodeId node) { return shared[node]; })) continue;
    candidates.emplace_back(std::vector<NodeId>(nodes.begin(), nodes.end()), cell);
    std::ranges::sort(candidates.back().first);
  }
  std::ranges::sort(candidates);
  const auto piece_of = [&](CellId cell) {
    return std::ranges::upper_bound(piece_ends, cell) - piece_ends.begin();
  };
  std::vector<bool> keep(mesh.cell_count(), true);
  for (std::size_t i = 1, first = 0; i < candidates.size(); ++i) {
    if (candidates[i].first != candidates[first].first) first = i;
    if (piece_of(candidates[i].second) != piece_of(candidates[first].second))
      keep[candidates[i].second] = false;
  }
  const auto copies = std::ranges::count(keep, false);
  if (copies == 0) return;
  notes.push_back(
      fmt::format("left out {} cells that an earlier piece has, too (ghost cells)", copies));
  mesh = keep_cells(mesh, keep);
}

void add_cells(Inventory& all, const Inventory& piece) {
  for (const CellCount& cells : piece.cells) {
    const auto known =
        std::find_if(all.cells.begin(), all.cells.end(), [&](const CellCount& other) {
          return other.kind == cells.kind && other.fate == cells.fate;
        });
    if (known == all.cells.end())
      all.cells.push_back(cells);
    else
      known->count += cells.count;
  }
}

void add_fields(Inventory& all, const Inventory& piece) {
  for (const FieldSummary& field : piece.fields) {
    const auto known =
        std::find_if(all.fields.begin(), all.fields.end(), [&](const FieldSummary& other) {
          return other.name == field.name && other.location == field.location;
        });
    if (known == all.fields.end()) {
      all.fields.push_back(field);
      continue;
    }
    known->tuples += field.tuples;
    known->low = std::min(known->low, field.low);
    known->high = std::max(known->high, field.high);
    known->not_finite += field.not_finite;
  }
}

}  // namespace

Reading merge_pieces(std::vector<Reading>&& pieces, const std::string& subject,
                     const std::string& numbers) {
  if (pieces.size() == 1) return std::move(pieces.front());
  Reading result;
  for (Reading& piece : pieces)
    for (std::string& note : piece.notes)
      if (std::find(result.notes.begin(), result.notes.end(), note) == result.notes.end())
        result.notes.push_back(std::move(note));
  std::erase_if(pieces, [](const Reading& piece) { return piece.mesh.cell_count() == 0; });
  if (pieces.empty()) return result;
  for (const Reading& piece : pieces) require_same_fields(pieces.front().mesh, piece.mesh, subject);
  const std::vector<std::size_t> offsets = node_offsets(pieces);
  if (offsets.back() >= kNoCell) throw InputError(subject, "has too many points");

  ZooMesh& mesh = result.mesh;
  std::vector<std::size_t> piece_ends;  // of the pieces' cells
  for (const Reading& piece : pieces)
    piece_ends.push_back(piece.mesh.cell_count() + (piece_ends.empty() ? 0 : piece_ends.back()));
  mesh.metadata = pieces.front().mesh.metadata;
  mesh.kinds = joined<CellKind>(
      pieces, [](ZooMesh & m) -> auto& { return m.kinds; });
  std::vector<std::uint64_t> elems{0};
  elems.reserve(mesh.kinds.size() + 1);
  for (const CellKind kind : mesh.kinds) elems.push_back(elems.back() + node_count(kind));
  mesh.elems = std::move(elems);
  std::vector<std::size_t> ends;
  for (const Reading& piece : pieces)
    ends.push_back(piece.mesh.nodes.size() + (ends.empty() ? 0 : ends.back()));
  std::vector<NodeId> nodes = joined<NodeId>(
      pieces, [](ZooMesh & m) -> auto& { return m.nodes; });
  for (std::size_t i = 0, piece = 0; i < nodes.size(); ++i) {
    while (i == ends[piece]) ++piece;
    nodes[i] += static_cast<NodeId>(offsets[piece]);
  }
  mesh.nodes = std::move(nodes);
  mesh.xyz = joined<double>(
      pieces, [](ZooMesh & m) -> auto& { return m.xyz; });
  for (std::size_t f = 0; f < pieces.front().mesh.fields.size(); ++f) {
    Field field = pieces.front().mesh.fields[f];
    field.values = joined<double>(
        pieces, [f](ZooMesh & m) -> auto& { return m.fields[f].values; });
    mesh.fields.push_back(std::move(field));
  }
  CommonNodes common = common_nodes(mesh, offsets, numbers);
  result.notes.insert(result.notes.end(), common.notes.begin(), common.notes.end());
  const std::size_t gone = merge_nodes(mesh, std::move(common.first));
  if (gone > 0)
    result.notes.push_back(fmt::format(
        "joined the pieces at {} nodes that they had in common, by {}", gone, common.by));
  if (gone > 0) leave_out_copies(mesh, piece_ends, result.notes);
  return result;
}

void add_piece(Inventory& all, const Inventory& piece) {
  all.points += piece.points;
  add_cells(all, piece);
  add_fields(all, piece);
  if (all.times.empty()) all.times = piece.times;
}

}  // namespace hiac::formats
