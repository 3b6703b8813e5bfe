#include <charconv>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hiac/base/error.hpp"
#include "hiac/base/parallel.hpp"
#include "hiac/mesh/fields/find_field.hpp"
#include "hiac/mesh/fields/tensor_invariants.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {
namespace {

constexpr std::size_t kScalarFieldGrain = 1 << 14;
constexpr std::string_view kMagnitude = "magnitude", kValue = "value";

/// Returns the names of a vector's or a tensor's components; none for other counts.
std::span<const std::string_view> component_names(std::uint32_t components) {
  static constexpr std::array<std::string_view, 3> kVector{"x", "y", "z"};
  static constexpr std::array<std::string_view, 6> kSymmetric{"xx", "yy", "zz", "xy", "yz", "xz"};
  static constexpr std::array<std::string_view, 9> kTensor{"xx", "xy", "xz", "yx", "yy",
                                                           "yz", "zx", "zy", "zz"};
  if (components == 2 || components == 3) return std::span(kVector).first(components);
  if (components == 6) return kSymmetric;
  if (components == 9) return kTensor;
  return {};
}

/// A scalar of a symmetric tensor.
struct Invariant {
  std::string_view name;
  double (*of)(const SymmetricTensor&);
};

/// Returns the scalars of tensors (fields of six or nine components); none for other counts.
std::span<const Invariant> invariants(std::uint32_t components) {
  static constexpr std::array<Invariant, 6> kInvariants{
      {{"von_mises", von_mises},
       {"tresca", tresca},
       {"trace", trace},
       {"principal_1", [](const SymmetricTensor& t) { return principal_values(t)[0]; }},
       {"principal_2", [](const SymmetricTensor& t) { return principal_values(t)[1]; }},
       {"principal_3", [](const SymmetricTensor& t) { return principal_values(t)[2]; }}}};
  if (components == 6 || components == 9) return kInvariants;
  return {};
}

/// Returns the component that `suffix` names, by letter or by number.
std::optional<std::uint32_t> component_of(std::string_view suffix, std::uint32_t components) {
  const auto names = component_names(components);
  for (std::uint32_t c = 0; c < names.size(); ++c)
    if (names[c] == suffix) return c;
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(suffix.data(), suffix.data() + suffix.size(), number);
  if (error != std::errc() || end != suffix.data() + suffix.size() || number >= components)
    return std::nullopt;
  return number;
}

/// Returns a field with one number per tuple of `field`: `reduce(tuple)`.
template <typename Reduce>
Field reduced(const Field& field, const std::string& name, const Reduce& reduce) {
  const auto values = field.values.view();
  const std::size_t width = field.components;
  std::vector<double> result(values.size() / width);
  parallel_for(result.size(), kScalarFieldGrain, [&](IndexRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      result[i] = reduce(values.subspan(i * width, width));
  });
  return {name, field.unit, field.location, 1, SharedArray<double>(std::move(result))};
}

Field magnitude(const Field& field, const std::string& name) {
  return reduced(field, name, [](std::span<const double> tuple) {
    double length = std::abs(tuple[0]);
    // hypot: squares of large values would overflow, those of tiny ones vanish
    for (std::size_t c = 1; c < tuple.size(); ++c) length = std::hypot(length, tuple[c]);
    return length;
  });
}

/// The coordinates of the nodes, which a field of the mesh of this name goes before.
constexpr std::string_view kPosition = "position";

Field coordinate(const ZooMesh& mesh, const std::string& name, std::uint32_t axis) {
  std::vector<double> values(mesh.node_count());
  for (NodeId node = 0; node < values.size(); ++node) values[node] = mesh.position(node)[axis];
  return {name, "", FieldLocation::node, 1, SharedArray<double>(std::move(values))};
}

[[noreturn]] void refuse(const ZooMesh& mesh, const std::string& reference) {
  const std::vector<std::string> names = scalar_field_names(mesh);
  throw UsageError(
      names.empty()
          ? fmt::format("field '{}': there is no such field (the mesh has none)", reference)
          : fmt::format("field '{}': there is no such scalar field (expected one of "
                        "{})",
                        reference, fmt::join(names, ", ")));
}

}  // namespace

std::vector<std::string> scalar_field_names(const ZooMesh& mesh) {
  std::vector<std::string> names;
  for (const Field& field : mesh.fields) {
    const std::string name = distinct_name(mesh, field);
    if (field.components == 1) {
      names.push_back(name);
      continue;
    }
    const auto components = component_names(field.components);
    for (std::uint32_t c = 0; c < field.components; ++c)
      names.push_back(components.empty() ? fmt::format("{}:{}", name, c)
                                         : fmt::format("{}:{}", name, components[c]));
    names.push_back(fmt::format("{}:{}", name, kMagnitude));
    for (const Invariant& invariant : invariants(field.components))
      names.push_back(fmt::format("{}:{}", name, invariant.name));
  }
  return names;
}

Field scalar_field(const ZooMesh& mesh, const std::string& reference) {
  // the whole name is tried first, as names may contain colons
  if (const Field* field = find_field(mesh, reference); field != nullptr && field->components == 1)
    return *field;
  const std::size_t colon = reference.rfind(':');
  if (colon == std::string::npos) refuse(mesh, reference);
  const std::string_view suffix = std::string_view(reference).substr(colon + 1);
  const std::string_view name = std::string_view(reference).substr(0, colon);
  const Field* field = find_field(mesh, name);
  if (field == nullptr && name == kPosition)
    if (const auto axis = component_of(suffix, 3)) return coordinate(mesh, reference, *axis);
  if (field == nullptr) refuse(mesh, reference);
  if (suffix == kValue && field->components == 1) return *field;
  if (suffix == kMagnitude || suffix == kValue) return magnitude(*field, reference);
  for (const Invariant& invariant : invariants(field->components))
    if (suffix == invariant.name)
      return reduced(*field, reference,
                     [&](auto tuple) { return invariant.of(*symmetric_tensor(tuple)); });
  const auto component = component_of(suffix, field->components);
  if (!component) refuse(mesh, reference);
  return reduced(*field, reference, [c = *component](auto tuple) { return tuple[c]; });
}

}  // namespace hiac
