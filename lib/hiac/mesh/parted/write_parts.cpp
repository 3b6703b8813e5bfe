#include "hiac/mesh/parted/write_parts.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "hiac/base/error.hpp"
#include "hiac/base/output_file.hpp"
#include "hiac/mesh/file_descriptor.hpp"
#include "hiac/mesh/parted/part_file.hpp"
#include "hiac/mesh/parted/split_mesh.hpp"

namespace hiac {
namespace {

std::vector<std::unique_ptr<OutputFile>> begin_all(std::span<const std::string> paths) {
  std::vector<std::unique_ptr<OutputFile>> files;
  for (const std::string& path : paths) {
    if (is_stream(path))
      throw InputError(path, "is a pipe or a device (a file expected, as the index names others)");
    files.push_back(std::make_unique<OutputFile>(path));
  }
  return files;
}

void write_to(const OutputFile& file, const std::string& path,
              const std::function<void(int descriptor)>& write) {
  FileDescriptor output = open_to_write(file.temporary_path());
  write(output.number());
  output.close(path);
}

}  // namespace

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
  MeshSplitter splitter(mesh, part_of_cell, parts);
  for (std::size_t k = 0; k < parts; ++k)
    if (splitter.cells_of(k).empty())
      throw std::invalid_argument(fmt::format("part {} of {} has no cells", k, parts));
  std::vector<std::string> paths = part_paths(path, parts);
  paths.push_back(path);
  const std::vector<std::unique_ptr<OutputFile>> files = begin_all(paths);

  PartedIndex index{path, mesh.cell_count(), mesh.node_count(), content_hash(mesh), {}};
  for (std::size_t k = 0; k < parts; ++k) {
    const MeshPart part = splitter.part(k);
    write_to(*files[k], paths[k],
             [&](int descriptor) { write_zoo_stream(descriptor, zoo_file_of(part), paths[k]); });
    index.parts.push_back(part_info(part, std::filesystem::path(paths[k]).filename().string()));
  }
  write_to(*files.back(), path, [&](int descriptor) {
    const std::string text = text_of(index);
    write_fully(descriptor, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                path);
  });
  OutputFile::commit_all(files);
  for (std::size_t k = 0; k < parts; ++k) written(paths[k]);
  return index;
}

}  // namespace hiac
