#include "hiac/mesh/face_adjacency.hpp"

#include <algorithm>
#include <array>
#include <atomic>

#include "hiac/base/parallel.hpp"

namespace hiac {
namespace {

constexpr std::size_t kCellGrain = 1 << 14;
constexpr std::size_t kNodeGrain = 1 << 12;

/// A face's conventional nodes in ascending order; a triangle's last entry is kNoFourth, which no
/// quadrilateral has.
using FaceKey = std::array<std::uint64_t, 4>;
constexpr std::uint64_t kNoFourth = ~std::uint64_t{0};

FaceKey key_of(const ShapeFace& face, std::span<const NodeId> nodes) {
  FaceKey key{nodes[face.corners[0]], nodes[face.corners[1]], nodes[face.corners[2]],
              face.corner_count == 4 ? nodes[face.corners[3]] : kNoFourth};
  // a sorting network for four entries; kNoFourth ends up last
  const auto order = [&](std::size_t i, std::size_t j) {
    const std::uint64_t low = std::min(key[i], key[j]);
    key[j] = std::max(key[i], key[j]);
    key[i] = low;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return key;
}

/// A face in a bucket, packed into 64 bits so that sorting a bucket makes equal faces adjacent: the
/// fingerprint of the key's last three nodes (29 bits), the cell (32), its face (3).
using Entry = std::uint64_t;

Entry entry_of(const FaceKey& key, CellId cell, std::size_t face) {
  constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio
  std::uint64_t hash = (key[1] + 1) * kMix;
  hash = (hash ^ (hash >> 32) ^ key[2]) * kMix;
  hash = (hash ^ (hash >> 32) ^ key[3]) * kMix;
  return (hash >> 35 << 35) | (std::uint64_t{cell} << 3) | face;
}
std::uint64_t fingerprint_of(Entry entry) { return entry >> 35; }
CellId cell_of(Entry entry) { return static_cast<CellId>(entry >> 3); }
std::size_t face_of(Entry entry) { return entry & 7; }

FaceKey key_of(const ZooMesh& mesh, Entry entry) {
  const CellId cell = cell_of(entry);
  return key_of(topology_of(mesh.kinds[cell]).faces[face_of(entry)], mesh.cell_nodes(cell));
}

/// Calls visit(key, cell, face) for every face of the mesh, in parallel.
template <typename Visit>
void for_each_face(const ZooMesh& mesh, const Visit& visit) {
  parallel_for(mesh.cell_count(), kCellGrain, [&](IndexRange range) {
    for (std::size_t cell = range.begin; cell < range.end; ++cell) {
      const auto id = static_cast<CellId>(cell);
      const auto nodes = mesh.cell_nodes(id);
      const auto faces = topology_of(mesh.kinds[cell]).faces;
      for (std::size_t face = 0; face < faces.size(); ++face)
        visit(key_of(faces[face], nodes), id, face);
    }
  });
}

/// All faces, in the buckets of their smallest nodes, by a counting sort. Bucket n ends at ends[n]
/// and begins where bucket n - 1 ends.
struct Buckets {
  std::vector<Entry> entries;
  std::vector<std::uint64_t> ends;

  std::span<Entry> operator[](std::size_t node) {
    const std::uint64_t begin = node == 0 ? 0 : ends[node - 1];
    return std::span(entries).subspan(begin, ends[node] - begin);
  }
};

Buckets fill_buckets(const ZooMesh& mesh, std::uint64_t faces) {
  Buckets buckets{std::vector<Entry>(faces), std::vector<std::uint64_t>(mesh.node_count())};
  for_each_face(mesh, [&](const FaceKey& key, CellId, std::size_t) {
    std::atomic_ref(buckets.ends[key[0]]).fetch_add(1, std::memory_order_relaxed);
  });
  std::uint64_t begin = 0;
  for (std::uint64_t& end : buckets.ends) begin += std::exchange(end, begin);
  for_each_face(mesh, [&](const FaceKey& key, CellId cell, std::size_t face) {
    const std::uint64_t place =
        std::atomic_ref(buckets.ends[key[0]]).fetch_add(1, std::memory_order_relaxed);
    buckets.entries[place] = entry_of(key, cell, face);
  });
  return buckets;
}

/// Matches the faces of one bucket and stores the neighbours.
class BucketMatcher {
 public:
  BucketMatcher(const ZooMesh& mesh, std::span<const std::uint64_t> offsets,
                std::span<CellId> neighbors)
      : mesh_(mesh), offsets_(offsets), neighbors_(neighbors) {}

  /// Returns the number of overshared faces.
  std::uint64_t match(std::span<Entry> bucket) {
    std::uint64_t overshared = 0;
    std::ranges::sort(bucket);
    for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
      end = begin + 1;
      while (end < bucket.size() && fingerprint_of(bucket[end]) == fingerprint_of(bucket[begin]))
        ++end;
      overshared += match_alike(bucket.subspan(begin, end - begin));
    }
    return overshared;
  }

 private:
  /// Matches entries with the same fingerprint: nearly always one face, or the two sides of one.
  std::uint64_t match_alike(std::span<const Entry> alike) {
    if (alike.size() == 1) return 0;
    if (alike.size() == 2) {
      if (key_of(mesh_, alike[0]) == key_of(mesh_, alike[1])) pair(alike[0], alike[1]);
      return 0;
    }
    keyed_.clear();
    for (const Entry entry : alike) keyed_.emplace_back(key_of(mesh_, entry), entry);
    std::ranges::sort(keyed_);
    std::uint64_t overshared = 0;
    for (std::size_t begin = 0, end = 0; begin < keyed_.size(); begin = end) {
      end = begin + 1;
      while (end < keyed_.size() && keyed_[end].first == keyed_[begin].first) ++end;
      if (end - begin == 2) pair(keyed_[begin].second, keyed_[begin + 1].second);
      if (end - begin > 2) ++overshared;
    }
    return overshared;
  }

  void pair(Entry a, Entry b) {
    // a cell that is folded onto itself has no neighbour there
    if (cell_of(a) == cell_of(b)) return;
    neighbors_[offsets_[cell_of(a)] + face_of(a)] = cell_of(b);
    neighbors_[offsets_[cell_of(b)] + face_of(b)] = cell_of(a);
  }

  const ZooMesh& mesh_;
  std::span<const std::uint64_t> offsets_;
  std::span<CellId> neighbors_;
  std::vector<std::pair<FaceKey, Entry>> keyed_;
};

}  // namespace

FaceAdjacency build_face_adjacency(const ZooMesh& mesh) {
  const std::vector<std::uint64_t> offsets = face_offsets(mesh);
  std::vector<CellId> neighbors(offsets.back(), kNoCell);
  Buckets buckets = fill_buckets(mesh, offsets.back());
  std::atomic<std::uint64_t> overshared = 0;
  parallel_for(mesh.node_count(), kNodeGrain, [&](IndexRange range) {
    BucketMatcher matcher(mesh, offsets, neighbors);
    std::uint64_t found = 0;
    for (std::size_t node = range.begin; node < range.end; ++node)
      found += matcher.match(buckets[node]);
    overshared.fetch_add(found, std::memory_order_relaxed);
  });
  return {SharedArray<CellId>(std::move(neighbors)), overshared};
}

}  // namespace hiac
