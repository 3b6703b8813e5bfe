#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hiac {

/// What the index of a parted mesh says of one part.
struct PartInfo {
  std::string file;                     ///< relative to the folder of the index
  std::uint64_t cells = 0;              ///< 1 or more
  std::uint64_t nodes = 0;              ///< those shared with other parts included
  std::array<double, 3> low{}, high{};  ///< the box around the part's nodes
  std::string hash;                     ///< content_hash of the part's mesh
  std::string numbers_hash;             ///< of its global numbers (mesh_hash.hpp)
};

/// The index of a parted mesh: a small file beside those of its parts. parted-mesh.md in this
/// folder explains the format.
struct PartedIndex {
  std::string path;                    ///< of the index itself
  std::uint64_t cells = 0, nodes = 0;  ///< of the whole mesh
  std::string hash;                    ///< content_hash of the whole mesh
  std::vector<PartInfo> parts;         ///< one or more

  /// The path of a part's file.
  [[nodiscard]] std::string path_of(std::size_t part) const;
};

/// Where the parts that an index names may lie.
enum class PartFiles : std::uint8_t {
  beside,  ///< in the index's folder and those within it; symbolic links are not resolved
  anywhere
};

inline constexpr std::string_view kPartedExtension = ".zparts";

/// No mesh has more parts than this.
inline constexpr std::size_t kMostParts = 1 << 16;

/// Whether a file that begins like this is an index.
bool is_parted_index(std::string_view head);

/// Reads an index, none of its parts. Throws InputError naming the file and what is wrong: other
/// text, an unknown version, values that are missing, of another type or impossible, parts whose
/// cells do not add up to those of the whole, parts named twice, and parts that `files` excludes.
PartedIndex read_parted_index(const std::string& path, PartFiles files = PartFiles::beside);

/// The text of an index's file.
std::string text_of(const PartedIndex& index);

}  // namespace hiac
