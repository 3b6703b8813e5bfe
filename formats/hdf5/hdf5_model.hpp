#pragma once

#include <string>
#include <string_view>

namespace hiac::formats::hdf5 {

/// Whether a file that begins so is an HDF5 file.
bool is_hdf5(std::string_view head);

/// Which of the formats that are kept in HDF5 files the file is of: "vtkhdf", "med", "cgns",
/// "exodus" (netCDF-4), "silo"; empty when it is none of them or no HDF5 file. By the groups and
/// datasets that each format has at its root. Throws nothing but InputError where the file cannot
/// be opened.
std::string model_of(const std::string& path);

}  // namespace hiac::formats::hdf5
