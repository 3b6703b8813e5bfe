// Slabs of tetrahedra as parts of the rays through them: CellTriangles with kChord.

#include <algorithm>
#include <cmath>

#include "hiac/preview/methods/cell_triangles.hpp"
#include "hiac/preview/methods/transfer_pieces.hpp"

namespace hiac::preview {
namespace {

// Of a field: no end of the range.
constexpr float kAnyField = 1e37F;
constexpr std::array<float, 2> kWhole{-kAnyField, kAnyField};
// Of lengths by fields: more is a field that does not change.
constexpr double kMostRate = 1e30;

}  // namespace

// The outline of the tetrahedron for each slab, the farthest one first.
void CellTriangles::add_chords(const Cell& cell) {
  const IntervalRange common =
      common_intervals(frame_.extinction, cell.id, frame_.mesh.elems[cell.id], cell.nodes);
  if (common.least <= common.most && is_invisible(common.most)) return;
  const ProjectedTetrahedron shape = project_tetrahedron(cell.points, cell.depths);
  if (shape.count == 0) return;
  Chords chords = chords_of(cell, shape);
  if (common.least <= common.most) {
    ++counts_.whole;
    add_chord(chords, common.most, kWhole);
    return;
  }
  const std::vector<double>& upper = frame_.optics.extinction.upper;
  const auto [least, most] = std::ranges::minmax(cell.extinction);
  const std::size_t first = classify_value(least, frame_.optics.extinction).high;
  std::size_t last = first;
  while (last + 1 < upper.size() && upper[last] < most) ++last;
  for (std::size_t n = first; n <= last; ++n) {
    const std::size_t k = chords.falls_away ? n : first + last - n;
    if (is_invisible(k)) continue;
    ++counts_.slabs;
    add_chord(chords, k,
              {k == first ? -kAnyField : static_cast<float>(upper[k - 1] - chords.zero),
               k == last ? kAnyField : static_cast<float>(upper[k] - chords.zero)});
  }
}

bool CellTriangles::is_invisible(std::size_t interval) const {
  const OpticsTables& optics = frame_.optics;
  return optics.no_extinction[interval] != 0 &&
         (!optics.emission || optics.no_color[interval] != 0);
}

CellTriangles::Chords CellTriangles::chords_of(const Cell& cell,
                                               const ProjectedTetrahedron& shape) const {
  Chords chords{.zero = cell.extinction[0],
                .length = static_cast<float>(shape.back_depth - shape.front_depth),
                .shape = shape};
  double front = 0, back = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double field = cell.extinction[k] - chords.zero;
    chords.rim[k] = {cell.points[k].x, cell.points[k].y, {static_cast<float>(field)}};
    front += shape.front[k] * field;
    back += shape.back[k] * field;
  }
  chords.falls_away = back < front;
  const double there = shape.outline_is_front ? front : back,
               beyond = shape.outline_is_front ? back : front;
  const double rate = (shape.back_depth - shape.front_depth) / (beyond - there);
  chords.rate = static_cast<float>(std::isnan(rate) ? 0 : std::clamp(rate, -kMostRate, kMostRate));
  chords.thickest = {shape.at.x, shape.at.y, {static_cast<float>(beyond)}};
  return chords;
}

// Of the part of the tetrahedron that is seen in a triangle of its outline, a tetrahedron with the
// thickest point as a corner: whether the slab has any of it, and the least shares of the
// triangle's corners there.
bool CellTriangles::is_in(const Chords& chords, const std::array<std::uint8_t, 3>& outline,
                          const std::array<float, 2>& range, std::array<double, 3>& least) {
  using Shares = std::array<double, 3>;
  const auto& there = chords.shape.outline_is_front ? chords.shape.front : chords.shape.back;
  std::array<Shares, 4> corners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}};
  std::array<double, 4> field;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[3][k] = there[outline[k]];
    field[k] = chords.rim[outline[k]].values[0];
  }
  field[3] = chords.thickest.values[0];
  bool any = false;
  least = {1, 1, 1};
  const auto visit = [&](const Shares& a, const Shares& b, double share) {
    any = true;
    for (std::size_t k = 0; k < 3; ++k) least[k] = std::min(least[k], a[k] + share * (b[k] - a[k]));
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if (field[i] >= range[0] && field[i] <= range[1]) visit(corners[i], corners[i], 0);
    for (std::size_t j = i + 1; j < 4; ++j)
      for (const double level : range)
        if ((field[i] < level) != (field[j] < level))
          visit(corners[i], corners[j], (level - field[i]) / (field[j] - field[i]));
  }
  return any;
}

// `range`: of the field in the slab, less its zero.
void CellTriangles::add_chord(const Chords& chords, std::size_t interval,
                              const std::array<float, 2>& range) {
  const OpticsTables& optics = frame_.optics;
  std::array<float, kChord.rest> rest{chords.length, chords.rate, range[0], range[1]};
  rest[4] = static_cast<float>(channel(optics.extinction, 0, interval, chords.zero));
  rest[5] = static_cast<float>(optics.extinction.slope[0][interval] / 2);
  for (std::size_t c = 0; c < 3; ++c) {
    rest[6 + c] = static_cast<float>(channel(optics.color, c, interval, chords.zero));
    rest[9 + c] = static_cast<float>(optics.color.slope[c][interval] / 2);
  }
  for (unsigned n = 0; n < chords.shape.outlines; ++n) {
    const auto [a, b, c] = chords.shape.outline[n];
    SlabLimits limits{{}, rest};
    if (range != kWhole && !is_in(chords, chords.shape.outline[n], range, limits.least_shares))
      continue;
    triangles_.add(chords.rim[a], chords.rim[b], chords.rim[c], chords.thickest, limits);
  }
}

}  // namespace hiac::preview
