#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hiac::formats::openfoam {

/// A folder of results and its time.
struct TimeFolder {
  double time;
  std::filesystem::path path;
};

/// The folders of a case, or of a part of it, whose names are numbers, in ascending order.
std::vector<TimeFolder> time_folders(const std::filesystem::path& root);

/// A case, or a part of a decomposed one (processor0 ...), at one step: its mesh as faces.
struct CasePart {
  std::filesystem::path root;
  std::vector<TimeFolder> folders;
  std::size_t step = 0;  ///< place in `folders`

  std::vector<double> xyz;
  std::vector<std::size_t> starts;  ///< for every face its start in `nodes`, then the end
  std::vector<std::int64_t> nodes;
  std::vector<std::int64_t> owner;                 ///< the cell that a face points out of
  std::vector<std::vector<std::size_t>> faces_of;  ///< for every cell its faces

  std::vector<std::string> notes;  ///< on what its files hold besides

  [[nodiscard]] std::size_t point_count() const { return xyz.size() / 3; }
  /// A file of the mesh: where the mesh moves or changes, the latest one up to the step's time.
  [[nodiscard]] std::string mesh_file(const std::string& name) const;
  /// Reads points, faces, owner and neighbour. Throws InputError naming the file.
  void read_mesh();
  /// The faces of a cell, their nodes counter-clockwise seen from outside.
  [[nodiscard]] std::vector<std::vector<std::int64_t>> outward_faces(std::size_t cell) const;
};

}  // namespace hiac::formats::openfoam
