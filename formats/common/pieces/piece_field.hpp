#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats {

/// As long as one lives, readers mark for every cell which piece of its file it comes from, where
/// the mesh is in pieces, as parallel runs write it. For the whole process; one at a time.
class PieceMarking {
 public:
  PieceMarking() { is_on_ = true; }
  ~PieceMarking() { is_on_ = false; }
  PieceMarking(const PieceMarking&) = delete;
  PieceMarking& operator=(const PieceMarking&) = delete;

  [[nodiscard]] static bool is_on() { return is_on_; }

 private:
  static std::atomic<bool> is_on_;
};

/// The field of the cells with these marks: the number of the piece that a cell was read from. No
/// file's own field has a name that begins like this.
inline constexpr std::string_view kPieceField = "\x1fpiece";

/// Marks all cells of a mesh as those of this piece. Marks of pieces of a piece are lost.
void mark_piece(ZooMesh& mesh, std::size_t piece);
/// Marks every cell with its piece.
void mark_pieces(ZooMesh& mesh, std::vector<double>&& pieces);

/// Takes the marks out of a mesh: for every cell its piece. None: it was read from one piece.
std::optional<std::vector<std::uint32_t>> take_pieces(ZooMesh& mesh);

}  // namespace hiac::formats
