#include "hiac/preview/context.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <dlfcn.h>
#include <epoxy/gl.h>
// after gl.h
#include <epoxy/egl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hiac::preview {
namespace {

constexpr std::string_view kAdvice =
    "Debian's libgl1-mesa-dri and libegl1 bring a driver that needs no graphics card";

bool has_word(const char* words, std::string_view word) {
  if (words == nullptr) return false;
  std::string_view rest(words);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

template <typename Function>
Function address_of(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// A display that may give a context.
struct Candidate {
  EGLenum platform;
  void* native;
  std::string name;
  bool software;
};

// Without the library epoxy would end the program.
bool has_egl() {
  static void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
  return library != nullptr;
}

std::vector<Candidate> candidates() {
  if (!has_egl()) return {};
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> found;
  if (has_word(extensions, "EGL_EXT_platform_base") &&
      (has_word(extensions, "EGL_EXT_device_enumeration") ||
       has_word(extensions, "EGL_EXT_device_base"))) {
    const auto query = address_of<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto describe = address_of<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    EGLint count = 0;
    if (query != nullptr && query(0, nullptr, &count) == EGL_TRUE && count > 0) {
      std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
      if (query(count, devices.data(), &count) != EGL_TRUE) count = 0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const char* of_device =
            describe == nullptr ? nullptr : describe(devices[k], EGL_EXTENSIONS);
        found.push_back({EGL_PLATFORM_DEVICE_EXT, devices[k], fmt::format("device {}", k),
                         has_word(of_device, "EGL_MESA_device_software")});
      }
    }
  }
  std::ranges::stable_partition(found, [](const Candidate& c) { return !c.software; });
  if (has_word(extensions, "EGL_MESA_platform_surfaceless"))
    found.push_back({EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, "surfaceless", true});
  return found;
}

// A context that is current, and goes when it is destroyed.
class Current {
 public:
  Current() = default;
  ~Current() { release(); }
  Current(const Current&) = delete;
  Current& operator=(const Current&) = delete;

  // Empty when the candidate gives a context, else what it lacks.
  std::string open(const Candidate& candidate) {
    const auto get = address_of<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get != nullptr) display_ = get(candidate.platform, candidate.native, nullptr);
    if (display_ == EGL_NO_DISPLAY) return "no display";
    if (eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) return "cannot be initialised";
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return "no OpenGL";
    if (!has_word(eglQueryString(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
      return "no context without a surface";
    return make_current();
  }

  void release() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    // the display itself stays: other contexts of the process may be of it
    display_ = EGL_NO_DISPLAY;
    context_ = EGL_NO_CONTEXT;
  }

 private:
  std::string make_current() {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display_, wanted, &config, 1, &count) != EGL_TRUE || count < 1)
      return "no OpenGL configuration";
    // a driver says that it lost a context only where it is asked to; not all can
    context_ = create(config, true);
    if (context_ == EGL_NO_CONTEXT) context_ = create(config, false);
    if (context_ == EGL_NO_CONTEXT) return "no OpenGL 4.5";
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
      return "its context cannot be used";
    return "";
  }

  [[nodiscard]] EGLContext create(EGLConfig config, bool tells_of_loss) const {
    std::vector<EGLint> wanted{
        EGL_CONTEXT_MAJOR_VERSION,       4,
        EGL_CONTEXT_MINOR_VERSION,       5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (tells_of_loss)
      wanted.insert(wanted.end(),
                    {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    wanted.push_back(EGL_NONE);
    return eglCreateContext(display_, config, EGL_NO_CONTEXT, wanted.data());
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

Device describe(const Candidate& candidate) {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return {name == nullptr ? "unnamed" : name, candidate.name};
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Mesa warns on stderr of every device that it cannot open; what was tried is told in one line.
void silence_loader() { setenv("EGL_LOG_LEVEL", "fatal", 0); }

std::optional<std::size_t> number_in(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Limits limits_now() {
  GLint texture = 0, viewport[2] = {0, 0}, renderbuffer = 0;
  GLint64 block = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  const GLint side = std::max(0, std::min({texture, renderbuffer, viewport[0], viewport[1]}));
  return {static_cast<std::uint32_t>(side),
          static_cast<std::uint64_t>(std::max<GLint64>(0, block))};
}

const char* error_text(GLenum error) {
  switch (error) {
    case GL_OUT_OF_MEMORY:
      return "out of graphics memory";
    case GL_CONTEXT_LOST:
      return "the context was lost";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "the driver cannot draw into 32-bit float colours";
    default:
      return "the driver refused a call";
  }
}

}  // namespace

struct Context::State {
  Current current;
  Device device;
  Limits limits;
};

std::vector<Device> list_devices() {
  silence_loader();
  std::vector<Device> found;
  for (const Candidate& candidate : candidates()) {
    Current current;
    if (current.open(candidate).empty()) found.push_back(describe(candidate));
  }
  return found;
}

Context::Context(const std::string& wanted) : state_(std::make_unique<State>()) {
  silence_loader();
  const std::optional<std::size_t> number = number_in(wanted);
  std::vector<std::string> tried, names;
  for (const Candidate& candidate : candidates()) {
    const std::string fault = state_->current.open(candidate);
    if (!fault.empty()) {
      tried.push_back(fmt::format("{}: {}", candidate.name, fault));
      state_->current.release();
      continue;
    }
    state_->device = describe(candidate);
    const bool fits = number ? *number == names.size()
                             : lower(state_->device.name).find(lower(wanted)) != std::string::npos;
    if (wanted.empty() || fits) {
      state_->limits = limits_now();
      return;
    }
    names.push_back(fmt::format("{} {}", names.size(), state_->device.name));
    state_->current.release();
  }
  if (!names.empty())
    throw UsageError(fmt::format("there is no such device (expected one of {}; found {})",
                                 fmt::join(names, ", "), wanted));
  if (tried.empty())
    tried.emplace_back("EGL offers neither devices nor Mesa's surfaceless platform");
  throw DriverError(fmt::format("preview: no OpenGL 4.5 driver was found (tried {}); {}",
                                fmt::join(tried, "; "), kAdvice));
}

Context::~Context() = default;

const Device& Context::device() const { return state_->device; }
const Limits& Context::limits() const { return state_->limits; }

void Context::check(const std::string& work) const {
  const auto fail = [&](const char* what) {
    throw DriverError(fmt::format("{}: {} while {}", state_->device.name, what, work));
  };
  if (glGetGraphicsResetStatus() != GL_NO_ERROR) fail(error_text(GL_CONTEXT_LOST));
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) fail(error_text(error));
}

}  // namespace hiac::preview
