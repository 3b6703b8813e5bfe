#include "tools/view/document/known_ranges.hpp"

#include <utility>

namespace hiac::view {

std::array<std::optional<KnownRanges::Key>, 3> KnownRanges::keys_of(const ParsedScene& parsed) {
  const auto key = [](const auto& wanted, const auto& transfer) -> std::optional<Key> {
    if (!wanted) return std::nullopt;
    return Key{transfer->field, wanted->percents, wanted->logarithmic};
  };
  const Volume& volume = parsed.scene.volume;
  return {key(parsed.color, volume.color), key(parsed.extinction, volume.extinction),
          parsed.scene.skin ? key(parsed.skin_color, parsed.scene.skin->color_by) : std::nullopt};
}

ParsedScene KnownRanges::place(ParsedScene parsed, const ZooMesh& mesh) {
  auto keys = keys_of(parsed);
  if (!found_ || found_->keys != keys) {
    found_.reset();
    FieldRanges ranges(parsed);
    ranges.add(mesh);
    found_.emplace(std::move(keys), std::move(ranges));
  }
  return found_->ranges.place(std::move(parsed));
}

}  // namespace hiac::view
