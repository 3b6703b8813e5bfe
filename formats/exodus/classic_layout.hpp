#pragma once

#include <string>
#include <string_view>

namespace hiac::formats::exodus {

/// Whether these are the first bytes of a classic netCDF file: "CDF" and version 1, 2 or 5.
bool is_classic_netcdf(std::string_view head);

/// Reads the header of a classic netCDF file and checks that the data of every variable are inside
/// the file. Throws InputError(subject, ...) otherwise. Returns where the data end, in bytes.
///
/// The layout: https://docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html
std::size_t check_classic_layout(std::string_view text, const std::string& subject);

}  // namespace hiac::formats::exodus
