#include "hiac/scene/toml/spec_override.hpp"

#include <optional>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/toml/spec_path.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& what) {
  throw UsageError(in_one_line(option) + ": " + what);
}

/// Parses VALUE as TOML, into a table with the single key "v"; text that is not TOML becomes a
/// string.
toml::table parse_value(const std::string& value) {
  try {
    toml::table parsed = parse_toml("v = " + value, "");
    if (parsed.size() == 1) return parsed;
  } catch (const InputError&) {
    // a bare word
  }
  toml::table text;
  text.insert("v", value);
  return text;
}

/// Steps into `part` of a table, and adds it if it does not exist: a list if an index follows,
/// otherwise a table.
toml::node& step_into_table(toml::table& table, const std::string& part, bool index_follows) {
  if (table.get(part) == nullptr) {
    if (index_follows)
      table.insert(part, toml::array{});
    else
      table.insert(part, toml::table{});
  }
  return *table.get(part);
}

std::size_t checked_index(const toml::array& array, const std::string& part, std::size_t limit,
                          const std::string& option) {
  const std::optional<std::size_t> index = as_index(part);
  if (!index || *index >= limit)
    refuse(option,
           fmt::format("no element `{}` (the list has {}, counted from 0)", part, array.size()));
  return *index;
}

toml::node& step_into(toml::node& node, const std::string& part, bool index_follows,
                      const std::string& option) {
  if (toml::table* table = node.as_table()) return step_into_table(*table, part, index_follows);
  toml::array* array = node.as_array();
  if (array == nullptr) refuse(option, fmt::format("`{}` lies below a plain value", part));
  const std::size_t index = checked_index(*array, part, array->size() + 1, option);
  if (index == array->size()) array->push_back(toml::table{});
  return *array->get(index);
}

void set_last(toml::node& node, const std::string& part, const toml::node& value,
              const std::string& option) {
  toml::table* table = node.as_table();
  toml::array* array = node.as_array();
  if (table == nullptr && array == nullptr)
    refuse(option, fmt::format("`{}` lies below a plain value", part));
  value.visit([&](const auto& concrete) {
    if (table != nullptr) {
      table->insert_or_assign(part, concrete);
      return;
    }
    const std::size_t index = checked_index(*array, part, array->size() + 1, option);
    if (index == array->size())
      array->push_back(concrete);
    else
      array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), concrete);
  });
}

void remove_last(toml::node& node, const std::string& part, const std::string& option) {
  if (toml::table* table = node.as_table()) {
    table->erase(part);
  } else if (toml::array* array = node.as_array()) {
    const std::size_t index = checked_index(*array, part, array->size(), option);
    array->erase(array->cbegin() + static_cast<std::ptrdiff_t>(index));
  } else {
    refuse(option, fmt::format("`{}` lies below a plain value", part));
  }
}

}  // namespace

AppliedOverride apply_override(toml::table& document, const std::string& option) {
  const std::string& shown = option;
  const std::size_t equals = option.find('=');
  if (equals == std::string::npos) refuse(shown, "expected KEY=VALUE");
  const std::string path = option.substr(0, equals);
  const std::string value = option.substr(equals + 1);
  const std::optional<SpecPath> found = spec_path(path);
  if (!found) refuse(shown, "malformed key (expected KEY=VALUE with a key such as camera.fov)");
  const SpecPath& parts = *found;

  toml::node* node = &document;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i)
    node = &step_into(*node, parts[i], as_index(parts[i + 1]).has_value(), shown);
  if (value.empty())
    remove_last(*node, parts.back(), shown);
  else
    set_last(*node, parts.back(), *parse_value(value).get("v"), shown);
  return {path, in_one_line(shown)};
}

}  // namespace hiac
