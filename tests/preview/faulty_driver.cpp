// Loaded before a program that draws by OpenGL through epoxy (LD_PRELOAD): gives its driver the
// faults that the environment names.
//   FAULT_NOT_CURRENT=1    no context can be made current
//   FAULT_LOST_AFTER=N     the context is lost after N questions whether it is
//   FAULT_ERROR_AFTER=N    the same, of a driver that tells of it as an error alone
//   FAULT_TEXTURE_SIDE=N   the largest texture has N pixels a side
//   FAULT_STORAGE_BYTES=N  the largest storage buffer has N bytes

#include <cstdlib>

#include <epoxy/gl.h>
// after gl.h
#include <epoxy/egl.h>

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
PFNGLGETERRORPROC get_error;
PFNEGLMAKECURRENTPROC make_current;

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

GLenum faulty_error() {
  static long questions = 0;
  const long good = number("FAULT_ERROR_AFTER");
  if (good >= 0 && questions++ >= good) return GL_CONTEXT_LOST;
  glGetError = get_error;
  const GLenum error = glGetError();
  get_error = glGetError;
  glGetError = faulty_error;
  return error;
}

EGLBoolean faulty_current(EGLDisplay display, EGLSurface draw, EGLSurface read,
                          EGLContext context) {
  if (context != EGL_NO_CONTEXT && number("FAULT_NOT_CURRENT") == 1) return EGL_FALSE;
  eglMakeCurrent = make_current;
  const EGLBoolean done = eglMakeCurrent(display, draw, read, context);
  make_current = eglMakeCurrent;
  eglMakeCurrent = faulty_current;
  return done;
}

[[gnu::constructor]] void replace() {
  get_integer = glGetIntegerv;
  get_integer64 = glGetInteger64v;
  get_error = glGetError;
  make_current = eglMakeCurrent;
  glGetIntegerv = faulty_integer;
  glGetInteger64v = faulty_integer64;
  glGetGraphicsResetStatus = faulty_status;
  glGetError = faulty_error;
  eglMakeCurrent = faulty_current;
}

}  // namespace
