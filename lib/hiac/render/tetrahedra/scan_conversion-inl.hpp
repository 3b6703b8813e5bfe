// Scan conversion of linear tetrahedra, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_SCAN_CONVERSION_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_SCAN_CONVERSION_INL
#    undef HIAC_RENDER_SCAN_CONVERSION_INL
#  else
#    define HIAC_RENDER_SCAN_CONVERSION_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cstdint>
#  include <span>

#  include <hwy/highway.h>

#  include "hiac/frame/frame.hpp"
#  include "hiac/frame/row_crossing-inl.hpp"
#  include "hiac/frame/tiles/tile.hpp"
#  include "hiac/render/pixels/face_plane-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A projected tetrahedron with its corners in ascending order of node id, so that the results for
// an edge or a face are identical, to the bit, in every cell around it.
struct ProjectedTetrahedron {
  HWY_ALIGN double x[4], y[4], depth[4];
  HWY_ALIGN double color[4], extinction[4];
};

// A tetrahedron's corners as indices into its nodes, by ascending node id.
HWY_INLINE std::array<std::size_t, 4> ascending_corners(const NodeId* nodes) {
  std::array<std::uint64_t, 4> key;
  for (std::size_t k = 0; k < 4; ++k) key[k] = (static_cast<std::uint64_t>(nodes[k]) << 2) | k;
  const auto order = [&](std::size_t i, std::size_t j) {
    const std::uint64_t low = std::min(key[i], key[j]), high = std::max(key[i], key[j]);
    key[i] = low;
    key[j] = high;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return {key[0] & 3, key[1] & 3, key[2] & 3, key[3] & 3};
}

// The faces of a tetrahedron as corner numbers: a base and two others, ascending.
inline constexpr std::array<std::array<int, 3>, 4> kTetrahedronFaces{
    {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
inline constexpr std::array<std::array<int, 2>, 6> kTetrahedronEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// The edges of each face, as indices into kTetrahedronEdges.
inline constexpr std::array<std::array<int, 3>, 4> kTetrahedronFaceEdges{
    {{0, 1, 3}, {0, 2, 4}, {1, 2, 5}, {3, 4, 5}}};

// The planes (face_plane-inl.hpp) of the four faces at once; index: face.
struct FacePlanes {
  HWY_ALIGN double base_x[4], base_y[4];
  HWY_ALIGN double cx[4], cy[4], gx[4], gy[4], h[4];
  struct Quantity {
    HWY_ALIGN double q0[4], qm[4], qs[4];
  };
  Quantity depth, color, extinction;
};

// The pixels that each face covers, row by row: columns first <= x < last.
struct FaceRuns {
  int row_begin, row_end;  // rows of the image
  static constexpr std::size_t kRows = kTileHeight + 16;
  HWY_ALIGN double first[kRows][4], last[kRows][4];
  HWY_ALIGN double span_first[kRows], span_last[kRows];
};

// Finds where rows of pixel centres cross the six edges, and from that the runs of the four faces.
//
// On a row, an edge is crossed when one end lies on or above the row and the other strictly below
// it (y runs down: the centre counts as moved down by an infinitesimal amount); the first centre on
// the crossing or right of it starts or ends a run; a centre that differs from the crossing by
// rounding alone lies on it (row_crossing.hpp).
HWY_INLINE bool scan_faces(const ProjectedTetrahedron& t, const TileRect& tile, FaceRuns& runs) {
  const auto [y_low, y_high] = std::minmax({t.y[0], t.y[1], t.y[2], t.y[3]});
  runs.row_begin = first_center(y_low, tile.y0, tile.y1);
  runs.row_end = first_center(y_high, tile.y0, tile.y1);
  if (runs.row_begin >= runs.row_end) return false;

  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN double slope[8], to_first[8];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kTetrahedronEdges[e];
    slope[e] = edge_slope({t.x[i], t.y[i], 0}, {t.x[j], t.y[j], 0});
    to_first[e] = to_first_pixel(slope[e]);
  }
  const V left = hn::Set(d, tile.x0), right = hn::Set(d, tile.x1);
  const V never_first = hn::Set(d, tile.x1 + 1.0), never_last = hn::Set(d, tile.x0 - 1.0);
  const int rows = runs.row_end - runs.row_begin;
  for (int r = 0; r < rows; r += static_cast<int>(lanes)) {
    const V center = hn::Iota(d, pixel_center(runs.row_begin + r));
    V first[6], last[6];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kTetrahedronEdges[e];
      const auto i_above = hn::Le(hn::Set(d, t.y[i]), center);
      const auto j_above = hn::Le(hn::Set(d, t.y[j]), center);
      const auto crossed = hn::Xor(i_above, j_above);
      const V crossing =
          crossing_x(center, hn::Set(d, t.x[i]), hn::Set(d, t.y[i]), hn::Set(d, slope[e]));
      // clamped to the tile; NaN crossings are not used
      const V column =
          hn::Ceil(hn::Min(hn::Max(hn::Sub(crossing, hn::Set(d, to_first[e])), left), right));
      first[e] = hn::IfThenElse(crossed, column, never_first);
      last[e] = hn::IfThenElse(crossed, column, never_last);
    }
    V span_first = never_first, span_last = never_last;
    V face_first[4], face_last[4];
    for (std::size_t f = 0; f < 4; ++f) {
      const auto [a, b, c] = kTetrahedronFaceEdges[f];
      face_first[f] = hn::Min(hn::Min(first[a], first[b]), first[c]);
      face_last[f] = hn::Max(hn::Max(last[a], last[b]), last[c]);
      span_first = hn::Min(span_first, face_first[f]);
      span_last = hn::Max(span_last, face_last[f]);
    }
    hn::StoreInterleaved4(face_first[0], face_first[1], face_first[2], face_first[3], d,
                          runs.first[r]);
    hn::StoreInterleaved4(face_last[0], face_last[1], face_last[2], face_last[3], d, runs.last[r]);
    hn::StoreU(span_first, d, runs.span_first + r);
    hn::StoreU(span_last, d, runs.span_last + r);
  }
  return true;
}

// Fills one quantity of the face planes from its values at the corners.
template <class D, class M>
HWY_INLINE void set_quantity(D d, const double* corner, std::size_t f, M swapped,
                             FacePlanes::Quantity& quantity) {
  HWY_ALIGN double base[4], one[4], two[4];
  for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
    base[k] = corner[kTetrahedronFaces[f + k][0]];
    one[k] = corner[kTetrahedronFaces[f + k][1]];
    two[k] = corner[kTetrahedronFaces[f + k][2]];
  }
  const auto q0 = hn::Load(d, base);
  const auto q1 = hn::Sub(hn::Load(d, one), q0), q2 = hn::Sub(hn::Load(d, two), q0);
  hn::Store(q0, d, quantity.q0 + f);
  hn::Store(hn::IfThenElse(swapped, q2, q1), d, quantity.qm + f);
  hn::Store(hn::IfThenElse(swapped, q1, q2), d, quantity.qs + f);
}

