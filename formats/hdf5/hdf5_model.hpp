#pragma once

#include <string>
#include <string_view>

namespace hiac::formats::hdf5 {

/// Whether these are the first bytes of an HDF5 file.
bool is_hdf5(std::string_view head);

/// The format of an HDF5 file: "vtkhdf", "med", "cgns", "exodus" (netCDF-4), "silo"; empty when it
/// is none of these or not an HDF5 file. Recognized by the groups and datasets that each format has
/// at its root. Throws nothing but InputError when the file cannot be opened.
std::string model_of(const std::string& path);

}  // namespace hiac::formats::hdf5
