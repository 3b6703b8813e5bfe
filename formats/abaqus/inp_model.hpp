#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "formats/foreign_mesh.hpp"

namespace hiac::formats::abaqus {

/// Element numbers from, to, in steps of.
struct NumberRange {
  std::int64_t first;
  std::int64_t last;
  std::int64_t step;
};

/// The elements of a set.
using ElementSet = std::vector<NumberRange>;

/// A part, or what of a deck is outside parts; its numbers are its own.
struct Part {
  std::string name;
  std::vector<std::int64_t> node_numbers;
  std::vector<double> xyz;
  std::vector<std::int64_t> cell_numbers;
  std::vector<std::uint16_t> cell_types;  ///< places in Model::types
  std::vector<std::int64_t> cell_nodes;
  /// By name in capitals: the name as it is first written, and the elements.
  std::map<std::string, std::pair<std::string, ElementSet>> sets;
};

/// A point is mapped to rotation (row by row) times it plus translation.
struct Placement {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 3> translation{};
  bool moved = false;
};

/// A part that is put in its place.
struct Instance {
  std::string name;
  std::string part;
  Placement placement;
  /// Sets that the assembly makes of this instance's elements, by name.
  std::map<std::string, std::pair<std::string, ElementSet>> sets;
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
