#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hiac/frame/crop.hpp"
#include "hiac/frame/frame.hpp"
#include "hiac/preview/context.hpp"
#include "hiac/preview/gl_objects.hpp"
#include "hiac/preview/methods/region_filler.hpp"

namespace hiac::preview {

/// Draws a frame by one of the paper's methods: the processor makes homogeneous regions of the
/// cells, the graphics hardware draws them.
class MethodPainter {
 public:
  /// `frame`: of linear tetrahedra alone. It and the context must outlive this. Throws DriverError
  /// when the driver refuses the shaders.
  MethodPainter(const Context& context, const Frame& frame, Method method);

  /// Draws over the target that has begun (float_target.hpp) as that part. Throws DriverError.
  RegionCounts draw(const PixelRect& part, std::span<const CellId> back_to_front);

  /// Of the drawing so far: making the triangles, and handing them over.
  [[nodiscard]] double region_seconds() const { return region_seconds_; }
  [[nodiscard]] double upload_seconds() const { return upload_seconds_; }
  [[nodiscard]] std::uint64_t triangles() const { return triangles_; }

 private:
  const Context& context_;
  const Frame& frame_;
  Method method_;
  RecordShape shape_;
  ProgramName program_;
  Buffer places_, records_;
  VertexArrayName layout_;
  std::vector<TriangleBuffer> buffers_;
  double region_seconds_ = 0, upload_seconds_ = 0;
  std::uint64_t triangles_ = 0;
};

}  // namespace hiac::preview
