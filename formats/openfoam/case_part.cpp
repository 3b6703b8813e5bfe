#include "formats/openfoam/case_part.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "formats/openfoam/foam_file.hpp"
#include "hiac/base/error.hpp"

namespace hiac::formats::openfoam {

namespace fs = std::filesystem;

std::vector<TimeFolder> time_folders(const fs::path& root) {
  std::vector<TimeFolder> folders;
  std::error_code failed;
  for (const fs::directory_entry& entry : fs::directory_iterator(root, failed)) {
    const std::string name = entry.path().filename().string();
    double time = 0;
    const char* end = name.data() + name.size();
    const auto [next, error] = std::from_chars(name.data(), end, time);
    if (error == std::errc() && next == end && entry.is_directory())
      folders.push_back({time, entry.path()});
  }
  std::sort(folders.begin(), folders.end(),
            [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
  return folders;
}

std::string CasePart::mesh_file(const std::string& name) const {
  for (std::size_t i = folders.empty() ? 0 : step + 1; i-- > 0;) {
    const fs::path moved = folders[i].path / "polyMesh" / name;
    if (FoamFile::exists(moved.string())) return moved.string();
  }
  return (root / "constant" / "polyMesh" / name).string();
}

void CasePart::read_mesh() {
  const auto read = [&](const std::string& path, const auto& take) {
    FoamFile file(path);
    take(file);
    file.note_rest(notes);
  };
  read(mesh_file("points"), [&](FoamFile& file) { xyz = file.points(); });
  read(mesh_file("faces"), [&](FoamFile& file) { file.faces(starts, nodes); });
  const std::string owner_file = mesh_file("owner");
  const std::size_t faces = starts.size() - 1;
  read(owner_file, [&](FoamFile& file) { owner = file.labels(faces); });
  if (owner.size() != faces)
    throw InputError(
        owner_file,
        fmt::format("does not fit the faces ({} entries expected, {} found)", faces, owner.size()));
  const std::string neighbour_file = mesh_file("neighbour");
  std::vector<std::int64_t> neighbour;
  read(neighbour_file, [&](FoamFile& file) { neighbour = file.labels(faces); });
  if (neighbour.size() > faces)
    throw InputError(neighbour_file,
                     fmt::format("does not fit the faces (at most {} entries expected, {} found)",
                                 faces, neighbour.size()));
  std::int64_t last = -1;
  const auto count_cells = [&](const std::vector<std::int64_t>& cells, const std::string& file) {
    for (const std::int64_t cell : cells) last = std::max(last, cell);
    // every cell has faces, so there are fewer cells than faces
    if (last >= static_cast<std::int64_t>(faces))
      throw InputError(file, fmt::format("names cell {} (fewer than {} expected)", last, faces));
  };
  count_cells(owner, owner_file);
  count_cells(neighbour, neighbour_file);
  faces_of.resize(static_cast<std::size_t>(last + 1));
  const auto note = [&](std::int64_t cell, std::size_t face) {
    if (cell >= 0) faces_of[static_cast<std::size_t>(cell)].push_back(face);
  };
  for (std::size_t f = 0; f < faces; ++f) note(owner[f], f);
  for (std::size_t f = 0; f < neighbour.size(); ++f) note(neighbour[f], f);
}

std::vector<std::vector<std::int64_t>> CasePart::outward_faces(std::size_t cell) const {
  std::vector<std::vector<std::int64_t>> outward;
  for (const std::size_t face : faces_of[cell]) {
    std::vector<std::int64_t> corners(nodes.begin() + static_cast<long>(starts[face]),
                                      nodes.begin() + static_cast<long>(starts[face + 1]));
    // a face turns counter-clockwise seen from outside its owner
    if (owner[face] != static_cast<std::int64_t>(cell))
      std::reverse(corners.begin(), corners.end());
    outward.push_back(std::move(corners));
  }
  return outward;
}

}  // namespace hiac::formats::openfoam
