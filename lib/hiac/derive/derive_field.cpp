#include "hiac/derive/derive_field.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/derive/averages.hpp"
#include "hiac/derive/scalar_expression.hpp"
#include "hiac/mesh/fields/find_field.hpp"
#include "hiac/mesh/fields/tensor_invariants.hpp"

namespace hiac {
namespace {

constexpr std::size_t kDeriveFieldGrain = 1 << 14;

// FUNCTION(ARGUMENT), if that is all of the text.
struct Call {
  std::string_view function, argument;
};
std::optional<Call> as_call(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || open == 0) return std::nullopt;
  if (behind_closing(text, open) != text.size()) return std::nullopt;
  return Call{trimmed(text.substr(0, open)),
              trimmed(text.substr(open + 1, text.size() - open - 2))};
}

// The arguments of a call: what commas outside parentheses and quotation marks part.
std::vector<std::string_view> arguments_of(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t first = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(' || text[i] == '"') {
      i = std::min(behind_closing(text, i), text.size()) - 1;
    } else if (text[i] == ',') {
      parts.push_back(trimmed(text.substr(first, i - first)));
      first = i + 1;
    }
  }
  parts.push_back(trimmed(text.substr(first)));
  return parts;
}

// The field with that name, quoted or not, with its location or without.
const Field& field_named(const ZooMesh& mesh, std::string_view argument) {
  std::string name(argument);
  std::erase(name, '"');
  if (const Field* field = find_field(mesh, name)) return *field;
  std::string names;
  for (const Field& field : mesh.fields)
    names += (names.empty() ? "" : ", ") + distinct_name(mesh, field);
  throw UsageError(fmt::format("field '{}': there is no such field ({})", name,
                               names.empty() ? "the mesh has none" : "expected one of " + names));
}

// A field with `width` numbers for every tuple of a tensor field: `of(tensor)`.
template <std::size_t kWidth, typename Of>
Field of_tensor(const Field& field, const Of& of) {
  const std::size_t width = field.components;
  if (width != 6 && width != 9)
    throw UsageError(fmt::format("field '{}' has {} components (a tensor of 6 or 9 expected)",
                                 field.name, width));
  const std::size_t count = field.values.size() / width;
  std::vector<double> values(count * kWidth);
  parallel_for(count, kDeriveFieldGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto result = of(*symmetric_tensor(field.values.view().subspan(i * width, width)));
      std::ranges::copy(result, values.begin() + static_cast<std::ptrdiff_t>(i * kWidth));
    }
  });
  return {field.name, field.unit, field.location, kWidth, SharedArray<double>(std::move(values))};
}

// One component for every expression.
Field put_together(const ZooMesh& mesh, std::span<const std::string_view> texts) {
  std::vector<ScalarExpression> parts;
  std::vector<Field> named;
  for (const std::string_view text : texts) {
    parts.emplace_back(mesh, text);
    named.insert(named.end(), parts.back().fields().begin(), parts.back().fields().end());
  }
  Field field;
  field.location = common_location(named);
  field.components = static_cast<std::uint32_t>(parts.size());
  std::vector<double> values;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const std::vector<double> column = parts[c].values(mesh, field.location);
    values.resize(column.size() * parts.size());
    for (std::size_t i = 0; i < column.size(); ++i) values[i * parts.size() + c] = column[i];
  }
  if (parts.size() == 1) field.unit = parts[0].unit();
  field.values = SharedArray<double>(std::move(values));
  return field;
}

void require_arguments(std::string_view function, std::size_t expected, std::size_t found) {
  if (found != expected)
    throw UsageError(fmt::format("{}: {} arguments expected, {} found", function, expected, found));
}

Field computed(const ZooMesh& mesh, std::string_view text) {
  if (const std::optional<Call> call = as_call(text)) {
    const auto& [function, argument] = *call;
    const auto arguments = arguments_of(argument);
    if (function == "vector" || function == "tensor") {
      require_arguments(function, function == "vector" ? 3 : 6, arguments.size());
      return put_together(mesh, arguments);
    }
    if (function == "deviator") return of_tensor<6>(field_named(mesh, argument), deviator);
    if (function == "principal") return of_tensor<3>(field_named(mesh, argument), principal_values);
    const auto average = function == "node_average"   ? node_average
                         : function == "cell_average" ? cell_average
                                                      : nullptr;
    if (average != nullptr && argument.find(':') == std::string_view::npos)
      return average(mesh, field_named(mesh, argument));
  }
  const std::array<std::string_view, 1> whole{text};
  return put_together(mesh, whole);
}

}  // namespace

Field derive_field(const ZooMesh& mesh, const std::string& formula) try {
  const std::size_t equals = formula.find('=');
  const std::string_view name = trimmed(std::string_view(formula).substr(0, equals));
  const std::string_view text = equals == std::string::npos
                                    ? std::string_view()
                                    : trimmed(std::string_view(formula).substr(equals + 1));
  if (name.empty() || text.empty()) throw UsageError("not understood (NAME=EXPRESSION expected)");
  Field field = computed(mesh, text);
  field.name = name;
  for (const Field& other : mesh.fields)
    if (other.name == field.name && other.location == field.location)
      throw UsageError(fmt::format("there is already a field '{}'", field.name));
  return field;
} catch (const UsageError& error) {
  throw UsageError(fmt::format("derive {}: {}", formula, error.what()));
}

}  // namespace hiac
