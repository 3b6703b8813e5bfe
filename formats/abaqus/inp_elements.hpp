#pragma once

#include <string_view>

#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::abaqus {

/// How an element type of Abaqus or CalculiX is read. `type` is in capitals. Solids have the node
/// order of the Abaqus manual (Elements Guide, "Three-dimensional solid element library"), which is
/// VTK's except for the prism's orientation.
struct InpElement {
  ForeignType type;
  /// The number of nodes in a record of the type; 0: a record continues as long as its lines end in
  /// commas. Only the first ForeignType::nodes of them are kept.
  std::size_t nodes_in_file = 0;
};

InpElement inp_element(std::string_view type);

}  // namespace hiac::formats::abaqus
