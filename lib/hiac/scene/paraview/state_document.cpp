#include "hiac/scene/paraview/state_document.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac::paraview {

std::vector<std::string> Proxy::texts(const char* property) const {
  std::vector<std::string> values;
  for (const pugi::xml_node& element : property_of(property).children("Element"))
    values.emplace_back(element.attribute("value").as_string());
  return values;
}

std::string Proxy::text(const char* property) const {
  return property_of(property).child("Element").attribute("value").as_string();
}

std::vector<double> Proxy::numbers(const char* property) const {
  std::vector<double> values;
  for (const std::string& text : texts(property)) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(property, fmt::format("expected a finite number, found \"{:.40}\"", text));
    values.push_back(value);
  }
  return values;
}

double Proxy::number(const char* property, double otherwise) const {
  const std::vector<double> found = numbers(property);
  return found.empty() ? otherwise : found.front();
}

std::vector<std::string> Proxy::references(const char* property) const {
  std::vector<std::string> ids;
  for (const pugi::xml_node& proxy : property_of(property).children("Proxy"))
    ids.emplace_back(proxy.attribute("value").as_string());
  return ids;
}

void Proxy::fail(const char* property, const std::string& what) const {
  throw InputError(*subject_,
                   in_one_line(fmt::format("{} {}: {}: {}", type(), id(), property, what)));
}

pugi::xml_node Proxy::property_of(const char* property) const {
  return node_.find_child_by_attribute("Property", "name", property);
}

void Proxy::fail_count(const char* property, std::size_t wanted, std::size_t found) const {
  fail(property, fmt::format("expected {} numbers, found {}", wanted, found));
}

StateDocument::StateDocument(const std::string& path) : subject_(path) {
  const std::string text = read_text_file(path);
  const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
  if (!result) throw InputError(path, fmt::format("malformed XML ({})", result.description()));
  const pugi::xml_node root = document_.document_element();
  if (root.name() == std::string_view("PVCameraConfiguration")) {
    camera_ = root.child("Proxy");
    if (camera_.empty()) throw InputError(path, "is a camera file of ParaView without a camera");
    return;
  }
  const bool is_inner = root.name() == std::string_view("ServerManagerState");
  const pugi::xml_node manager = is_inner ? root : root.child("ServerManagerState");
  if (manager.empty())
    throw InputError(path, in_one_line(fmt::format(
                               "is XML, but no state or camera of ParaView (expected "
                               "<ServerManagerState> or <PVCameraConfiguration>, found <{:.40}>)",
                               root.name())));
  read_manager(manager);
}

void StateDocument::read_manager(const pugi::xml_node& manager) {
  version_ = manager.attribute("version").as_string();
  for (const pugi::xml_node& proxy : manager.children("Proxy")) {
    by_id_.emplace(proxy.attribute("id").as_string(), proxies_.size());
    proxies_.push_back(proxy);
  }
  for (const char* collection : {"sources", "views", "representations", "lookup_tables"})
    for (const pugi::xml_node& item :
         manager.find_child_by_attribute("ProxyCollection", "name", collection).children("Item"))
      names_.emplace(item.attribute("id").as_string(), item.attribute("name").as_string());
}

std::optional<Proxy> StateDocument::camera() const {
  if (camera_.empty()) return std::nullopt;
  return Proxy(camera_, subject_);
}

std::vector<Proxy> StateDocument::all(const std::string& group, const std::string& type) const {
  std::vector<Proxy> found;
  for (const pugi::xml_node& node : proxies_) {
    const Proxy proxy(node, subject_);
    if (proxy.group() == group && proxy.type() == type) found.push_back(proxy);
  }
  return found;
}

std::optional<Proxy> StateDocument::find(const std::string& id) const {
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return std::nullopt;
  return Proxy(proxies_[found->second], subject_);
}

std::optional<Proxy> StateDocument::referred(const Proxy& proxy, const char* property) const {
  const std::vector<std::string> ids = proxy.references(property);
  return ids.empty() ? std::nullopt : find(ids.front());
}

std::string StateDocument::name(const Proxy& proxy) const {
  const auto found = names_.find(proxy.id());
  return in_one_line(found == names_.end() ? proxy.type() : found->second);
}

bool is_xml(const std::string& text) {
  const std::size_t start = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
  return start != std::string::npos && text[start] == '<';
}

}  // namespace hiac::paraview
