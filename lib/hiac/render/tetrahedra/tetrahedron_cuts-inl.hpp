// Isosurfaces in linear tetrahedra, compiled once for every instruction set.
// Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TETRAHEDRON_CUTS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TETRAHEDRON_CUTS_INL
#    undef HIAC_RENDER_TETRAHEDRON_CUTS_INL
#  else
#    define HIAC_RENDER_TETRAHEDRON_CUTS_INL
#  endif

#  include <algorithm>
#  include <array>
#  include <cmath>
#  include <span>

#  include <hwy/highway.h>

#  include "hiac/element/face_interpolant.hpp"
#  include "hiac/element/gradient/gradient_direction.hpp"
#  include "hiac/frame/face_value.hpp"
#  include "hiac/frame/frame.hpp"
#  include "hiac/render/tetrahedra/face_lines-inl.hpp"
#  include "hiac/render/tetrahedra/scan_conversion-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A box on the screen, in pixel coordinates, that contains the isosurfaces of one cell.
struct ScreenBox {
  double x0 = hwy::HighestValue<double>(), y0 = x0, x1 = -x0, y1 = -x0;

  HWY_INLINE void include(double x, double y) {
    constexpr double kRounding = 0x1p-20;  // pixels; ample
    x0 = std::min(x0, x - kRounding);
    y0 = std::min(y0, y - kRounding);
    x1 = std::max(x1, x + kRounding);
    y1 = std::max(y1, y + kRounding);
  }
  // Whether the box may contain pixel centres of a row.
  [[nodiscard]] HWY_INLINE bool meets(int row) const {
    return y0 <= pixel_center(row) && pixel_center(row) <= y1;
  }
  // Whether the box may contain centres of the pixels [x, x_end) of a row.
  [[nodiscard]] HWY_INLINE bool meets(int row, int x, int x_end) const {
    return meets(row) && x0 <= pixel_center(x_end - 1) && pixel_center(x) <= x1;
  }
};

// One isosurface in the current tetrahedron: the field's offset from the surface's value as a
// function on the screen (in perspective times the depth, as for all fields), and bounds of the
// offset on each face (FaceOffsets::sign).
struct TetrahedronCut {
  const FrameIsosurface* surface;
  std::array<double, 3> normal;  // camera frame
  std::array<NodeId, 4> nodes;   // the corners
  std::array<double, 4> offsets;
  FacePlanes::Quantity offset;
  FaceLines::Quantity line;  // of the current row
  // by face: the offset lies in [least, most], and its sign is doubtful where |offset| < doubt
  std::array<double, 4> least, most, doubt;
};

// The cut of a cell with the corners `corner` in ascending order of their nodes; `box` is extended
// to include it.
HWY_NOINLINE TetrahedronCut make_cut(const Frame& frame, CellId cell, const IsosurfaceCut& cut,
                                     const std::array<std::size_t, 4>& corner,
                                     const ProjectedTetrahedron& t, const FacePlanes& planes,
                                     ScreenBox& box) {
  const std::uint64_t first_entry = frame.mesh.elems[cell];
  const NodeId* nodes = frame.mesh.nodes.data() + first_entry;
  TetrahedronCut result;
  result.surface = &frame.isosurfaces.surfaces[cut.surface];
  HWY_ALIGN double value[4];
  std::array<double, 4>& offset = result.offsets;
  std::array<std::array<double, 3>, 3> edges;
  const auto base = frame.mesh.position(nodes[corner[0]]);
  for (std::size_t k = 0; k < 4; ++k) {
    const NodeId node = result.nodes[k] = nodes[corner[k]];
    offset[k] = frame.isosurfaces.offset(*result.surface, cell, first_entry + corner[k], node);
    value[k] = frame.projector.perspective() ? offset[k] * t.depth[k] : offset[k];
    const auto p = frame.mesh.position(node);
    if (k > 0) edges[k - 1] = {p[0] - base[0], p[1] - base[1], p[2] - base[2]};
  }
  // offsets are affine on the screen: the surface is a polygon with its corners on the edges
  for (const auto& [i, j] : kTetrahedronEdges) {
    if ((offset[i] < 0) == (offset[j] < 0)) continue;
    const double u = value[i] / (value[i] - value[j]);
    box.include(t.x[i] + u * (t.x[j] - t.x[i]), t.y[i] + u * (t.y[j] - t.y[i]));
  }
  result.normal = frame.projector.camera_vector(gradient_direction(
      edges, {offset[1] - offset[0], offset[2] - offset[0], offset[3] - offset[0]}));
  const hn::CappedTag<double, 4> d;
  for (std::size_t f = 0; f < 4; f += hn::Lanes(d))
    set_quantity(d, value, f, face_edges(d, t, f).swapped(), result.offset);
  set_per_column(planes, result.offset, result.line);
  for (std::size_t f = 0; f < 4; ++f) {
    const auto [a, b, c] = kTetrahedronFaces[f];
    const auto at = [](const auto& values, int k) { return values[static_cast<std::size_t>(k)]; };
    const auto [least, most] = std::minmax({at(offset, a), at(offset, b), at(offset, c)});
    bool mixed = false;
    // face f lacks corner 3 - f in the ascending order
    const bool closed = cut.closed_faces != 0 &&
                        (cut.closed_faces & (1U << tetrahedron_face_without(corner[3 - f]))) != 0;
    const double sign = closed ? -1 : sign_between(least, most, mixed);
    const double largest =
        std::max({std::abs(at(value, a)), std::abs(at(value, b)), std::abs(at(value, c))});
    result.least[f] = mixed || sign < 0 ? -hwy::HighestValue<double>() : 0;
    result.most[f] = mixed || sign >= 0 ? hwy::HighestValue<double>() : kJustBelow;
    result.doubt[f] = mixed ? kOffsetDoubt * largest : 0;
  }
  return result;
}

