#include "hiac/preview/methods/method_painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "hiac/base/seconds.hpp"
#include "hiac/preview/methods/shaders.hpp"

namespace hiac::preview {
namespace {

// Cells a draw call: the device's memory is bounded, and cells are made triangles while others are
// drawn. Some 6 MB, which a processor that draws them itself still has in its caches.
constexpr std::size_t kChunk = std::size_t{1} << 14;

ProgramName program_of(const Frame& frame, Method method, RecordShape shape) {
  const Shaders shaders =
      shaders_of(method, frame.optics.emission ? Glow::emission : Glow::chromaticity, shape);
  return draw_program(shaders.vertex, shaders.fragment);
}

// A vertex has a place of its own, and a third of its triangle's record: the first one sees all of
// it, the others what is there from their third on, which is not used.
VertexArrayName vertex_layout(RecordShape shape) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  VertexArrayName layout(name);
  add_attribute(layout, 0, 0, 2, 0);
  for (std::size_t k = 0; k < record_attributes(shape); ++k)
    add_attribute(layout, 1 + k, 1, 4, 4 * k);
  return layout;
}

// Copies what several threads have made behind one another.
void join(Buffer& buffer, std::span<const TriangleBuffer> made,
          std::span<const float> (TriangleBuffer::*part)() const, std::size_t floats_behind) {
  std::size_t bytes = floats_behind * sizeof(float);
  for (const TriangleBuffer& triangles : made) bytes += (triangles.*part)().size_bytes();
  buffer.reserve(bytes);
  glInvalidateBufferData(buffer.get());
  std::size_t at = 0;
  for (const TriangleBuffer& triangles : made) {
    const auto floats = (triangles.*part)();
    if (floats.empty()) continue;
    glNamedBufferSubData(buffer.get(), static_cast<GLintptr>(at),
                         static_cast<GLsizeiptr>(floats.size_bytes()), floats.data());
    at += floats.size_bytes();
  }
}

}  // namespace

MethodPainter::MethodPainter(const Context& context, const Frame& frame, Method method)
    : context_(context),
      frame_(frame),
      method_(method),
      shape_(record_shape(frame, method)),
      program_(program_of(frame, method, shape_)),
      layout_(vertex_layout(shape_)) {}

RegionCounts MethodPainter::draw(const PixelRect& part, std::span<const CellId> back_to_front) {
  RegionFiller filler(frame_, method_, shape_, part);
  RegionCounts counts;
  buffers_.clear();  // those of another part
  const auto axes = frame_.projector.axes();
  const GLuint program = program_.get();
  glUseProgram(program);
  glBindVertexArray(layout_.get());
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glProgramUniform2f(program, glGetUniformLocation(program, "scale"),
                     2 / static_cast<float>(part.width), 2 / static_cast<float>(part.height));
  glProgramUniform3f(program, glGetUniformLocation(program, "eye"),
                     static_cast<float>(axes.center_x - part.x),
                     static_cast<float>(axes.center_y - part.y),
                     static_cast<float>(1 / frame_.projector.pixels_per_unit()));
  const std::size_t record = shape_.floats();
  for (std::size_t first = 0; first < back_to_front.size(); first += kChunk) {
    const double start = seconds_now();
    filler.fill(back_to_front.subspan(first, std::min(kChunk, back_to_front.size() - first)),
                buffers_, counts);
    const double made_at = seconds_now();
    region_seconds_ += made_at - start;
    std::size_t triangles = 0;
    for (const TriangleBuffer& made : buffers_) triangles += made.triangles();
    if (triangles == 0) continue;
    join(places_, buffers_, &TriangleBuffer::places, 0);
    // the last triangle's vertices look that far
    join(records_, buffers_, &TriangleBuffer::records, record);
    glVertexArrayVertexBuffer(layout_.get(), 0, places_.get(), 0, 2 * sizeof(float));
    glVertexArrayVertexBuffer(layout_.get(), 1, records_.get(), 0,
                              static_cast<GLsizei>(record / 3 * sizeof(float)));
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(3 * triangles));
    triangles_ += triangles;
    upload_seconds_ += seconds_now() - made_at;
  }
  context_.check("drawing homogeneous regions");
  return counts;
}

}  // namespace hiac::preview
