#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/field_range.hpp"

namespace hiac::view {

/// The ranges of fields that a specification leaves to the mesh, found once for any number of edits
/// that leave fields and percentiles as they are.
class KnownRanges {
 public:
  /// What with_field_ranges (session.hpp) returns, and throws.
  ParsedScene place(ParsedScene parsed, const ZooMesh& mesh);

  /// The mesh is another one from now on.
  void forget() { found_.reset(); }

 private:
  // what decides one range
  struct Key {
    std::string field;
    std::array<double, 2> percents;
    bool logarithmic;
    bool operator==(const Key&) const = default;
  };
  struct Found {
    std::array<std::optional<Key>, 3> keys;  // colour, extinction, skin
    FieldRanges ranges;
  };
  static std::array<std::optional<Key>, 3> keys_of(const ParsedScene& parsed);

  std::optional<Found> found_;
};

}  // namespace hiac::view
