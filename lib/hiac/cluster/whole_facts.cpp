#include "hiac/cluster/whole_facts.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "hiac/base/error.hpp"
#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/whole_boundary.hpp"
#include "hiac/cluster/whole_edges.hpp"

namespace hiac {
namespace {

// A touched face in the whole mesh: the surface and the nodes, ascending.
using TouchedKey = std::array<std::uint64_t, 5>;

TouchedKey touched_key(const TouchedFace& face, std::span<const std::uint64_t> global_nodes) {
  TouchedKey key{face.surface};
  for (std::size_t k = 0; k < face.nodes.size(); ++k)
    key[k + 1] = face.nodes[k] < global_nodes.size() ? global_nodes[face.nodes[k]]
                                                     : std::numeric_limits<std::uint64_t>::max();
  std::ranges::sort(key.begin() + 1, key.end());
  return key;
}

void share_extremes(Communicator& all, std::span<const NumberedEngine> own) {
  Bytes mine;
  ByteWriter message(mine);
  for (const NumberedEngine& part : own) {
    const MeshExtremes e = part.engine.extremes();
    for (const double value : {e.nearest, e.farthest, e.largest_color, e.largest_extinction})
      message.put(value);
  }
  MeshExtremes whole;
  for (const Bytes& received : all_gather(all, mine))
    for (ByteReader from(received); !from.at_end();) {
      const auto e = from.get_all<double>(4);
      whole.add({e[0], e[1], e[2], e[3]});
    }
  for (const NumberedEngine& part : own) part.engine.set_whole(whole);
}

// Closes the faces that surfaces touch from both sides, each in another part.
void share_touched_faces(Communicator& all, std::span<const NumberedEngine> own) {
  Bytes mine;
  ByteWriter message(mine);
  std::vector<std::vector<TouchedFace>> touched;
  for (const NumberedEngine& part : own) {
    touched.push_back(part.engine.touched_faces());
    for (const TouchedFace& face : touched.back())
      for (const std::uint64_t number : touched_key(face, part.global_nodes)) message.put(number);
  }
  std::vector<TouchedKey> keys;
  for (const Bytes& received : all_gather(all, mine))
    for (ByteReader from(received); !from.at_end();) keys.push_back(from.get<TouchedKey>());
  std::ranges::sort(keys);
  for (std::size_t k = 0; k < own.size(); ++k) {
    std::erase_if(touched[k], [&](const TouchedFace& face) {
      return std::ranges::equal_range(keys, touched_key(face, own[k].global_nodes)).size() < 2;
    });
    own[k].engine.close_faces(touched[k]);
  }
}

void share_boundary(Communicator& all, std::span<const NumberedEngine> own, const Scene& scene) {
  std::vector<NumberedPart> parts;
  for (const NumberedEngine& part : own)
    parts.push_back({part.number, part.engine.mesh(), part.global_nodes});
  std::vector<std::vector<std::uint8_t>> boundary = whole_boundary(all, parts);
  if (scene.skin)
    for (std::size_t k = 0; k < own.size(); ++k) own[k].engine.set_skin(boundary[k]);
  if (!scene.edges) return;
  const auto edges = whole_edges(all, parts, *scene.edges, boundary);
  for (std::size_t k = 0; k < own.size(); ++k)
    own[k].engine.set_edges(edges[k], std::move(boundary[k]), own[k].global_nodes);
}

MergeConstants share_constants(Communicator& all, std::span<const NumberedEngine> own) {
  Bytes mine;
  ByteWriter message(mine);
  if (!own.empty()) {
    const MergeConstants c = own.front().engine.constants();
    message.put(c.least_transparency);
    message.put(c.witness_tolerance);
    message.put(c.largest_light);
    message.put(static_cast<std::uint8_t>(c.with_details));
  }
  for (const Bytes& received : all_gather(all, mine)) {
    if (received.empty()) continue;
    ByteReader from(received);
    const auto numbers = from.get_all<double>(3);
    return {numbers[0], numbers[1], numbers[2], from.get<std::uint8_t>() != 0};
  }
  throw InputError("a mesh in parts has no part");
}

}  // namespace

MergeConstants share_whole_facts(Communicator& all, std::span<const NumberedEngine> own,
                                 const Scene& scene) {
  if (scene.skin || scene.edges) share_boundary(all, own, scene);
  share_extremes(all, own);
  share_touched_faces(all, own);
  return share_constants(all, own);
}

}  // namespace hiac
