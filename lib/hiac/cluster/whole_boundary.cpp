#include "hiac/cluster/whole_boundary.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/chosen_rank.hpp"
#include "hiac/mesh/cell_kind.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/mesh/parted/whole_corners.hpp"

namespace hiac {
namespace {

// A face in the whole mesh: its corners, ascending (whole_corners), then the part that tells of it.
using FaceRecord = std::array<std::uint64_t, 5>;
using FaceKey = std::array<std::uint64_t, 4>;

FaceKey record_key(const FaceRecord& record) {
  return {record[0], record[1], record[2], record[3]};
}

// A face that is told of: the place of its part, and its place there.
struct ToldFace {
  std::size_t part;
  CellId cell;
  std::uint8_t face;
  bool matched;  // in the part
};

template <typename Visit>
void for_each_face(const ZooMesh& mesh, const FaceAdjacency& adjacency, const Visit& visit) {
  std::uint64_t at = 0;
  for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
    const auto faces = topology_of(mesh.kinds[cell]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      visit(cell, static_cast<std::uint8_t>(f), faces[f], adjacency.neighbors[at++] != kNoCell);
  }
}

// Calls tell(face, corners) for the faces of a part that cells of other parts may have, too.
template <typename Tell>
void tell_faces(const NumberedPart& part, std::size_t place, const Tell& tell) {
  const ZooMesh& mesh = part.mesh;
  std::optional<FaceAdjacency> built;
  if (!mesh.adjacency) built = build_face_adjacency(mesh);
  const FaceAdjacency& adjacency = mesh.adjacency ? *mesh.adjacency : *built;
  const std::vector<bool> on_boundary = nodes_on_boundary(mesh);
  for_each_face(mesh, adjacency,
                [&](CellId cell, std::uint8_t f, const ShapeFace& face, bool matched) {
                  for (std::size_t k = 0; k < face.corner_count; ++k)
                    if (!on_boundary[mesh.cell_nodes(cell)[face.corners[k]]]) return;
                  FaceKey key = whole_corners(mesh, part.global_nodes, cell, f);
                  std::ranges::sort(key);
                  tell(ToldFace{place, cell, f, matched},
                       FaceRecord{key[0], key[1], key[2], key[3], part.number});
                });
}

// For every record of every sender, in their order, how the face is in the whole mesh.
enum class Fate : std::uint8_t {
  as_in_part,  // no other part has it
  shared,      // with one cell of another part
  boundary     // with several
};

std::vector<std::vector<std::uint8_t>> judged(
    const std::vector<std::vector<FaceRecord>>& received) {
  struct Entry {
    FaceRecord record;
    std::size_t sender, place;
  };
  std::vector<Entry> entries;
  std::vector<std::vector<std::uint8_t>> fates;
  for (std::size_t sender = 0; sender < received.size(); ++sender) {
    fates.emplace_back(received[sender].size());
    for (std::size_t place = 0; place < received[sender].size(); ++place)
      entries.push_back({received[sender][place], sender, place});
  }
  std::ranges::sort(entries, {}, &Entry::record);
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    while (end < entries.size() &&
           record_key(entries[end].record) == record_key(entries[begin].record))
      ++end;
    const bool one_part = entries[begin].record[4] == entries[end - 1].record[4];
    const Fate fate = one_part           ? Fate::as_in_part
                      : end - begin == 2 ? Fate::shared
                                         : Fate::boundary;
    for (std::size_t k = begin; k < end; ++k)
      fates[entries[k].sender][entries[k].place] = static_cast<std::uint8_t>(fate);
  }
  return fates;
}

bool is_boundary(Fate fate, bool matched_in_part) {
  return fate == Fate::as_in_part ? !matched_in_part : fate == Fate::boundary;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> whole_boundary(Communicator& all,
                                                      std::span<const NumberedPart> own) {
  std::vector<std::vector<std::uint8_t>> boundary;
  std::vector<std::vector<ToldFace>> told(all.size());  // to each rank
  std::vector<Bytes> to(all.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    boundary.emplace_back(own[k].mesh.cell_count());
    tell_faces(own[k], k, [&](const ToldFace& face, const FaceRecord& record) {
      const std::uint32_t rank = chosen_rank(record_key(record), all.size());
      told[rank].push_back(face);
      ByteWriter(to[rank]).put(record);
    });
  }
  std::vector<std::vector<FaceRecord>> records;
  for (const Bytes& bytes : all.exchange(std::move(to)))
    records.push_back(ByteReader(bytes).get_all<FaceRecord>(bytes.size() / sizeof(FaceRecord)));
  std::vector<Bytes> answers(all.size());
  const std::vector<std::vector<std::uint8_t>> fates = judged(records);
  for (std::size_t rank = 0; rank < fates.size(); ++rank)
    ByteWriter(answers[rank]).put_all(std::span<const std::uint8_t>(fates[rank]));
  const std::vector<Bytes> answered = all.exchange(std::move(answers));
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    ByteReader from(answered[rank]);
    for (const ToldFace& face : told[rank])
      if (is_boundary(static_cast<Fate>(from.get<std::uint8_t>()), face.matched))
        boundary[face.part][face.cell] |= static_cast<std::uint8_t>(1U << face.face);
  }
  return boundary;
}

}  // namespace hiac
