#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/preview/methods/effective_color.hpp"
#include "hiac/preview/methods/method.hpp"
#include "hiac/preview/methods/triangle_buffer.hpp"

namespace hiac::preview {

/// What was met while cells were made triangles.
struct RegionCounts {
  std::uint64_t cells = 0;     ///< that may be seen in the part
  std::uint64_t whole = 0;     ///< of them tetrahedra that were not cut
  std::uint64_t slabs = 0;     ///< of the others
  std::uint64_t regions = 0;   ///< homogeneous ones; none with kChord
  std::uint64_t surfaces = 0;  ///< polygons of isosurfaces
  std::uint64_t vertices = 0;  ///< at which a colour was evaluated
  std::uint64_t reverted = 0;  ///< of them those for which M2 fell back to M1
  std::uint64_t uncut = 0;     ///< slabs that rounding kept whole

  void add(const RegionCounts& other);
};

/// How a frame's cells are drawn by a method.
///
/// What M1 averages is linear in each homogeneous region of a slab, so that in parallel projection
/// the means at a pixel are those of its own ray's ends, and no regions need be made: kChord, where
/// nothing has to be clipped, the transfer functions have one field, there are no isosurfaces, and
/// the functions are not too steep for single precision.
RecordShape record_shape(const Frame& frame, Method method);

/// Makes triangles of cells: slices each tetrahedron at the breakpoints of the transfer functions
/// (and not with unsliced integration) and at isosurfaces, divides each slab's projection into
/// homogeneous regions, and evaluates a method at their vertices (or none of the two, with kChord).
/// Cells that reach in front of the near plane, behind the far plane or far out of the picture are
/// clipped; in perspective the near plane is at least kNearest of the mesh's depth from the eye.
class RegionFiller {
 public:
  static constexpr double kNearest = 0x1p-24;

  /// `frame`: of linear tetrahedra alone (std::invalid_argument where not); it must outlive this.
  /// `shape`: record_shape(frame, method). `part`: of the picture; what lies beside it may be left
  /// out.
  RegionFiller(const Frame& frame, Method method, RecordShape shape, const PixelRect& part);
  ~RegionFiller();
  RegionFiller(const RegionFiller&) = delete;
  RegionFiller& operator=(const RegionFiller&) = delete;

  [[nodiscard]] RecordShape shape() const { return shape_; }

  /// Adds the triangles of cells, in their order, to a buffer. From one thread at a time.
  void fill(std::span<const CellId> back_to_front, TriangleBuffer& triangles, RegionCounts& counts);
  /// The same from all threads: part after part of the cells in buffers of their own, which are
  /// made as many as needed. Those that are there are of the same shape and part of the picture.
  void fill(std::span<const CellId> back_to_front, std::vector<TriangleBuffer>& buffers,
            RegionCounts& counts);

 private:
  friend class CellTriangles;

  const Frame& frame_;
  Method method_;
  PixelRect part_;
  RecordShape shape_;
  EffectiveColor color_;
  double near_, far_;              // range of t
  double near_depth_, far_depth_;  // the same as ProjectedNode::depth
  double width_, height_, reach_;  // of the picture; where cells are clipped beside it
};

}  // namespace hiac::preview
