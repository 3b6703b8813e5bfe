#include "hiac/preview/methods/method_painter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "hiac/base/seconds.hpp"
#include "hiac/preview/methods/shaders.hpp"

namespace hiac::preview {
namespace {

// Cells a draw call: the device's memory is bounded, and cells are made triangles while others are
// drawn.
constexpr std::size_t kChunk = std::size_t{1} << 16;

ProgramName program_of(const Frame& frame, Method method) {
  const Shaders shaders =
      shaders_of(method, frame.optics.emission ? Glow::emission : Glow::chromaticity,
                 frame.projector.perspective());
  return draw_program(shaders.vertex, shaders.fragment);
}

std::size_t values_of(const Frame& frame, Method method) {
  return frame.projector.perspective() && method != Method::interpolated_opacity
             ? kPerspectiveValues
             : kFlatValues;
}

// The first vertex of a triangle sees the other two behind it.
VertexArrayName vertex_layout(std::size_t values) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  VertexArrayName layout(name);
  const std::size_t stride = kFirstValue + values, head = values == kFlatValues ? 2 : 4;
  const auto attribute = [&](std::size_t number, std::size_t first, std::size_t count,
                             GLenum type = GL_FLOAT) {
    const auto at = static_cast<GLuint>(number);
    glEnableVertexArrayAttrib(name, at);
    glVertexArrayAttribFormat(name, at, static_cast<GLint>(count), type, GL_FALSE,
                              static_cast<GLuint>(first * sizeof(float)));
    glVertexArrayAttribBinding(name, at, 0);
  };
  attribute(0, 0, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    attribute(1 + k, k * stride + 2, 2);
    attribute(4 + k, k * stride + kFirstValue, head);
    attribute(7 + k, k * stride + kFirstValue + head, values - head);
    attribute(10 + k, k * stride + 4, 2, GL_SHORT);
  }
  return layout;
}

}  // namespace

MethodPainter::MethodPainter(const Context& context, const Frame& frame, Method method)
    : context_(context),
      frame_(frame),
      method_(method),
      program_(program_of(frame, method)),
      layout_(vertex_layout(values_of(frame, method))) {}

RegionCounts MethodPainter::draw(const PixelRect& part, std::span<const CellId> back_to_front) {
  RegionFiller filler(frame_, method_, part);
  RegionCounts counts;
  const auto axes = frame_.projector.axes();
  const GLuint program = program_.get();
  glUseProgram(program);
  glBindVertexArray(layout_.get());
  glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
  glProgramUniform4f(program, glGetUniformLocation(program, "part"), static_cast<float>(part.x),
                     static_cast<float>(part.y), static_cast<float>(part.width),
                     static_cast<float>(part.height));
  glProgramUniform4f(program, glGetUniformLocation(program, "eye"),
                     static_cast<float>(axes.center_x), static_cast<float>(axes.center_y),
                     static_cast<float>(1 / frame_.projector.pixels_per_unit()), 0);
  const std::size_t stride = (kFirstValue + filler.values()) * sizeof(float);
  for (std::size_t first = 0; first < back_to_front.size(); first += kChunk) {
    const double start = seconds_now();
    filler.fill(back_to_front.subspan(first, std::min(kChunk, back_to_front.size() - first)),
                buffers_, counts);
    const double made_at = seconds_now();
    region_seconds_ += made_at - start;
    std::size_t bytes = 0;
    for (const TriangleBuffer& made : buffers_) bytes += made.floats().size_bytes();
    if (bytes == 0) continue;
    // the last triangle's vertices look at two more
    buffer_.reserve(bytes + 2 * stride);
    glInvalidateBufferData(buffer_.get());
    glVertexArrayVertexBuffer(layout_.get(), 0, buffer_.get(), 0, static_cast<GLsizei>(stride));
    std::size_t at = 0;
    for (const TriangleBuffer& made : buffers_) {
      const auto floats = made.floats();
      if (floats.empty()) continue;
      glNamedBufferSubData(buffer_.get(), static_cast<GLintptr>(at),
                           static_cast<GLsizeiptr>(floats.size_bytes()), floats.data());
      at += floats.size_bytes();
    }
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(bytes / stride));
    triangles_ += bytes / stride / 3;
    upload_seconds_ += seconds_now() - made_at;
  }
  context_.check("drawing homogeneous regions");
  return counts;
}

}  // namespace hiac::preview
