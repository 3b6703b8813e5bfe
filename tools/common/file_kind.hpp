#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hiac::tools {

/// The first bytes of a zoo container (mesh/zoo-container.md).
inline constexpr std::string_view kZooMagic = "\x89ZOO\r\n\x1a\n";

/// The kinds of files that the tools read and write.
enum class FileKind {
  mesh,           ///< a zoo mesh, or a mesh or surface in a foreign format
  order,          ///< visibility orders
  specification,  ///< an image specification, a colour map that one names, or a state of ParaView
  image,          ///< a picture of any format, or a film
  facts           ///< what --json writes, and other text for people and programs
};

/// "a mesh", "a visibility order", ...
std::string kind_phrase(FileKind kind);

/// The kind of a regular file by its first bytes, or, where these prove nothing, by the extensions
/// .toml and .f32 and those of meshes and surfaces; none for files that are empty, cannot be
/// opened, or are not of these kinds.
std::optional<FileKind> kind_of_file(const std::string& path);

}  // namespace hiac::tools
