#pragma once

#include <string>
#include <vector>

namespace hiac::formats {

/// One field made of the scalars at these places in a list of names.
struct VectorName {
  std::string name;
  std::vector<std::size_t> parts;  ///< one, or three: x, y, z
};

/// Finds the vectors among scalars that are named NameX, NameY, NameZ, as CGNS has it: three of one
/// stem become the vector "Name", in the place of the first; all else stays as it is.
std::vector<VectorName> vectors_among(const std::vector<std::string>& names);

}  // namespace hiac::formats
