#pragma once

#include <span>
#include <string>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats {

/// Every format, in the order in which --list-formats shows them.
std::span<const Format> all_formats();

/// The format of that name. Throws UsageError naming those that there are.
const Format& format_named(const std::string& name);

/// The format in which `path` is to be read: by its content, and by its extension where the content
/// does not tell. Throws InputError when the file cannot be opened or no format fits.
const Format& format_to_read(const std::string& path);

/// The format in which `path` is to be written, by its extension. Throws UsageError when there is
/// none that can be written.
const Format& format_to_write(const std::string& path);

/// The versions of the libraries that read foreign formats: "VTK 9.1.0".
std::string format_library_versions();

}  // namespace hiac::formats
