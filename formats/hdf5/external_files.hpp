#pragma once

#include <string>

namespace hiac::formats::hdf5 {

/// Throws InputError when an HDF5 file would have the library read what lies outside the input's
/// folder (named_file.hpp): through external links, data stored in other files, or virtual
/// datasets; files that it so names are looked into, too. Other files, and files that the library
/// cannot open, pass. To be called where a damaged file may end the process (isolated.hpp).
void require_local_links(const std::string& path);

}  // namespace hiac::formats::hdf5
