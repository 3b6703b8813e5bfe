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

/// The VTK cell that a kind is written as. Node i of that cell is the kind's node nodes[i];
/// empty: the same nodes in the same order.
struct WrittenCell {
  int type;
  std::span<const std::uint8_t> nodes;
};

/// For every kind its VTK cell; nothing where there is none.
using WrittenCells = std::array<std::optional<WrittenCell>, kKindCount>;

/// The VTK cells of a mesh's kinds. The wedge, which VTK has not, is the brick with a repeated node
/// that it is; notes say so. Throws InputError(path, ...) naming kinds that `format` cannot hold.
WrittenCells written_cells(const ZooMesh& mesh, std::string_view format, const std::string& path,
                           std::vector<std::string>& notes);

}  // namespace hiac::formats::vtk
