#include "formats/common/mesh/merge_pieces.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include <fmt/format.h>

#include "hiac/base/error.hpp"

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

bool equal_values(const ZooMesh& mesh, NodeId a, NodeId b) {
  for (const Field& field : mesh.fields) {
    if (field.location != FieldLocation::node) continue;
    const std::size_t width = field.components;
    for (std::size_t c = 0; c < width; ++c)
      if (std::bit_cast<std::uint64_t>(field.values[a * width + c]) !=
          std::bit_cast<std::uint64_t>(field.values[b * width + c]))
        return false;
  }
  return true;
}

/// For every node its representative, which for most nodes is the node itself.
std::vector<NodeId> representatives(const ZooMesh& mesh, const std::vector<std::size_t>& offsets) {
  std::vector<NodeId> result(mesh.node_count());
  std::iota(result.begin(), result.end(), NodeId{0});
  std::vector<NodeId> order = result;
  const auto compare = [&](NodeId a, NodeId b) {
    const auto p = mesh.position(a);
    const auto q = mesh.position(b);
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::stable_sort(order.begin(), order.end(), compare);
  const auto piece_of = [&](NodeId node) {
    return std::upper_bound(offsets.begin(), offsets.end(), node) - offsets.begin();
  };
  for (auto begin = order.begin(); begin != order.end();) {
    auto end = begin + 1;
    while (end != order.end() && !compare(*begin, *end)) ++end;
    // node numbers ascend, so two nodes of one piece are neighbours here
    const bool unique = std::adjacent_find(begin, end, [&](NodeId a, NodeId b) {
                          return piece_of(a) == piece_of(b);
                        }) == end;
    for (auto other = begin + 1; unique && other != end; ++other)
      if (equal_values(mesh, *begin, *other)) result[*other] = *begin;
    begin = end;
  }
  return result;
}

std::vector<double> compacted(std::span<const double> values, std::size_t width,
                              const std::vector<NodeId>& kept) {
  std::vector<double> result;
  result.reserve(kept.size() * width);
  for (const NodeId node : kept)
    for (std::size_t c = 0; c < width; ++c) result.push_back(values[node * width + c]);
  return result;
}

/// Merges the nodes that share a place; returns how many were removed.
std::size_t merge_border_nodes(ZooMesh& mesh, const std::vector<std::size_t>& offsets) {
  std::vector<NodeId> number = representatives(mesh, offsets);
  std::vector<NodeId> kept;
  for (NodeId node = 0; node < number.size(); ++node) {
    // a representative precedes the nodes that it represents
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

Reading merge_pieces(std::vector<Reading>&& pieces, const std::string& subject) {
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
  if (const std::size_t gone = merge_border_nodes(mesh, offsets); gone > 0)
    result.notes.push_back(
        fmt::format("joined the pieces at {} nodes that they had in common", gone));
  return result;
}

void add_piece(Inventory& all, const Inventory& piece) {
  all.points += piece.points;
  add_cells(all, piece);
  add_fields(all, piece);
  if (all.times.empty()) all.times = piece.times;
}

}  // namespace hiac::formats
