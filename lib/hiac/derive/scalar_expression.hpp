#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// An expression of scalars (derive_field), with its names resolved.
class ScalarExpression {
 public:
  /// Throws UsageError if the text is not understood or a name is unknown.
  ScalarExpression(const ZooMesh& mesh, std::string_view text);

  /// The fields that the expression names, without the coordinates.
  [[nodiscard]] const std::vector<Field>& fields() const { return fields_; }

  /// The field's unit if the expression is a field and nothing else; otherwise empty.
  [[nodiscard]] std::string unit() const { return text_ == "f0" ? fields_[0].unit : ""; }

  /// Returns the values at every node, cell or corner; a field's location must be `location` or, at
  /// corners, any. `mesh` is the one that the expression was made for.
  [[nodiscard]] std::vector<double> values(const ZooMesh& mesh, FieldLocation location) const;

 private:
  class Translation;

  std::string text_;            // for muParser: field k is f{k}, coordinate d is x{d}
  std::vector<Field> fields_;   // scalars
  bool with_position_ = false;  // whether coordinates are named
};

/// Returns the location at which all fields have values. Throws UsageError for fields of nodes and
/// of cells without one of corners.
FieldLocation common_location(const std::vector<Field>& fields);

/// Returns the place behind the parenthesis or quotation mark that closes the one at `open`; npos
/// if there is none.
std::size_t behind_closing(std::string_view text, std::size_t open);

/// Returns the text without white space at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace hiac
