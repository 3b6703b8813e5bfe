// Details of the segments of tetrahedra, from vectors of them, compiled once for every instruction
// set. Include from a file that Highway's foreach_target.h compiles repeatedly.

#if defined(HIAC_RENDER_TETRAHEDRON_DESCRIBE_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef HIAC_RENDER_TETRAHEDRON_DESCRIBE_INL
#    undef HIAC_RENDER_TETRAHEDRON_DESCRIBE_INL
#  else
#    define HIAC_RENDER_TETRAHEDRON_DESCRIBE_INL
#  endif

#  include <algorithm>
#  include <vector>

#  include <hwy/highway.h>

#  include "hiac/render/integrate/shading-inl.hpp"
#  include "hiac/render/pixels/compositor.hpp"
#  include "hiac/render/tetrahedra/tetrahedron_details.hpp"
#  include "hiac/render/tetrahedra/tetrahedron_ends-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Some pixels of a row, from column x on.
struct DescribedPixels {
  int row, x;
  std::size_t at;  // index of the first pixel in the tile's planes
  bool cut;        // the cell was searched for isosurfaces here
  bool empty;      // the volume neither absorbs nor shines
};

// Adds the details of segments, before they are composited, to their pixels or to a group's list.
class SegmentDescriber {
 public:
  explicit SegmentDescriber(const TileTarget& to) : to_(to), details_(to.frame) {}

  void enter(CellId cell) { details_.enter(cell); }

  // Stores the offsets from the values of the cell's surfaces at the segments' ends, as found by
  // CutScan.
  void set_ends(std::size_t cuts, const std::vector<double>& ends) {
    cut_count_ = cuts;
    ends_ = ends;
  }
  // Stores where the surfaces are crossed, as fractions of the segments; 2 where they are not.
  void set_places(const std::vector<double>& places, std::size_t lanes) {
    places_ = places;
    depth_sum_.assign(2 * lanes, 0);
  }
  // Adds opacity at the fraction u of segments that surfaces cross, for the mean depth.
  template <class D, class V>
  HWY_NOINLINE void add_depth(D d, V u, V opacity) {
    double* sum = depth_sum_.data();
    hn::StoreU(hn::Add(opacity, hn::LoadU(d, sum)), d, sum);
    sum += hn::Lanes(d);
    hn::StoreU(hn::MulAdd(opacity, u, hn::LoadU(d, sum)), d, sum);
  }

  template <class D, class V>
  HWY_NOINLINE void describe(D d, const DescribedPixels& pixels, V length, const EntryAndExit<V>& e,
                             const Radiance<V>& radiance, hn::Mask<D> active) {
    const V all[kCount] = {e.front,
                           e.back,
                           length,
                           e.front_color,
                           e.back_color,
                           e.front_extinction,
                           e.back_extinction,
                           radiance.red,
                           radiance.green,
                           radiance.blue,
                           radiance.transparency,
                           hn::IfThenElseZero(active, hn::Set(d, 1.0))};
    for (std::size_t q = 0; q < kCount; ++q) hn::Store(all[q], d, lane_[q]);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k)
      if (lane_[kActive][k] != 0)
        hiac::describe(to_, pixels.at + k, details_.describe(segment_of(pixels, k, hn::Lanes(d))));
  }

 private:
  enum : std::size_t {
    kFront,
    kBack,
    kLength,
    kColor0,
    kColor1,
    kTau0,
    kTau1,
    kRed,
    kGreen,
    kBlue,
    kZeta,
    kActive,
    kCount
  };

  TetrahedronSegment segment_of(const DescribedPixels& pixels, std::size_t k, std::size_t lanes) {
    const double front = lane_[kFront][k], back = lane_[kBack][k];
    TetrahedronSegment segment{.x = pixels.x + static_cast<int>(k),
                               .y = pixels.row,
                               .front = front,
                               .back = back,
                               .length = lane_[kLength][k],
                               .seen = lane_[kLength][k],
                               .color = {lane_[kColor0][k], lane_[kColor1][k]},
                               .extinction = {lane_[kTau0][k], lane_[kTau1][k]},
                               .rgb = {lane_[kRed][k], lane_[kGreen][k], lane_[kBlue][k]},
                               .transparency = lane_[kZeta][k],
                               .first = front,
                               .mean = 0.5 * (front + back),
                               .cuts = {}};
    if (!pixels.cut) return segment;
    offsets_.clear();
    double nearest = 2;
    for (std::size_t c = 0; c < cut_count_; ++c) {
      const double u = places_[c * lanes + k];
      offsets_.push_back({ends_[2 * c * lanes + k], ends_[(2 * c + 1) * lanes + k], u <= 1});
      nearest = std::min(nearest, u);
    }
    segment.cuts = offsets_;
    if (pixels.empty) segment.first = front + nearest * (back - front);
    const double opacity = depth_sum_[k];
    if (opacity > 0) segment.mean = front + depth_sum_[lanes + k] / opacity * (back - front);
    return segment;
  }

  TileTarget to_;
  TetrahedronDetails details_;
  std::size_t cut_count_ = 0;
  std::vector<double> ends_, places_, depth_sum_;
  std::vector<CutOffsets> offsets_;
  HWY_ALIGN double lane_[kCount][8];
};

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
