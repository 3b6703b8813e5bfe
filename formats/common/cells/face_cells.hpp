#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

/// A cell recognized by its faces: its linear kind and its corners in the zoo's order.
struct FaceCell {
  CellKind kind;
  std::vector<std::int64_t> nodes;
};

/// The shape of the zoo that has these faces, each a list of nodes that turns counter-clockwise
/// seen from outside; nothing when there is none. Verified by comparing all faces with the shape's.
std::optional<FaceCell> cell_of_faces(std::span<const std::vector<std::int64_t>> faces);

}  // namespace hiac::formats
