// Loaded before a program that draws by OpenGL through epoxy (LD_PRELOAD): gives its driver the
// faults that the environment names.
//   FAULT_LOST_AFTER=N     the context is lost after N questions whether it is
//   FAULT_TEXTURE_SIDE=N   the largest texture has N pixels a side
//   FAULT_STORAGE_BYTES=N  the largest storage buffer has N bytes

#include <cstdlib>

#include <epoxy/gl.h>

namespace {

// -1: not in the environment.
long number(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? -1 : std::atol(text);
}

// What was in the place of a function. epoxy finds a driver's function at its first call and puts
// it there, if what it left there itself still is.
PFNGLGETINTEGERVPROC get_integer;
PFNGLGETINTEGER64VPROC get_integer64;

void faulty_integer(GLenum what, GLint* value) {
  glGetIntegerv = get_integer;
  glGetIntegerv(what, value);
  get_integer = glGetIntegerv;
  glGetIntegerv = faulty_integer;
  const long side = number("FAULT_TEXTURE_SIDE");
  if (what == GL_MAX_TEXTURE_SIZE && side >= 0) *value = static_cast<GLint>(side);
}

void faulty_integer64(GLenum what, GLint64* value) {
  glGetInteger64v = get_integer64;
  glGetInteger64v(what, value);
  get_integer64 = glGetInteger64v;
  glGetInteger64v = faulty_integer64;
  const long bytes = number("FAULT_STORAGE_BYTES");
  if (what == GL_MAX_SHADER_STORAGE_BLOCK_SIZE && bytes >= 0) *value = bytes;
}

GLenum faulty_status() {
  static long questions = 0;
  const long good = number("FAULT_LOST_AFTER");
  return good >= 0 && questions++ >= good ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR;
}

[[gnu::constructor]] void replace() {
  get_integer = glGetIntegerv;
  get_integer64 = glGetInteger64v;
  glGetIntegerv = faulty_integer;
  glGetInteger64v = faulty_integer64;
  glGetGraphicsResetStatus = faulty_status;
}

}  // namespace
