#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vtk/number_type.hpp"

namespace hiac::formats::vtk {

/// The position of an array in a legacy file, and how it is stored.
struct LegacyArray {
  std::string name;  ///< as written
  NumberType type{};
  std::size_t tuples = 0;
  std::size_t components = 0;
  std::size_t begin = 0;  ///< first byte of its values
  std::size_t end = 0;    ///< one past the last
  bool on_points = false;
  bool has_not_finite = false;  ///< ASCII values that are nan or inf
  std::string read_as{};        ///< the name under which VTK's reader stores the array
  bool replaced = false;        ///< by a later array with that name
};

/// The contents of a legacy VTK file and their positions: the result of checking the file before it
/// is given to VTK's reader, which trusts every number that a file declares.
struct LegacyLayout {
  enum class Dataset : std::uint8_t {
    unstructured_grid,
    structured_grid,
    structured_points,
    rectilinear_grid
  };
  Dataset dataset{};
  bool binary = false;
  std::string title;
  std::size_t points = 0;
  std::size_t cells = 0;
  std::vector<LegacyArray> attributes;  ///< point and cell data, in the file's order
  std::vector<std::string> notes;
};

/// Walks through a whole legacy VTK file: every section is known, every array is complete, counts
/// are consistent, cells name existing points, and polyhedra's face lists are complete. Needs very
/// little memory. Throws InputError(subject, ...) naming the line (the byte in binary files).
LegacyLayout check_legacy_file(std::string_view text, const std::string& subject);

}  // namespace hiac::formats::vtk
