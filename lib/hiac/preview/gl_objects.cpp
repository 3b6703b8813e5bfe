#include "hiac/preview/gl_objects.hpp"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include <fmt/format.h>

#include "hiac/preview/context.hpp"

namespace hiac::preview {
namespace {

GLuint new_buffer() {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  return name;
}

// The first line of a log that names a fault.
std::string first_line(const std::string& log) {
  const std::size_t fault = log.find("error");
  const std::size_t begin = fault == std::string::npos ? 0 : log.rfind('\n', fault) + 1;
  return log.substr(begin, std::min(log.find('\n', begin), log.size()) - begin);
}

ShaderName compiled(GLenum kind, const std::string& source) {
  ShaderName shader(glCreateShader(kind));
  const char* text = source.c_str();
  glShaderSource(shader.get(), 1, &text, nullptr);
  glCompileShader(shader.get());
  GLint good = GL_FALSE, length = 0;
  glGetShaderiv(shader.get(), GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  glGetShaderiv(shader.get(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader.get(), length, nullptr, log.data());
  throw DriverError(fmt::format("preview: the driver refuses a shader ({})", first_line(log)));
}

ProgramName linked(std::initializer_list<GLuint> shaders) {
  ProgramName program(glCreateProgram());
  for (const GLuint shader : shaders) glAttachShader(program.get(), shader);
  glLinkProgram(program.get());
  for (const GLuint shader : shaders) glDetachShader(program.get(), shader);
  GLint good = GL_FALSE, length = 0;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &good);
  if (good == GL_TRUE) return program;
  glGetProgramiv(program.get(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program.get(), length, nullptr, log.data());
  throw DriverError(fmt::format("preview: the driver cannot link a shader ({})", first_line(log)));
}

}  // namespace

Buffer::Buffer() : name_(new_buffer()) {}

void Buffer::reserve(std::size_t bytes) {
  if (bytes <= bytes_) return;
  glNamedBufferData(get(), static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
  bytes_ = bytes;
}

void Buffer::set_bytes(std::span<const std::byte> data) {
  if (data.empty()) return;
  if (data.size() <= bytes_) {
    glInvalidateBufferData(get());
    glNamedBufferSubData(get(), 0, static_cast<GLsizeiptr>(data.size()), data.data());
    return;
  }
  glNamedBufferData(get(), static_cast<GLsizeiptr>(data.size()), data.data(), GL_STREAM_DRAW);
  bytes_ = data.size();
}

void add_attribute(const VertexArrayName& layout, std::size_t number, GLuint binding, GLint count,
                   std::size_t first) {
  const auto at = static_cast<GLuint>(number);
  glEnableVertexArrayAttrib(layout.get(), at);
  glVertexArrayAttribFormat(layout.get(), at, count, GL_FLOAT, GL_FALSE,
                            static_cast<GLuint>(first * sizeof(float)));
  glVertexArrayAttribBinding(layout.get(), at, binding);
}

ProgramName draw_program(const std::string& vertex, const std::string& fragment) {
  const ShaderName of_vertices = compiled(GL_VERTEX_SHADER, vertex);
  const ShaderName of_fragments = compiled(GL_FRAGMENT_SHADER, fragment);
  return linked({of_vertices.get(), of_fragments.get()});
}

ProgramName compute_program(const std::string& source) {
  const ShaderName shader = compiled(GL_COMPUTE_SHADER, source);
  return linked({shader.get()});
}

}  // namespace hiac::preview
