#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hiac/mesh/parted/parted_index.hpp"
#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {

/// The names of the files of a parted mesh's parts, beside its index: NAME.0.zoo, NAME.1.zoo and so
/// on for NAME.zparts.
std::vector<std::string> part_paths(const std::string& index_path, std::size_t parts);

/// Splits a mesh (MeshSplitter) and writes each part's file, one part in memory at a time, and the
/// index, all under temporary names, which replace older files when all are complete: a run that
/// fails or is interrupted leaves what was there before, be it parts of the mesh itself. `written`
/// is told each part's file at the end. Every part has to have cells. Throws InputError when
/// something cannot be written.
PartedIndex write_parted_mesh(const std::string& path, const ZooMesh& mesh,
                              std::span<const std::uint32_t> part_of_cell, std::size_t parts,
                              const std::function<void(const std::string& file)>& written);

}  // namespace hiac
