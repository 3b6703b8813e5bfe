#include "hiac/tetrahedralize/face_diagonals.hpp"

#include <algorithm>
#include <cstdint>

#include "hiac/base/collect.hpp"
#include "hiac/mesh/face_adjacency.hpp"
#include "hiac/tetrahedralize/chosen_cut.hpp"

namespace hiac {
namespace {

constexpr std::size_t kFaceDiagonalsGrain = 1 << 12;
// Limits the search for one bad cell, in cells; chains of changes are rarely longer than a few.
constexpr std::size_t kMostAsked = 2000;

bool is_sound(const ZooMesh& mesh, CellId cell, OtherDiagonals other) {
  return shape_of(mesh.kinds[cell]) == CellShape::tetrahedron ||
         choose_cut(mesh, cell, other).bad().first == 0;
}

class Mender {
 public:
  explicit Mender(const ZooMesh& mesh)
      : mesh_(mesh), adjacency_(build_face_adjacency(mesh)), other_(mesh.cell_count()) {
    first_face_.reserve(mesh.cell_count());
    std::uint64_t next = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
      first_face_.push_back(next);
      next += face_count(mesh.kinds[cell]);
    }
  }

  void mend(CellId cell) {
    asked_ = 0;
    (void)mend_behind(cell, kNoFace);  // a cell that cannot be repaired stays as it is
  }

  [[nodiscard]] std::vector<OtherDiagonals> diagonals() && { return std::move(other_); }

 private:
  static constexpr std::size_t kNoFace = 6;

  // Makes a cell sound by changing a face's diagonal, except that of the face through which the
  // chain of changes arrived. If that fails, everything is restored.
  [[nodiscard]] bool mend_behind(CellId cell, std::size_t came) {
    if (is_sound(mesh_, cell, other_[cell])) return true;
    for (std::size_t f = 0; f < face_count(mesh_.kinds[cell]); ++f) {
      if (f == came || topology_of(mesh_.kinds[cell]).faces[f].corner_count != 4) continue;
      if (++asked_ > kMostAsked) return false;
      const CellId neighbor = adjacency_.neighbors[first_face_[cell] + f];
      const std::size_t its_face = neighbor == kNoCell ? kNoFace : face_towards(neighbor, cell, f);
      change(cell, f, neighbor, its_face);
      if (is_sound(mesh_, cell, other_[cell]) &&
          (neighbor == kNoCell || mend_behind(neighbor, its_face)))
        return true;
      change(cell, f, neighbor, its_face);
    }
    return false;
  }

  void change(CellId cell, std::size_t face, CellId neighbor, std::size_t its_face) {
    other_[cell].flip(face);
    if (neighbor != kNoCell) other_[neighbor].flip(its_face);
  }

  // Returns the number within `neighbor` of face f of `cell`.
  [[nodiscard]] std::size_t face_towards(CellId neighbor, CellId cell, std::size_t f) const {
    const auto nodes_of = [&](CellId c, std::size_t number) {
      std::array<NodeId, 4> nodes{};
      const ShapeFace& face = topology_of(mesh_.kinds[c]).faces[number];
      for (std::size_t k = 0; k < face.corner_count; ++k)
        nodes[k] = mesh_.cell_nodes(c)[face.corners[k]];
      return nodes;
    };
    const auto wanted = nodes_of(cell, f);
    std::size_t g = 0;
    while (adjacency_.neighbors[first_face_[neighbor] + g] != cell ||
           !std::ranges::is_permutation(nodes_of(neighbor, g), wanted))
      ++g;
    return g;
  }

  const ZooMesh& mesh_;
  FaceAdjacency adjacency_;
  std::vector<std::uint64_t> first_face_;
  std::vector<OtherDiagonals> other_;
  std::size_t asked_ = 0;
};

}  // namespace

std::vector<OtherDiagonals> choose_diagonals(const ZooMesh& mesh) {
  const auto bad =
      collect<CellId>(mesh.cell_count(), kFaceDiagonalsGrain, [&](std::size_t i, auto& found) {
        const auto cell = static_cast<CellId>(i);
        if (!is_sound(mesh, cell, {})) found.push_back(cell);
      });
  if (bad.empty()) return {};
  Mender mender(mesh);
  for (const CellId cell : bad) mender.mend(cell);
  return std::move(mender).diagonals();
}

}  // namespace hiac
