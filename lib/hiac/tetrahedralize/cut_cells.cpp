#include "hiac/tetrahedralize/cut_cells.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "hiac/geometry/cell_volume.hpp"
#include "hiac/geometry/vector.hpp"
#include "hiac/tetrahedralize/cell_place.hpp"
#include "hiac/tetrahedralize/chosen_cut.hpp"
#include "hiac/tetrahedralize/replacement.hpp"

namespace hiac {
namespace {

class Cutter {
 public:
  explicit Cutter(const ZooMesh& mesh) : mesh_(mesh), cells_(mesh) {}

  void keep(CellId cell) {
    const auto nodes = mesh_.cell_nodes(cell);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      cells_.add_node(nodes[n], [&] { return place_of(cell, static_cast<std::uint8_t>(n)); });
    cells_.finish_cell(cell, mesh_.kinds[cell]);
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
      for (const std::uint8_t corner : t)
        cells_.add_node(node_of(cell, corner), [&] { return place_of(cell, corner); });
      cells_.finish_cell(cell, CellKind::tetrahedron4);
      ++result_.tetrahedra;
    }
  }

  void count_volume(double volume) { result_.volume += std::abs(volume); }

  CutMesh finish() {
    result_.mesh = cells_.finish();
    return std::move(result_);
  }

 private:
  [[nodiscard]] CellPlace place_of(CellId cell, std::uint8_t corner) const {
    return corner == kCellCenter ? center_of(mesh_, cell) : CellPlace{cell, corner, {}};
  }

  // The centre of a cell becomes a node once, at its first tetrahedron.
  NodeId node_of(CellId cell, std::uint8_t corner) {
    if (corner != kCellCenter) return mesh_.cell_nodes(cell)[corner];
    if (centered_ != cell) {
      centered_ = cell;
      center_ = cells_.make_node(center_of(mesh_, cell));
    }
    return center_;
  }

  // The volume of the tetrahedra that turn that way.
  [[nodiscard]] double filled_by(CellId cell, const ChosenCut& cut, int hand) const {
    double sum = 0;
    for (std::size_t k = 0; k < cut.cut.count; ++k)
      if (cut.signs[k] == hand) sum += volume_of(cell, cut.cut.tetrahedra[k]);
    return sum;
  }

  [[nodiscard]] double volume_of(CellId cell, const CornerTetrahedron& t) const {
    std::array<Vector, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = position_of(mesh_, place_of(cell, t[k]));
    return std::abs(dot(minus(at[1], at[0]), cross(minus(at[2], at[0]), minus(at[3], at[0])))) / 6;
  }

  const ZooMesh& mesh_;
  CutMesh result_;
  Replacement cells_;
  CellId centered_ = kNoCell;  // the last cell that got a node in its centre
  NodeId center_ = 0;          // that node
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

}  // namespace hiac
