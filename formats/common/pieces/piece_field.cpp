#include "formats/common/pieces/piece_field.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace hiac::formats {

std::atomic<bool> PieceMarking::is_on_ = false;

void mark_piece(ZooMesh& mesh, std::size_t piece) {
  mark_pieces(mesh, std::vector<double>(mesh.cell_count(), static_cast<double>(piece)));
}

void mark_pieces(ZooMesh& mesh, std::vector<double>&& pieces) {
  std::erase_if(mesh.fields, [](const Field& field) { return field.name == kPieceField; });
  mesh.fields.push_back({std::string(kPieceField), "", FieldLocation::cell, 1, std::move(pieces)});
}

std::optional<std::vector<std::uint32_t>> take_pieces(ZooMesh& mesh) {
  const auto marks = std::ranges::find(mesh.fields, kPieceField, &Field::name);
  if (marks == mesh.fields.end()) return std::nullopt;
  std::vector<std::uint32_t> pieces;
  pieces.reserve(mesh.cell_count());
  for (const double piece : marks->values) pieces.push_back(static_cast<std::uint32_t>(piece));
  mesh.fields.erase(marks);
  return pieces;
}

}  // namespace hiac::formats
