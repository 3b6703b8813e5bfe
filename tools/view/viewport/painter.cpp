#include "tools/view/viewport/painter.hpp"

#include <algorithm>
#include <utility>

#include "hiac/annotate/annotate.hpp"
#include "hiac/base/error.hpp"
#include "hiac/base/seconds.hpp"
#include "hiac/frame/background.hpp"
#include "hiac/image/display_bytes.hpp"
#include "hiac/render/bounds/bounded_scene.hpp"
#include "hiac/session/coarse_scene.hpp"
#include "hiac/session/error_bounds.hpp"
#include "tools/view/viewport/hardware_preview.hpp"

namespace hiac::view {
namespace {

// The scene as far as it decides whether it can be drawn.
Scene without_view(Scene scene) {
  scene.camera = {};
  scene.image = {};
  return scene;
}

// The background behind a coarse picture's pixels, where the pixels of the whole picture are.
void put_background_behind(Image& image, const CoarseScene& coarse, const Scene& whole) {
  const auto place = [&](std::int64_t first, std::size_t at) {
    return static_cast<std::uint32_t>(first + static_cast<std::int64_t>(at) * coarse.step);
  };
  for (std::size_t y = 0; y < image.height(); ++y) {
    for (std::size_t x = 0; x < image.width(); ++x) {
      const Color behind =
          background_at(whole.background, whole.image, place(coarse.left, x), place(coarse.top, y));
      const auto pixel = image.pixel(x, y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += (1 - pixel[3]) * behind[c];
    }
  }
}

// For every place along a side of the whole picture, the coarse pixel that stands for it.
std::vector<std::size_t> stand_ins(std::int64_t first, std::uint32_t step, std::uint32_t side) {
  std::vector<std::size_t> which(side);
  const std::int64_t start =
      first - (step - std::int64_t{1}) / 2;  // the first square's first pixel
  for (std::uint32_t k = 0; k < side; ++k)
    which[k] = static_cast<std::size_t>((static_cast<std::int64_t>(k) - start) / step);
  return which;
}

// Every coarse pixel as a square of the whole picture. `stride`: values a pixel.
template <typename Value>
std::vector<Value> spread(std::span<const Value> values, std::size_t width, std::size_t stride,
                          const CoarseScene& coarse, ImageSize size) {
  const auto columns = stand_ins(coarse.left, coarse.step, size.width);
  const auto rows = stand_ins(coarse.top, coarse.step, size.height);
  std::vector<Value> all(stride * size.width * size.height);
  auto out = all.begin();
  for (std::size_t y = 0; y < size.height; ++y) {
    const std::size_t row_length = stride * size.width;
    if (y > 0 && rows[y] == rows[y - 1]) {
      out = std::copy_n(out - static_cast<std::ptrdiff_t>(row_length), row_length, out);
      continue;
    }
    for (const std::size_t x : columns)
      out = std::copy_n(values.data() + stride * (rows[y] * width + x), stride, out);
  }
  return all;
}

// Of few pixels, without background.
Picture coarse_picture(Session& session, const Scene& scene) {
  if (auto picture = session.picture_by_rays(scene, false)) return *std::move(picture);
  PictureRequest request;
  request.background = false;
  return session.picture(scene, request);
}

}  // namespace

Painter::Painter(const Cancellation& cancellation) : cancellation_(cancellation) {}
Painter::~Painter() = default;

Session& Painter::session_for(const Wanted& wanted) {
  if (!session_ || mesh_ != wanted.mesh) {
    checked_.reset();
    ZooMesh mesh = *wanted.mesh;  // its arrays are shared
    if (!session_ || !session_->take_step(mesh)) {
      session_.reset();  // its memory is free while the next one is prepared
      session_ =
          std::make_unique<Session>(std::move(mesh), Monitor{.cancellation = &cancellation_});
    }
    mesh_ = wanted.mesh;
  }
  Scene kind = without_view(wanted.scene);
  if (!checked_ || !(*checked_ == kind)) {
    left_out_ = session_->skip_invalid_cells(wanted.scene).size();
    checked_ = std::move(kind);
  }
  return *session_;
}

void Painter::annotate(Image& image, const Wanted& wanted) const {
  if (!wanted.annotation.draws()) return;
  const AnnotationFacts facts = annotation_facts(*wanted.mesh, wanted.scene.volume);
  Annotator(wanted.annotation, wanted.scene, facts)
      .draw(image, whole_picture(wanted.scene.image), true);
}

Painted Painter::whole(const Wanted& wanted, std::uint32_t samples) {
  Session& session = session_for(wanted);
  PictureRequest request;
  if (samples > 1) request.sampling = {samples, SampleFilter::box};
  Picture picture = session.picture(wanted.scene, request);
  require_numbers(picture.image);
  const ImageSize size = wanted.scene.image;
  Painted painted{.size = size,
                  .pixels = static_cast<std::uint64_t>(size.width) * size.height,
                  .samples = samples,
                  .violations = picture.violations,
                  .segments = picture.segments,
                  .mean_optical_depth = picture.mean_optical_depth,
                  .largest_optical_depth = picture.largest_optical_depth,
                  .left_out = left_out_,
                  .mesh_hash = picture.mesh_hash};
  if (wanted.annotation.draws()) {
    Image annotated = picture.image;
    annotate(annotated, wanted);
    painted.bytes = display_bytes(annotated);
  } else {
    painted.bytes = display_bytes(picture.image);
  }
  painted.image = std::make_shared<const Image>(std::move(picture.image));
  return painted;
}

Painted Painter::paint(const Wanted& wanted, std::uint32_t step) {
  const double start = seconds_now();
  Painted painted;
  if (step == 1) {
    painted = whole(wanted, 1);
  } else {
    Session& session = session_for(wanted);
    const CoarseScene coarse = coarse_scene(wanted.scene, step);
    Picture picture = coarse_picture(session, coarse.scene);
    require_numbers(picture.image);
    put_background_behind(picture.image, coarse, wanted.scene);
    const ImageSize size = wanted.scene.image;
    painted = {.size = size,
               .step = step,
               .pixels = std::uint64_t{picture.image.width()} * picture.image.height(),
               .violations = picture.violations,
               .segments = picture.segments,
               .mean_optical_depth = picture.mean_optical_depth,
               .largest_optical_depth = picture.largest_optical_depth,
               .left_out = left_out_};
    const std::size_t width = picture.image.width();
    if (wanted.annotation.draws()) {
      Image full(size.width, size.height, rgba_channels(),
                 spread<double>(picture.image.values(), width, 4, coarse, size));
      annotate(full, wanted);
      painted.bytes = display_bytes(full);
    } else {
      painted.bytes = spread<std::uint8_t>(display_bytes(picture.image), width, 3, coarse, size);
    }
  }
  painted.seconds = seconds_now() - start;
  return painted;
}

Painted Painter::paint_by_hardware(const Wanted& wanted) {
  const double start = seconds_now();
  Session& session = session_for(wanted);
  if (!hardware_) hardware_ = std::make_unique<HardwarePreview>();
  Image image = hardware_->draw(wanted.mesh, wanted.scene, session);
  require_numbers(image);
  annotate(image, wanted);
  const ImageSize size = wanted.scene.image;
  return {.bytes = display_bytes(image),
          .size = size,
          .pixels = static_cast<std::uint64_t>(size.width) * size.height,
          .seconds = seconds_now() - start,
          .left_out = left_out_,
          .device = hardware_->device()};
}

void Painter::leave_hardware() { hardware_.reset(); }

Painted Painter::paint_samples(const Wanted& wanted) {
  const double start = seconds_now();
  Painted painted = whole(wanted, wanted.samples);
  painted.seconds = seconds_now() - start;
  return painted;
}

std::optional<double> Painter::error_bound(const Wanted& wanted) {
  if (reason_unbounded(wanted.scene)) return std::nullopt;
  // The picture is drawn in bands, of which nothing is kept but the bound: the shown one is in
  // memory as well.
  constexpr std::uint32_t kBandPixels = 1U << 17;
  Session& session = session_for(wanted);
  PictureRequest request;
  request.channels = {"error"};
  const ImageSize size = wanted.scene.image;
  const std::uint32_t rows = std::max(kBandPixels / size.width, 1U);
  double largest = 0;
  for (std::uint32_t y = 0; y < size.height; y += rows) {
    request.part = {.x = 0, .y = y, .width = size.width, .height = std::min(rows, size.height - y)};
    const auto bound = largest_error_bound(session.picture(wanted.scene, request).image);
    if (!bound) return std::nullopt;
    largest = std::max(largest, *bound);
  }
  return largest;
}

Explanation Painter::explain(const Wanted& wanted, std::uint32_t x, std::uint32_t y) {
  return session_for(wanted).explain(wanted.scene, x, y);
}

}  // namespace hiac::view
