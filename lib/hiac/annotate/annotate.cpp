#include "hiac/annotate/annotate.hpp"

#include <cmath>

#include <fmt/format.h>

#include "hiac/annotate/caption.hpp"
#include "hiac/annotate/color_legend.hpp"
#include "hiac/annotate/length_scale.hpp"
#include "hiac/annotate/orientation_axes.hpp"
#include "hiac/annotate/stamp.hpp"
#include "hiac/annotate/ticks.hpp"
#include "hiac/base/error.hpp"
#include "hiac/frame/background.hpp"

namespace hiac {
namespace {

/// Letters below this size are no letters any more.
constexpr int kLegibleEm = 8;
/// FreeType draws no glyphs that are much larger.
constexpr int kLargestEm = 8192;

Lettering lettering_of(const PictureLength& length, ImageSize size, const std::string& key) {
  const double pixels = length.pixels(size);
  const double most = std::min<double>(std::min(size.width, size.height), kLargestEm);
  if (pixels > most)
    throw InputError(
        fmt::format("key `{}`", key),
        fmt::format("letters of {:.6g} pixels are too large (at most {} expected)", pixels, most));
  return {std::max(1, static_cast<int>(std::lround(pixels)))};
}

std::string time_line(const TimeAnnotation& time, const AnnotationFacts& facts) {
  if (!time.value && facts.time.empty())
    throw InputError("key `annotation.time`", "the mesh has no time (`value` expected)");
  const std::string number = time.value ? fmt::format("{:.6g}", *time.value) : facts.time;
  return "t = " + typeset(number) + (time.unit.empty() ? "" : " " + time.unit);
}

int margin_of(const Annotation& annotation, ImageSize size) {
  return static_cast<int>(std::lround(annotation.margin.pixels(size)));
}

std::vector<AnnotationPart> parts_of(const Annotation& a, const Scene& scene,
                                     const AnnotationFacts& facts, Lettering lettering) {
  const int most = static_cast<int>(scene.image.width) - 2 * margin_of(a, scene.image);
  std::vector<AnnotationPart> parts;
  if (a.title)
    parts.push_back(caption("title", a.title->place, a.title->text,
                            lettering_of(a.title->size, scene.image, "annotation.title.size"),
                            most));
  if (a.time)
    parts.push_back(caption("time", a.time->place, time_line(*a.time, facts),
                            lettering_of(a.time->size, scene.image, "annotation.time.size"), most));
  if (a.axes) parts.push_back(orientation_axes(*a.axes, scene, lettering));
  if (a.scale) parts.push_back(length_scale(*a.scale, scene, lettering));
  if (a.color_bar) {
    const std::string label = a.color_bar->label.value_or(facts.color_label);
    parts.push_back(color_legend(*a.color_bar, scene, label, lettering));
  }
  return parts;
}

}  // namespace

Annotator::Annotator(const Annotation& annotation, const Scene& scene, const AnnotationFacts& facts)
    : annotation_(annotation),
      size_(scene.image),
      background_(scene.background),
      em_(lettering_of(annotation.text_size, size_, "annotation.text_size").em),
      parts_(parts_of(annotation, scene, facts, {em_})),
      boxes_(part_boxes(parts_, size_, margin_of(annotation, size_), (em_ + 1) / 2)) {}

std::vector<std::string> Annotator::doubts() const {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < parts_.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      if (boxes_[j].meets(boxes_[k]))
        lines.push_back(fmt::format("annotation.{} and annotation.{} overlap in the picture",
                                    parts_[j].name, parts_[k].name));
  if (em_ < kLegibleEm && !parts_.empty())
    lines.push_back(fmt::format(
        "letters of {} pixels are hard to read (annotation.text_size = \"{}px\" or more)", em_,
        kLegibleEm));
  return lines;
}

Ink Annotator::ink(std::size_t part) const {
  constexpr std::int64_t kSamples = 16;  // along each side
  const PixelBox& box = boxes_[part];
  double sum = 0;
  for (std::int64_t j = 0; j < kSamples; ++j)
    for (std::int64_t i = 0; i < kSamples; ++i) {
      const std::int64_t x = box.x + (2 * i + 1) * box.width / (2 * kSamples);
      const std::int64_t y = box.y + (2 * j + 1) * box.height / (2 * kSamples);
      sum += luminance(background_at(background_, size_, static_cast<std::uint32_t>(x),
                                     static_cast<std::uint32_t>(y)));
    }
  return ink_on(sum / (kSamples * kSamples), annotation_.color);
}

void Annotator::draw(Image& picture, const PixelRect& part, bool opaque) const {
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Ink colors = ink(k);
    Canvas canvas(parts_[k].width, parts_[k].height);
    parts_[k].draw(canvas, colors);
    stamp(picture, canvas, boxes_[k].x - part.x, boxes_[k].y - part.y, Lettering{em_}.halo(),
          colors.halo, opaque);
  }
}

}  // namespace hiac
