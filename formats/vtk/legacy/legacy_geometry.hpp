#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "formats/vtk/legacy/legacy_cells.hpp"
#include "formats/vtk/legacy/legacy_layout.hpp"
#include "formats/vtk/legacy/legacy_values.hpp"
#include "formats/vtk/legacy/legacy_words.hpp"

namespace hiac::formats::vtk {

/// The sections of a legacy file that describe the points and cells of its dataset. Throws through
/// `words`.
class LegacyGeometry {
 public:
  /// `major` is the file's version; `layout` has the kind of dataset and gets the numbers of its
  /// points and cells.
  LegacyGeometry(LegacyWords& words, LegacyLayout& layout, int major)
      : words_(words), layout_(layout), major_(major) {}

  /// Walks through the section with that keyword; returns whether datasets of this kind have such a
  /// section.
  bool read_section(const std::string& keyword);

  /// Checks that no section is missing and that they fit each other. `has_data`: point or cell data
  /// follow.
  void finish(bool has_data);

 private:
  void read_points();
  void read_cells();
  void read_cell_types();
  void read_dimensions();
  void read_blanking();
  bool read_image_section(const std::string& keyword);
  bool read_coordinates(const std::string& keyword);
  void require_dimensions() const;
  void finish_cells();
  NumberType read_integer_type();
  LegacyValues walk_array(const NumberType& type, std::size_t tuples, std::size_t components);

  LegacyWords& words_;
  LegacyLayout& layout_;
  int major_;
  bool has_points_ = false;
  bool has_dimensions_ = false;
  std::array<std::size_t, 3> dimensions_{};
  std::array<bool, 3> has_coordinates_{};
  LegacyCells cells_;
  std::size_t type_count_ = 0;
};

}  // namespace hiac::formats::vtk