// The base corners of the faces from f on, and their edges from the base.
template <class D, class V = hn::Vec<D>>
struct FaceEdges {
  V base_x, base_y, x1, y1, x2, y2;
  HWY_INLINE hn::Mask<D> swapped() const { return is_second_longer(x1, y1, x2, y2); }
};

template <class D>
HWY_INLINE FaceEdges<D> face_edges(D d, const ProjectedTetrahedron& t, std::size_t f) {
  HWY_ALIGN double corner[6][4];
  for (std::size_t k = 0; k < hn::Lanes(d); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      corner[2 * c][k] = t.x[kTetrahedronFaces[f + k][c]];
      corner[2 * c + 1][k] = t.y[kTetrahedronFaces[f + k][c]];
    }
  const auto base_x = hn::Load(d, corner[0]), base_y = hn::Load(d, corner[1]);
  const auto x1 = hn::Sub(hn::Load(d, corner[2]), base_x);
  const auto y1 = hn::Sub(hn::Load(d, corner[3]), base_y);
  const auto x2 = hn::Sub(hn::Load(d, corner[4]), base_x);
  const auto y2 = hn::Sub(hn::Load(d, corner[5]), base_y);
  return {base_x, base_y, x1, y1, x2, y2};
}

HWY_INLINE void set_face_planes(const ProjectedTetrahedron& t, bool with_color,
                                FacePlanes& planes) {
  const hn::CappedTag<double, 4> d;
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d)) {
    const auto [base_x, base_y, x1, y1, x2, y2] = face_edges(d, t, f);
    const auto plane = face_plane(d, x1, y1, x2, y2);
    hn::Store(base_x, d, planes.base_x + f);
    hn::Store(base_y, d, planes.base_y + f);
    hn::Store(plane.cx, d, planes.cx + f);
    hn::Store(plane.cy, d, planes.cy + f);
    hn::Store(plane.gx, d, planes.gx + f);
    hn::Store(plane.gy, d, planes.gy + f);
    hn::Store(plane.h, d, planes.h + f);
    set_quantity(d, t.depth, f, plane.swapped, planes.depth);
    set_quantity(d, t.extinction, f, plane.swapped, planes.extinction);
    if (with_color) set_quantity(d, t.color, f, plane.swapped, planes.color);
  }
}

