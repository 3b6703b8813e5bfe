#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <epoxy/gl.h>

namespace hiac::preview {

/// An OpenGL name that is deleted with its owner; the context has to live longer.
template <void (*Delete)(GLuint)>
class Name {
 public:
  explicit Name(GLuint name = 0) : name_(name) {}
  ~Name() {
    if (name_ != 0) Delete(name_);
  }
  Name(Name&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Name& operator=(Name&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Name(const Name&) = delete;
  Name& operator=(const Name&) = delete;

  [[nodiscard]] GLuint get() const { return name_; }

 private:
  GLuint name_;
};

namespace names {
inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }
inline void delete_shader(GLuint name) { glDeleteShader(name); }
}  // namespace names

using TextureName = Name<names::delete_texture>;
using FramebufferName = Name<names::delete_framebuffer>;
using VertexArrayName = Name<names::delete_vertex_array>;
using ProgramName = Name<names::delete_program>;
using ShaderName = Name<names::delete_shader>;

/// Memory of the device. It grows when it is set to more than it holds, and does not shrink.
class Buffer {
 public:
  Buffer();

  [[nodiscard]] GLuint get() const { return name_.get(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

  /// Room for that many bytes, whatever they are.
  void reserve(std::size_t bytes);
  /// Copies data to the buffer's beginning.
  template <typename T>
  void set(std::span<const T> data) {
    set_bytes(std::as_bytes(data));
  }

 private:
  void set_bytes(std::span<const std::byte> data);

  Name<names::delete_buffer> name_;
  std::size_t bytes_ = 0;
};

/// An attribute of `count` floats, from the float `first` on of what a vertex has in the vertex
/// array's buffer `binding`.
void add_attribute(const VertexArrayName& layout, std::size_t number, GLuint binding, GLint count,
                   std::size_t first);

/// Links a program of a vertex and a fragment shader. Throws DriverError, with the first line of
/// the driver's log, when the driver refuses one.
ProgramName draw_program(const std::string& vertex, const std::string& fragment);
/// The same of a compute shader.
ProgramName compute_program(const std::string& source);

}  // namespace hiac::preview
