#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/format.hpp"
#include "formats/xdmf/data_items.hpp"

namespace hiac::formats::xdmf {

/// A uniform grid; it may include parts that are defined in another grid.
struct UniformGrid {
  std::string name;
  pugi::xml_node topology;
  pugi::xml_node geometry;
  std::vector<pugi::xml_node> attributes;
  std::size_t points = 0;
  std::size_t cells = 0;
};

/// The grids of a document at one of its steps.
struct Grids {
  std::vector<double> times;  ///< of all temporal collections, ascending
  std::size_t step = 0;       ///< the chosen one of them: the last unless the options say another
  std::vector<UniformGrid> uniform;
  FieldSteps field_steps;  ///< of the attributes of temporal collections
};

/// Collects the uniform grids of a document at the step that the options choose; their points and
/// cells are not counted yet. Throws InputError naming the file and the element.
Grids grids_of(const pugi::xml_document& document, DataItems& items, const ReadOptions& options);

}  // namespace hiac::formats::xdmf
