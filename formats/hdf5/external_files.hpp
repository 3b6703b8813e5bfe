#pragma once

#include <string>

namespace hiac::formats::hdf5 {

/// Throws InputError when the library would read data outside the input's folder for an HDF5 file
/// (named_file.hpp): through external links, data stored in other files, or virtual datasets; the
/// files that are referred to are checked as well. Files of other formats, and files that the
/// library cannot open, pass. To be called where a damaged file may end the process (isolated.hpp).
void require_local_links(const std::string& path);

}  // namespace hiac::formats::hdf5
