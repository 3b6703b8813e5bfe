#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/abaqus/inp_placement.hpp"
#include "formats/abaqus/inp_sets.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::abaqus {

/// A part, or what of a deck is outside parts; its numbers are its own.
struct Part {
  std::string name;
  std::vector<std::int64_t> node_numbers;
  std::vector<double> xyz;
  std::vector<std::int64_t> cell_numbers;
  std::vector<std::uint16_t> cell_types;  ///< places in Model::types
  std::vector<std::int64_t> cell_nodes;
  NumberSets sets;       ///< of elements
  NumberSets node_sets;  ///< of nodes, for what makes nodes from them

  /// Keywords made some of it; then of nodes and elements of one number the last counts.
  bool made = false;
  Places node_places;  ///< followed where something is made
  Places cell_places;
  std::vector<std::size_t> cell_begins;  ///< of the cells that cell_places knows
};

/// A part that is put in its place.
struct Instance {
  std::string name;
  std::string part;
  Placement placement;
  /// Sets that the assembly makes of this instance's elements, by name.
  NumberSets sets;
};

/// What a deck says of its mesh.
struct Model {
  std::vector<ForeignType> types;
  Part root;
  std::vector<Part> parts;
  std::vector<Instance> instances;
  std::vector<std::string> notes;
};

/// One mesh of all instances, or, where the deck has none, of its parts. Sets become blocks;
/// instances too, where there are several. Throws InputError(subject, ...).
ForeignMesh mesh_of(Model&& model, const std::string& subject);

}  // namespace hiac::formats::abaqus
