#pragma once

#include <span>
#include <string>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Every format, in the order in which --list-formats shows them.
std::span<const Format> all_formats();

/// The format of that name. Throws UsageError that lists the existing formats.
const Format& format_named(const std::string& name);

/// The format for reading `path`: by its content, and by its extension where the content does not
/// identify the format. Throws InputError when the file cannot be opened or no format fits.
const Format& format_to_read(const std::string& path);

/// The format for writing `path`, by its extension. Throws UsageError when no format with that
/// extension can be written.
const Format& format_to_write(const std::string& path);

/// The versions of the libraries that read foreign formats: "VTK 9.1.0".
std::string format_library_versions();

}  // namespace hiac::formats
