#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// A file of one cell in a format, its nodes as the format's documentation lists them.
struct OneCellFile {
  std::string format;
  std::string name;  ///< with the extension
  CellKind kind;     ///< what it must be read as
  std::string text;
};

/// A polynomial of the node's place: what the field "f" of the files that can hold one is.
double one_cell_polynomial(const std::array<double, 3>& x);

/// One file for every format and kind. Each format's nodes are given independently of the readers:
/// every node as the middle of two corners (a corner: twice the same), from the documentation that
/// is named beside the list. The corners are those of a right-handed cell that has been mapped by
/// an affine map of positive determinant.
std::vector<OneCellFile> one_cell_files();

}  // namespace hiac::formats
