#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <pugixml.hpp>

namespace hiac::paraview {

/// One proxy of a state: an object of ParaView's server manager with its properties.
class Proxy {
 public:
  Proxy(pugi::xml_node node, const std::string& subject) : node_(node), subject_(&subject) {}

  [[nodiscard]] std::string group() const { return node_.attribute("group").as_string(); }
  [[nodiscard]] std::string type() const { return node_.attribute("type").as_string(); }
  [[nodiscard]] std::string id() const { return node_.attribute("id").as_string(); }

  [[nodiscard]] bool has(const char* property) const { return !property_of(property).empty(); }

  /// The values of a property, in order; none where the state lacks it.
  [[nodiscard]] std::vector<std::string> texts(const char* property) const;
  /// Its first value, or "".
  [[nodiscard]] std::string text(const char* property) const;
  /// The same as numbers. Throw InputError for one that is not a finite number; `numbers` with a
  /// count also for fewer or more.
  [[nodiscard]] std::vector<double> numbers(const char* property) const;
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(const char* property) const {
    const std::vector<double> found = numbers(property);
    if (found.size() != N) fail_count(property, N, found.size());
    std::array<double, N> result;
    for (std::size_t i = 0; i < N; ++i) result[i] = found[i];
    return result;
  }
  [[nodiscard]] double number(const char* property, double otherwise) const;
  [[nodiscard]] bool flag(const char* property) const { return number(property, 0) != 0; }

  /// The identifiers of the proxies that a property refers to.
  [[nodiscard]] std::vector<std::string> references(const char* property) const;

  /// Throws InputError "FILE: TYPE ID: PROPERTY: what is wrong".
  [[noreturn]] void fail(const char* property, const std::string& what) const;

 private:
  [[nodiscard]] pugi::xml_node property_of(const char* property) const;
  [[noreturn]] void fail_count(const char* property, std::size_t wanted, std::size_t found) const;

  pugi::xml_node node_;
  const std::string* subject_;
};

/// A state (.pvsm) or camera (.pvcc) file of ParaView as it is: XML of proxies.
class StateDocument {
 public:
  /// Throws InputError if the file cannot be read or is neither of the two.
  explicit StateDocument(const std::string& path);
  StateDocument(const StateDocument&) = delete;
  StateDocument& operator=(const StateDocument&) = delete;

  [[nodiscard]] const std::string& subject() const { return subject_; }
  /// The version of ParaView that saved the state, or "".
  [[nodiscard]] const std::string& version() const { return version_; }
  /// The view of a camera file, which holds no more than a camera.
  [[nodiscard]] std::optional<Proxy> camera() const;

  /// All proxies of a group and a type, in the file's order.
  [[nodiscard]] std::vector<Proxy> all(const std::string& group, const std::string& type) const;
  /// The proxy of an identifier; none where the state lacks it.
  [[nodiscard]] std::optional<Proxy> find(const std::string& id) const;
  /// The proxy that a property refers to first; none where it refers to none.
  [[nodiscard]] std::optional<Proxy> referred(const Proxy& proxy, const char* property) const;
  /// The name under which ParaView shows a proxy, or its type.
  [[nodiscard]] std::string name(const Proxy& proxy) const;

 private:
  void read_manager(const pugi::xml_node& manager);

  std::string subject_, version_;
  pugi::xml_document document_;
  std::vector<pugi::xml_node> proxies_;
  std::unordered_map<std::string, std::size_t> by_id_;
  std::unordered_map<std::string, std::string> names_;
  pugi::xml_node camera_;
};

/// Whether a text begins like XML, as no specification does.
bool is_xml(const std::string& text);

}  // namespace hiac::paraview
