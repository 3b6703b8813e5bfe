#include "formats/xdmf/attributes.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace hiac::formats::xdmf {

void Attributes::add_all(std::size_t grid) {
  for (const pugi::xml_node attribute : grids_[grid].attributes) add(grid, attribute);
}

void Attributes::add(std::size_t grid, const pugi::xml_node& attribute) {
  std::string center = attribute.attribute("Center").as_string("Node");
  for (const std::string_view known : {"Node", "Cell"})
    if (same_word(center, known)) center = known;
  const std::string name = attribute.attribute("Name").as_string("attribute");
  if (std::string_view(attribute.attribute("ItemType").as_string()) == "FiniteElementFunction" ||
      (center != "Node" && center != "Cell")) {
    notes_.push_back(fmt::format("left out '{}', which lives on {}", name,
                                 center == "Node" ? "degrees of freedom" : center));
    return;
  }
  const FieldLocation location = center == "Node" ? FieldLocation::node : FieldLocation::cell;
  const std::size_t count =
      location == FieldLocation::node ? grids_[grid].points : grids_[grid].cells;
  const pugi::xml_node item = items_.item_in(attribute);
  std::uint64_t size = 1;
  for (const std::uint64_t extent : items_.shape(item))
    if (__builtin_mul_overflow(size, extent, &size)) size = ~std::uint64_t{0};
  if (count == 0 || size % count != 0 || size / count == 0 || size / count > 1000)
    items_.fail(attribute, fmt::format("has {} numbers for {} {}s", size, count,
                                       center == "Node" ? "point" : "cell"));
  const auto components = static_cast<std::uint32_t>(size / count);
  auto known = std::find_if(fields_.begin(), fields_.end(), [&](const FieldParts& field) {
    return field.name == name && field.location == location && field.components == components;
  });
  if (known == fields_.end())
    known = fields_.insert(fields_.end(), {name, location, components, items_.type(item), {}});
  known->items.resize(grids_.size());
  known->items[grid] = item;
}

}  // namespace hiac::formats::xdmf
