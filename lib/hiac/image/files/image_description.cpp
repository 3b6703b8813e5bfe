#include "hiac/image/files/image_description.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace hiac::image_files {

using Json = nlohmann::ordered_json;

std::string to_description(const Attributes& attributes) {
  if (attributes.empty()) return {};
  Json object = Json::object();
  for (const auto& [name, text] : attributes) object[name] = text;
  return object.dump(-1, ' ', true, Json::error_handler_t::replace);
}

Attributes from_description(std::string_view text) {
  const Json found = Json::parse(text, nullptr, false);
  if (!found.is_object() ||
      !std::ranges::all_of(found, [](const Json& value) { return value.is_string(); }))
    return {{"ImageDescription", std::string(text)}};
  Attributes attributes;
  for (const auto& [name, value] : found.items())
    attributes.emplace_back(name, value.get<std::string>());
  return attributes;
}

}  // namespace hiac::image_files
