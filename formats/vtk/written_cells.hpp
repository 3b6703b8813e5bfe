#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::formats::vtk {

/// The VTK cell type as which a kind is written. Node i of the VTK cell is the kind's node
/// nodes[i]; empty: the same nodes in the same order.
struct WrittenCell {
  int type;
  std::span<const std::uint8_t> nodes;
};

/// For every kind its VTK cell; nothing when there is none.
using WrittenCells = std::array<std::optional<WrittenCell>, kKindCount>;

/// The VTK cells of a mesh's kinds. VTK has no wedge, so wedges are written as bricks with a
/// repeated node; notes say so. Throws InputError(path, ...) naming kinds that `format` cannot
/// hold.
WrittenCells written_cells(const ZooMesh& mesh, std::string_view format, const std::string& path,
                           std::vector<std::string>& notes);

}  // namespace hiac::formats::vtk
