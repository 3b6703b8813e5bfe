#include "hiac/preview/region_painter.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace hiac::preview {
namespace {

constexpr const char* kVertexHead = R"(#version 450 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 along;  // length, tau_front, tau_back
layout(location = 2) in vec3 in_front;
layout(location = 3) in vec3 in_back;
uniform vec4 part;  // corner and size, pixels
out vec3 ray;
out vec3 kappa_front;
out vec3 kappa_back;
out vec4 of_vertex;
)";

constexpr const char* kVertexMain = R"(
void main() {
  gl_Position = vec4((place - part.xy) / part.zw * 2.0 - 1.0, 0.0, 1.0);
  ray = along;
  kappa_front = in_front;
  kappa_back = in_back;
  of_vertex = at_vertex(along.x, along.y, along.z, in_front, in_back);
}
)";

constexpr const char* kFragmentHead = R"(#version 450 core
in vec3 ray;
in vec3 kappa_front;
in vec3 kappa_back;
in vec4 of_vertex;
out vec4 light;
)";

constexpr const char* kFragmentMain = R"(
void main() {
  light = shade(ray.x, ray.y, ray.z, kappa_front, kappa_back, of_vertex);
}
)";

VertexArrayName vertex_layout(GLuint buffer) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  VertexArrayName layout(name);
  constexpr std::array<std::array<std::size_t, 2>, 4> kParts{
      {{offsetof(RegionVertex, x), 2},
       {offsetof(RegionVertex, length), 3},
       {offsetof(RegionVertex, kappa_front), 3},
       {offsetof(RegionVertex, kappa_back), 3}}};
  for (GLuint k = 0; k < kParts.size(); ++k) {
    glEnableVertexArrayAttrib(name, k);
    glVertexArrayAttribFormat(name, k, static_cast<GLint>(kParts[k][1]), GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(kParts[k][0]));
    glVertexArrayAttribBinding(name, k, 0);
  }
  glVertexArrayVertexBuffer(name, 0, buffer, 0, sizeof(RegionVertex));
  return layout;
}

}  // namespace

RegionPainter::RegionPainter(const Context& context, const std::string& method)
    : context_(context),
      program_(
          draw_program(kVertexHead + method + kVertexMain, kFragmentHead + method + kFragmentMain)),
      layout_(vertex_layout(buffer_.get())) {}

std::uint64_t RegionPainter::draw(const PixelRect& part, const RegionFill& fill) {
  glUseProgram(program_.get());
  glBindVertexArray(layout_.get());
  glProgramUniform4f(program_.get(), glGetUniformLocation(program_.get(), "part"),
                     static_cast<float>(part.x), static_cast<float>(part.y),
                     static_cast<float>(part.width), static_cast<float>(part.height));
  std::vector<RegionVertex> triangles;
  std::uint64_t drawn = 0;
  while (fill(triangles)) {
    buffer_.set(std::span<const RegionVertex>(triangles));
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(triangles.size()));
    drawn += triangles.size() / 3;
    triangles.clear();
  }
  context_.check("drawing homogeneous regions");
  return drawn;
}

}  // namespace hiac::preview
