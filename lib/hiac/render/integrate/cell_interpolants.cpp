#include "hiac/render/integrate/cell_interpolants.hpp"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "hiac/render/integrate/cell_interpolants.cpp"
#include <hwy/foreach_target.h>
// must come after foreach_target.h
#include <hwy/highway.h>

#include "hiac/render/integrate/segment_fields-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace hiac::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Stores the polynomials that SegmentFields finds.
class PieceSink {
 public:
  using D = hn::CappedTag<double, 8>;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  PieceSink(const CellPolynomials& cell, SegmentPieces& found) : cell_(cell), found_(found) {}

  void begin(std::size_t, const CellSegments&) {
    for (auto& pieces : of_lane_) pieces.clear();
  }

  HWY_NOINLINE void add(double begin, double end, const FieldPolynomials<V>& fields, M& active) {
    const D d;
    for (std::size_t f = 0; f < cell_.field_count; ++f)
      for (std::size_t k = 0; k <= fields[f].degree; ++k)
        hn::Store(fields[f].c[k], d, powers_[f][k].data());
    const auto is_active = lanes_of(d, active);
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      if (!is_active[lane]) continue;
      FieldAlongRay::Piece& piece = of_lane_[lane].emplace_back();
      piece.begin = begin;
      piece.end = end;
      for (std::size_t f = 0; f < cell_.field_count; ++f)
        piece.fields[f] = polynomial(f, fields[f].degree, lane);
    }
  }

  // Appends the pieces of those of the vector's first `count` segments that are done.
  void finish(M done, std::size_t count) {
    const auto is_done = lanes_of(D(), done);
    for (std::size_t lane = 0; lane < count; ++lane) {
      if (is_done[lane])
        found_.pieces.insert(found_.pieces.end(), of_lane_[lane].begin(), of_lane_[lane].end());
      found_.first.push_back(found_.pieces.size());
    }
  }

 private:
  static constexpr std::size_t kMostLanes = 8;

  // Field f in one lane, as a Bernstein polynomial on [0, 1].
  [[nodiscard]] BernsteinPolynomial polynomial(std::size_t f, std::size_t degree,
                                               std::size_t lane) const {
    std::array<double, kMaxFieldDegree + 1> c;
    for (std::size_t k = 0; k <= degree; ++k) c[k] = powers_[f][k][lane];
    BernsteinPolynomial p = bernstein_from_powers(std::span(c).first(degree + 1));
    for (std::size_t k = 0; k <= degree; ++k) p.c[k] += cell_.fields[f].base;
    return p;
  }

  const CellPolynomials& cell_;
  SegmentPieces& found_;
  std::array<std::vector<FieldAlongRay::Piece>, kMostLanes> of_lane_;
  alignas(64) std::array<std::array<double, kMostLanes>, kMaxFieldDegree + 1> powers_[2];
};

void interpolate_segments_here(const Frame& frame, const CellPolynomials& cell,
                               const CellSegments& segments, SegmentPieces& found) {
  PieceSink sink(cell, found);
  SegmentFields<PieceSink> fields(frame, cell, sink);
  const std::size_t lanes = hn::Lanes(PieceSink::D());
  for (std::size_t first = 0; first < segments.count; first += lanes)
    sink.finish(fields.expand(first, segments), std::min(lanes, segments.count - first));
}

}  // namespace hiac::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hiac {

HWY_EXPORT(interpolate_segments_here);

void interpolate_cell_segments(const Frame& frame, const CellPolynomials& cell,
                               CellSegments& segments, SegmentPieces& found) {
  found.pieces.clear();
  found.first.assign(1, 0);
  if (segments.count == 0) return;
  segments.pad();
  HWY_DYNAMIC_DISPATCH(interpolate_segments_here)(frame, cell, segments, found);
}

}  // namespace hiac
#endif
