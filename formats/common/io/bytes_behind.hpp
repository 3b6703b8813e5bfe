#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hiac::formats {

// Files may go on behind the end of what they hold: a transfer appended something, a larger file
// was overwritten. What is there is not read, and a note says so.

/// Adds the note on that many bytes behind the end of `what` ("the mesh"), unless there are none.
void note_bytes_behind(std::uint64_t bytes, std::string_view what, std::vector<std::string>& notes);

/// The same for the rest of a text, in which blanks and ends of lines do not count at the end.
void note_text_behind(std::string_view rest, std::string_view what,
                      std::vector<std::string>& notes);

/// Adds the note on what is behind the last closing tag with that name: "VTKFile".
void note_behind_root(std::string_view xml, std::string_view root, std::vector<std::string>& notes);

/// Where a container (HDF5, ADF) ends, as its first bytes tell; nothing if they are those of no
/// container with a known end. At least kContainerHead bytes are needed.
std::optional<std::uint64_t> container_end(std::string_view head);
inline constexpr std::size_t kContainerHead = 256;

/// Adds the note on the bytes behind the end of a container; none for other files.
void note_bytes_behind_container(const std::string& path, std::vector<std::string>& notes);

}  // namespace hiac::formats
