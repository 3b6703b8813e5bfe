#include "hiac/cluster/whole_edges.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/chosen_rank.hpp"
#include "hiac/render/edges/chosen_edges.hpp"

namespace hiac {
namespace {

// A side of an edge as one process tells it to another.
struct ToldSide {
  std::array<std::uint64_t, 2> ends;  // in the whole mesh
  std::uint32_t part;
  EdgeSide side;  // its nodes do not count
  std::size_t sender, place;
};

void put_side(ByteWriter& to, const NumberedPart& part, const EdgeSide& side) {
  const auto [low, high] = ends_of(side.edge);
  to.put(part.global_nodes[low]);
  to.put(part.global_nodes[high]);
  to.put(part.number);
  to.put(static_cast<std::uint8_t>(side.ascending));
  to.put_all(std::span<const double>(side.normal));
}

ToldSide get_side(ByteReader& from, std::size_t sender, std::size_t place) {
  ToldSide told{};
  told.sender = sender;
  told.place = place;
  for (std::uint64_t& end : told.ends) end = from.get<std::uint64_t>();
  told.part = from.get<std::uint32_t>();
  told.side.ascending = from.get<std::uint8_t>() != 0;
  for (double& x : told.side.normal) x = from.get<double>();
  return told;
}

// The sides of the edges of a part that the scene may draw. Where all edges are drawn, each is
// there once, and has no face.
std::vector<EdgeSide> sides_of(const NumberedPart& part, const Edges& wanted,
                               std::span<const std::uint8_t> boundary) {
  if (wanted.show != EdgeChoice::all) return boundary_sides(part.mesh, boundary);
  std::vector<EdgeSide> sides;
  for (const EdgeNodes& edge : all_edges(part.mesh)) sides.push_back({edge, {}, false});
  return sides;
}

// For every side that was told, by sender, whether its part draws the edge.
std::vector<Bytes> judged(const std::vector<Bytes>& received, const Edges& wanted) {
  std::vector<ToldSide> sides;
  std::vector<Bytes> answers;
  for (std::size_t sender = 0; sender < received.size(); ++sender) {
    std::size_t place = 0;
    for (ByteReader from(received[sender]); !from.at_end(); ++place)
      sides.push_back(get_side(from, sender, place));
    answers.emplace_back(place, std::byte{0});
  }
  std::ranges::sort(
      sides, {}, [](const ToldSide& s) { return std::tuple(s.ends, s.part, s.sender, s.place); });
  const double cosine = cosine_of(wanted);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    std::vector<EdgeSide> around;
    for (; end < sides.size() && sides[end].ends == sides[begin].ends; ++end)
      around.push_back(sides[end].side);
    if (wanted.show != EdgeChoice::feature || is_feature(around, cosine))
      answers[sides[begin].sender][sides[begin].place] = std::byte{1};
  }
  return answers;
}

}  // namespace

std::vector<std::vector<EdgeNodes>> whole_edges(
    Communicator& all, std::span<const NumberedPart> own, const Edges& wanted,
    std::span<const std::vector<std::uint8_t>> boundary) {
  std::vector<std::vector<EdgeSide>> sides;
  std::vector<std::vector<bool>> drawn;
  std::vector<Bytes> to(all.size());
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> told(all.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    sides.push_back(sides_of(own[k], wanted, boundary[k]));
    // an edge inside a part is drawn without asking
    drawn.emplace_back(sides[k].size(), true);
    const std::vector<bool> maybe_shared = nodes_on_boundary(own[k].mesh);
    for (std::size_t s = 0; s < sides[k].size(); ++s) {
      const auto [low, high] = ends_of(sides[k][s].edge);
      if (!maybe_shared[low] || !maybe_shared[high]) continue;
      const std::array ends{own[k].global_nodes[low], own[k].global_nodes[high]};
      const std::uint32_t rank = chosen_rank(ends, all.size());
      told[rank].emplace_back(k, s);
      ByteWriter message(to[rank]);
      put_side(message, own[k], sides[k][s]);
    }
  }
  const std::vector<Bytes> answered = all.exchange(judged(all.exchange(std::move(to)), wanted));
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    ByteReader from(answered[rank]);
    for (const auto& [part, side] : told[rank]) drawn[part][side] = from.get<std::uint8_t>() != 0;
  }
  std::vector<std::vector<EdgeNodes>> edges(own.size());
  for (std::size_t k = 0; k < own.size(); ++k)
    for (std::size_t s = 0; s < sides[k].size(); ++s)
      if (drawn[k][s]) edges[k].push_back(sides[k][s].edge);
  return edges;
}

}  // namespace hiac
