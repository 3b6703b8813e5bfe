#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "formats/vtk/legacy/legacy_layout.hpp"
#include "formats/vtk/legacy/legacy_values.hpp"
#include "formats/vtk/legacy/legacy_words.hpp"

namespace hiac::formats::vtk {

/// The attributes of a legacy file's points and cells: SCALARS, VECTORS, FIELD and others. Throws
/// through `words`.
class LegacyAttributes {
 public:
  /// `layout` has the numbers of points and cells, and gets the attributes.
  LegacyAttributes(LegacyWords& words, LegacyLayout& layout) : words_(words), layout_(layout) {}

  /// Walks through the attribute, or the lookup table, after its keyword.
  void read(const std::string& keyword, bool on_points);

  /// Walks through FIELD name n and its n arrays, after the keyword. In point and cell data each
  /// array has a tuple per point or cell; arrays of neither are not attributes.
  void read_field(std::optional<bool> on_points);

 private:
  /// After "SCALARS name type": the optional number of components, then LOOKUP_TABLE and its name.
  std::size_t scalar_components();
  void read_lookup_table();
  void keep(const std::string& name, const NumberType& type, std::size_t tuples,
            std::size_t components, bool on_points);

  LegacyWords& words_;
  LegacyLayout& layout_;
};

}  // namespace hiac::formats::vtk