// The faces by which rays enter, the first `entered` entries of `face`, and those by which they
// leave, the others.
struct FaceSides {
  std::array<std::size_t, 4> face;
  std::size_t entered;
};

// Finds by which faces rays enter. On the screen the corners p_k have one affine dependency, sum
// lambda_k p_k = 0 with sum lambda_k = 0; |lambda_k| is twice the area of the face without corner
// k. With D = sum lambda_k depth_k that corner is D / lambda_k behind that face. Every area is
// large enough that rounding does not change its sign (kernel_cells.hpp). If rounding may change
// the sign of D, the cell is flat, and entry and exit coincide.
HWY_INLINE FaceSides face_sides(const ProjectedTetrahedron& t) {
  const auto dx = [&](std::size_t k) { return t.x[k] - t.x[0]; };
  const auto dy = [&](std::size_t k) { return t.y[k] - t.y[0]; };
  const auto area = [&](std::size_t i, std::size_t j) { return dx(i) * dy(j) - dx(j) * dy(i); };
  const double l1 = area(2, 3), l2 = area(3, 1), l3 = area(1, 2);
  const double thickness = l1 * (t.depth[1] - t.depth[0]) + l2 * (t.depth[2] - t.depth[0]) +
                           l3 * (t.depth[3] - t.depth[0]);
  const bool positive = thickness > 0;
  // kTetrahedronFaces[f] lacks corner 3 - f
  const std::array<bool, 4> is_entered{(l3 > 0) == positive, (l2 > 0) == positive,
                                       (l1 > 0) == positive, (l1 + l2 + l3 < 0) == positive};
  FaceSides sides{{}, 0};
  std::size_t left = 4;
  for (std::size_t f = 0; f < 4; ++f) {
    if (is_entered[f])
      sides.face[sides.entered++] = f;
    else
      sides.face[--left] = f;
  }
  return sides;
}

// The quantities that the pixels of a row share on each face.
struct FaceRow {
  HWY_ALIGN double cy_dy[4], gy_dy[4];
  HWY_ALIGN double first[4], last[4];  // FaceRuns
};

HWY_INLINE void set_face_row(const FacePlanes& planes, const FaceRuns& runs, int row,
                             FaceRow& face_row) {
  const hn::CappedTag<double, 4> d;
  const auto y = hn::Set(d, pixel_center(row));
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d)) {
    const auto dy = hn::Sub(y, hn::Load(d, planes.base_y + f));
    hn::Store(hn::Mul(hn::Load(d, planes.cy + f), dy), d, face_row.cy_dy + f);
    hn::Store(hn::Mul(hn::Load(d, planes.gy + f), dy), d, face_row.gy_dy + f);
  }
  const auto r = static_cast<std::size_t>(row - runs.row_begin);
  for (std::size_t f = 0; f < 4; ++f) {
    face_row.first[f] = runs.first[r][f];
    face_row.last[f] = runs.last[r][f];
  }
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> covered_by_face(D d, const FaceRow& row, std::size_t f, V pixel) {
  return hn::And(hn::Ge(pixel, hn::Set(d, row.first[f])), hn::Lt(pixel, hn::Set(d, row.last[f])));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE FacePlace<V> place_on_face(D d, const FacePlanes& planes, const FaceRow& row,
                                      std::size_t f, V pixel) {
  return place_on_face(
      d, {planes.base_x[f], planes.cx[f], planes.gx[f], planes.h[f], row.cy_dy[f], row.gy_dy[f]},
      hn::Add(pixel, hn::Set(d, 0.5)));
}

template <class D, class V = hn::Vec<D>>
HWY_INLINE V on_face(D d, const FacePlanes::Quantity& q, std::size_t f, const FacePlace<V>& at) {
  return on_face(d, q.q0[f], q.qm[f], q.qs[f], at);
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
