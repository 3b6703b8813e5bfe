#include "hiac/mesh/parted/write_parts.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"

namespace hiac {

std::vector<std::string> part_paths(const std::string& index_path, std::size_t parts) {
  const std::filesystem::path index(index_path);
  std::vector<std::string> paths;
  for (std::size_t k = 0; k < parts; ++k)
    paths.push_back(
        (index.parent_path() / fmt::format("{}.{}.zoo", index.stem().string(), k)).string());
  return paths;
}

PartedIndex write_parted_mesh(const std::string& path, const ZooMesh& mesh,
                              std::span<const std::uint32_t> part_of_cell, std::size_t parts,
                              const std::function<void(const std::string& file)>& written) {
  if (is_stream(path))
    throw InputError(path, "is a pipe or a device (a file expected, as the index names others)");
  MeshSplitter splitter(mesh, part_of_cell, parts);
  for (std::size_t k = 0; k < parts; ++k)
    if (splitter.cells_of(k).empty())
      throw std::invalid_argument(fmt::format("part {} of {} has no cells", k, parts));
  if (unlink(path.c_str()) != 0 && errno != ENOENT)
    throw InputError(path, fmt::format("cannot be replaced ({})", std::strerror(errno)));

  PartedIndex index{path, mesh.cell_count(), mesh.node_count(), content_hash(mesh), {}};
  const std::vector<std::string> paths = part_paths(path, parts);
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPart part = splitter.part(k);
    write_mesh_part(paths[k], part);
    index.parts.push_back(part_info(part, std::filesystem::path(paths[k]).filename().string()));
    written(paths[k]);
  }
  write_parted_index(index);
  return index;
}

}  // namespace hiac
