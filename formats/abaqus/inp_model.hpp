#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/abaqus/inp_placement.hpp"
#include "formats/abaqus/inp_sets.hpp"
#include "formats/common/mesh/foreign_mesh.hpp"

namespace hiac::formats::abaqus {

/// A part, or everything in a deck that is outside parts; each has its own numbering.
struct Part {
  std::string name;
  std::vector<std::int64_t> node_numbers;
  std::vector<double> xyz;
  std::vector<std::int64_t> cell_numbers;
  std::vector<std::uint16_t> cell_types;  ///< places in Model::types
  std::vector<std::int64_t> cell_nodes;
  NumberSets sets;       ///< of elements
  NumberSets node_sets;  ///< of nodes, for keywords that generate nodes

  /// Keywords generated some of it; then the last of several nodes or elements with one number is
  /// kept.
  bool made = false;
  Places node_places;  ///< followed when keywords generate something
  Places cell_places;
  std::vector<std::size_t> cell_begins;  ///< of the cells that cell_places knows
};

/// A part with its placement.
struct Instance {
  std::string name;
  std::string part;
  Placement placement;
  /// Sets that the assembly defines on this instance's elements, by name.
  NumberSets sets;
};

/// The contents of a deck that describe its mesh.
struct Model {
  std::vector<ForeignType> types;
  Part root;
  std::vector<Part> parts;
  std::vector<Instance> instances;
  std::vector<std::string> notes;
};

/// One mesh of all instances or, if the deck has none, of its parts. Sets become blocks, and so do
/// instances if there are several. Throws InputError(subject, ...).
ForeignMesh mesh_of(Model&& model, const std::string& subject);

}  // namespace hiac::formats::abaqus
