#include "hiac/scene/toml/spec_value.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/scene/scene.hpp"
#include "hiac/scene/toml/spec_text.hpp"

namespace hiac {
namespace {

/// True when `path` is `ancestor` or lies below it.
bool lies_in(std::string_view path, std::string_view ancestor) {
  return path.starts_with(ancestor) &&
         (path.size() == ancestor.size() || path[ancestor.size()] == '.');
}

const char* kind_name(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a truth value";
    default:
      return "a date or time";
  }
}

}  // namespace

const AppliedOverride* SpecContext::override_of(std::string_view path) const {
  for (auto o = overrides.rbegin(); o != overrides.rend(); ++o)
    if (lies_in(path, o->path) || lies_in(o->path, path)) return &*o;
  return nullptr;
}

void SpecContext::fail(const std::string& path, std::uint32_t line, const std::string& what) const {
  if (const AppliedOverride* blamed = override_of(path))
    throw UsageError(in_one_line(fmt::format("{}: key `{}`: {}", blamed->option, path, what)));
  const std::string where = line > 0 ? fmt::format("{}:{}", subject, line) : subject;
  throw InputError(where, in_one_line(fmt::format("key `{}`: {}", path, what)));
}

void SpecValue::fail(const std::string& what) const {
  context_->fail(path_, node_->source().begin.line, what);
}

void SpecValue::fail_bright(double component) const {
  fail(fmt::format("too bright (expected at most {}, found {})", kLargestColor, component));
}

void SpecValue::fail_kind(const char* expected) const {
  fail(fmt::format("wrong type (expected {}, found {})", expected, kind_name(*node_)));
}

void SpecValue::fail_name(const std::string& found, const std::string& known) const {
  fail(fmt::format("no such choice (expected one of {}, found {})", known, found));
}

double SpecValue::number_or_infinity() const {
  if (const auto* integer = node_->as_integer()) return static_cast<double>(integer->get());
  const auto* floating = node_->as_floating_point();
  if (floating == nullptr) fail_kind("a number");
  if (std::isnan(floating->get())) fail("not a number (expected a number, found nan)");
  return floating->get();
}

double SpecValue::at_least_finite(double smallest) const {
  const double value = number_or_infinity();
  if (std::isinf(value)) fail("not finite (expected a finite number, found inf)");
  if (value < smallest)
    fail(fmt::format("too small (expected at least {}, found {})", smallest, value));
  return value;
}

double SpecValue::number() const {
  const double value = at_least_finite(-std::numeric_limits<double>::max());
  if (std::abs(value) > kLargestNumber)
    fail(fmt::format("too large (expected at most {} in magnitude, found {})", kLargestNumber,
                     value));
  return value;
}

double SpecValue::positive() const {
  const double value = number();
  if (!(value > 0)) fail(fmt::format("expected a positive number, found {}", value));
  if (value < 1 / kLargestNumber)
    fail(fmt::format("too small (expected at least {}, found {})", 1 / kLargestNumber, value));
  return value;
}

double SpecValue::at_least(double smallest) const {
  const double value = number();
  if (value < smallest)
    fail(fmt::format("too small (expected at least {}, found {})", smallest, value));
  return value;
}

double SpecValue::inside(double low, double high) const {
  const double value = number();
  if (value < low || value > high)
    fail(fmt::format("out of range (expected {} to {}, found {})", low, high, value));
  return value;
}

std::uint32_t SpecValue::whole(std::uint32_t low, std::uint32_t high) const {
  const double value = number();
  if (value != std::floor(value)) fail(fmt::format("expected a whole number, found {}", value));
  return static_cast<std::uint32_t>(inside(low, high));
}

bool SpecValue::truth() const {
  const auto* boolean = node_->as_boolean();
  if (boolean == nullptr) fail_kind("true or false");
  return boolean->get();
}

std::string SpecValue::text() const {
  const auto* string = node_->as_string();
  if (string == nullptr) fail_kind("a string");
  if (string->get().empty()) fail("empty (expected a string with something in it)");
  return string->get();
}

std::vector<SpecValue> SpecValue::list(std::size_t count) const {
  const auto* array = node_->as_array();
  if (array == nullptr) fail_kind("a list");
  if (count != 0 && array->size() != count)
    fail(
        fmt::format("wrong length (expected a list of {} values, found {})", count, array->size()));
  std::vector<SpecValue> elements;
  elements.reserve(array->size());
  for (const toml::node& element : *array) elements.emplace_back(element, path_, *context_);
  return elements;
}

std::array<double, 3> SpecValue::triple() const {
  const std::vector<SpecValue> elements = list(3);
  return {elements[0].number(), elements[1].number(), elements[2].number()};
}

std::array<double, 3> SpecValue::color() const {
  const std::array<double, 3> rgb = triple();
  for (const double channel : rgb)
    if (channel < 0)
      fail(fmt::format("a colour is not negative (found {})", channel));
    else if (channel > kLargestColor)
      fail_bright(channel);
  return rgb;
}

const toml::table& SpecValue::table() const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) fail_kind("a table");
  return *table;
}

const toml::node* SpecValue::find(std::string_view key) const { return table().get(key); }

std::string SpecValue::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

SpecValue SpecValue::child(std::string_view key) const {
  return {*find(key), path_of(key), *context_};
}

void SpecValue::fail_at(std::string_view key, const std::string& what) const {
  const toml::node* node = find(key);
  // the text as a whole starts at line 1, which would not help the user
  const bool whole_text = node == nullptr && path_.empty();
  const toml::node& nearest = node != nullptr ? *node : *node_;
  context_->fail(path_of(key), whole_text ? 0 : nearest.source().begin.line, what);
}

std::vector<SpecValue> SpecValue::tables() const {
  const auto* array = node_->as_array();
  if (array == nullptr) fail_kind("a list of tables");
  std::vector<SpecValue> elements;
  for (const toml::node& element : *array) {
    const SpecValue& added =
        elements.emplace_back(element, fmt::format("{}.{}", path_, elements.size()), *context_);
    if (!element.is_table()) added.fail_kind("a table");
  }
  return elements;
}

}  // namespace hiac
