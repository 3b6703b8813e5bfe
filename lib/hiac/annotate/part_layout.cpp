#include "hiac/annotate/part_layout.hpp"

#include <fmt/format.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

using Place = AnnotationPlace;

/// 0 at the left or upper edge, 1 in the middle, 2 at the right or lower edge.
struct Anchor {
  int column, row;
};

Anchor anchor_of(Place place) {
  switch (place) {
    case Place::top_left:
      return {0, 0};
    case Place::top:
      return {1, 0};
    case Place::top_right:
      return {2, 0};
    case Place::left:
      return {0, 1};
    case Place::right:
      return {2, 1};
    case Place::bottom_left:
      return {0, 2};
    case Place::bottom:
      return {1, 2};
    case Place::bottom_right:
      return {2, 2};
  }
  return {0, 0};
}

std::int64_t start_of(int anchor, std::int64_t extent, std::int64_t whole, std::int64_t margin) {
  if (anchor == 0) return margin;
  return anchor == 1 ? (whole - extent) / 2 : whole - margin - extent;
}

void require_inside(const AnnotationPart& part, const PixelBox& box, ImageSize size) {
  if (box.x >= 0 && box.y >= 0 && box.x + box.width <= size.width &&
      box.y + box.height <= size.height)
    return;
  throw InputError(fmt::format("key `annotation.{}`", part.name),
                   fmt::format("does not fit the picture ({} x {} pixels at {},{} of {} x {})",
                               part.width, part.height, box.x, box.y, size.width, size.height));
}

}  // namespace

std::vector<PixelBox> part_boxes(std::span<const AnnotationPart> parts, ImageSize size, int margin,
                                 int gap) {
  std::vector<PixelBox> boxes;
  for (const AnnotationPart& part : parts) {
    // what stands above it in the same place, and all that is there
    std::int64_t above = 0, whole = -gap;
    for (const AnnotationPart& other : parts) {
      if (other.place != part.place) continue;
      if (&other < &part) above += other.height + gap;
      whole += other.height + gap;
    }
    const Anchor anchor = anchor_of(part.place);
    const PixelBox box{start_of(anchor.column, part.width, size.width, margin),
                       start_of(anchor.row, whole, size.height, margin) + above, part.width,
                       part.height};
    require_inside(part, box, size);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace hiac