// Finds for the offsets of all cuts what entry_and_exit finds for the fields. `ends` has two
// vectors for each cut: the offsets where the rays enter and leave the cell.
class CutScan {
 public:
  CutScan(const Frame& frame, const FaceLines& lines, const FaceSides& sides,
          std::span<const TetrahedronCut> cuts)
      : frame_(frame),
        lines_(lines),
        sides_(sides),
        cuts_(cuts),
        perspective_(frame.projector.perspective()) {}

  template <class D, class V = hn::Vec<D>>
  HWY_INLINE void find(D d, int row, V pixel, double* HWY_RESTRICT ends) const {
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t f = sides_.face[k];
      const bool entered = k < sides_.entered;
      // as in meet_faces, pixels that no other face of a side covers belong to its first face
      const bool first = k == 0 || k == sides_.entered;
      const V dx = columns_from_first(d, lines_, f, pixel);
      const auto covered = in_run(d, lines_, f, pixel, dx);
      const V depth = on_line(d, lines_.depth, f, dx);
      for (std::size_t c = 0; c < cuts_.size(); ++c) {
        double* at = ends + (2 * c + (entered ? 0 : 1)) * lanes;
        V offset = offset_at(d, cuts_[c], f, dx, depth, covered, row, pixel);
        if (!first) offset = hn::IfThenElse(covered, offset, hn::LoadU(d, at));
        hn::StoreU(offset, d, at);
      }
    }
  }

 private:
  template <class D, class V = hn::Vec<D>>
  HWY_INLINE V offset_at(D d, const TetrahedronCut& cut, std::size_t f, V dx, V depth,
                         hn::Mask<D> covered, int row, V pixel) const {
    V offset = on_line(d, cut.line, f, dx);
    const auto doubtful = hn::And(covered, hn::Lt(hn::Abs(offset), hn::Set(d, cut.doubt[f])));
    // t = -1 / depth > 0
    if (perspective_) offset = hn::Div(offset, depth);
    if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful)))
      offset = hn::IfThenElse(doubtful, settled(d, cut, f, row, pixel, depth), offset);
    return hn::Min(hn::Max(offset, hn::Set(d, cut.least[f])), hn::Set(d, cut.most[f]));
  }

  template <class D, class V = hn::Vec<D>>
  HWY_NOINLINE V settled(D d, const TetrahedronCut& cut, std::size_t f, int row, V pixel,
                         V depth) const {
    FaceOffsets face;
    for (const int corner : kTetrahedronFaces[f]) {
      const auto k = static_cast<std::size_t>(corner);
      face.add(cut.nodes[k], cut.offsets[k]);
    }
    HWY_ALIGN double x[8], t[8], value[8];
    hn::Store(pixel, d, x);
    hn::Store(perspective_ ? hn::Div(hn::Set(d, -1.0), depth) : depth, d, t);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      value[k] = face_value(frame_.mesh, frame_.projector, face, pixel_center(x[k]),
                            pixel_center(row), t[k]);
    return hn::Load(d, value);
  }

  const Frame& frame_;
  const FaceLines& lines_;
  const FaceSides& sides_;
  std::span<const TetrahedronCut> cuts_;
  bool perspective_;
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
