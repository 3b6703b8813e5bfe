#pragma once

#include <string>
#include <vector>

namespace hiac::formats {

/// One field composed of the scalars at these places in a list of names.
struct VectorName {
  std::string name;
  std::vector<std::size_t> parts;  ///< one, or three: x, y, z
};

/// Finds the vectors among scalars that are named NameX, NameY, NameZ, as in CGNS: three scalars
/// with one stem become the vector "Name", in the place of the first; the others are not changed.
std::vector<VectorName> vectors_among(const std::vector<std::string>& names);

}  // namespace hiac::formats
