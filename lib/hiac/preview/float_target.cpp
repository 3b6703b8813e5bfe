#include "hiac/preview/float_target.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

namespace hiac::preview {
namespace {

// Rows are read in bands of about so many pixels, which the processor's caches hold.
constexpr std::uint32_t kBandPixels = 1U << 15;

TextureName new_texture() {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  return TextureName(name);
}

FramebufferName new_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return FramebufferName(name);
}

}  // namespace

FloatTarget::FloatTarget(const Context& context, std::uint32_t width, std::uint32_t height)
    : context_(context), color_(new_texture()), framebuffer_(new_framebuffer()) {
  glTextureStorage2D(color_.get(), 1, GL_RGBA32F, static_cast<GLsizei>(width),
                     static_cast<GLsizei>(height));
  glNamedFramebufferTexture(framebuffer_.get(), GL_COLOR_ATTACHMENT0, color_.get(), 0);
  context.check(fmt::format("making a target of {} x {} pixels", width, height));
  if (glCheckNamedFramebufferStatus(framebuffer_.get(), GL_DRAW_FRAMEBUFFER) !=
      GL_FRAMEBUFFER_COMPLETE)
    throw DriverError(
        fmt::format("{}: cannot draw into 32-bit float colours", context.device().name));
}

void FloatTarget::begin(const PixelRect& part) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glViewport(0, 0, static_cast<GLsizei>(part.width), static_cast<GLsizei>(part.height));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DITHER);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
}

void FloatTarget::read(const PixelRect& part, const PixelRect& whole, Image& image) const {
  const std::uint32_t rows = std::clamp(kBandPixels / part.width, 1U, part.height);
  std::vector<float> values(std::size_t{4} * part.width * rows);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  for (std::uint32_t first = 0; first < part.height; first += rows) {
    const std::uint32_t count = std::min(rows, part.height - first);
    glReadPixels(0, static_cast<GLint>(first), static_cast<GLsizei>(part.width),
                 static_cast<GLsizei>(count), GL_RGBA, GL_FLOAT, values.data());
    auto value = values.begin();
    for (std::uint32_t y = first; y < first + count; ++y)
      for (std::uint32_t x = 0; x < part.width; ++x, value += 4)
        std::copy_n(value, 4, image.pixel(x + part.x - whole.x, y + part.y - whole.y).begin());
  }
  context_.check("drawing");
}

std::vector<PixelRect> parts_of(const PixelRect& whole, std::uint32_t side) {
  std::vector<PixelRect> parts;
  for (std::uint32_t y = 0; y < whole.height; y += side)
    for (std::uint32_t x = 0; x < whole.width; x += side)
      parts.push_back({whole.x + x, whole.y + y, std::min(side, whole.width - x),
                       std::min(side, whole.height - y)});
  return parts;
}

}  // namespace hiac::preview
