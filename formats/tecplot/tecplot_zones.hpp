#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/common/io/input_text.hpp"

namespace hiac::formats::tecplot {

/// One zone of a Tecplot file: its size, its values variable by variable, its cells.
struct Zone {
  std::string name;
  bool ordered = true;
  std::vector<std::size_t> dimensions{1, 1, 1};  ///< I, J, K of an ordered zone
  std::size_t nodes = 0;
  std::size_t elements = 0;
  std::size_t nodes_per_element = 0;
  std::string element;  ///< "BRICK", "TETRAHEDRON", ...
  std::optional<double> time;
  std::vector<bool> cell_centered;          ///< for every variable
  std::vector<std::vector<double>> values;  ///< for every variable
  std::vector<std::int64_t> connectivity;   ///< node numbers from 1
  /// The faces of an element "POLYHEDRON", each a list of node numbers from 1; empty for "POLYGON".
  std::vector<std::vector<std::vector<std::int64_t>>> polyhedra;

  /// Whether its elements are described by their faces.
  [[nodiscard]] bool has_faces() const { return element == "POLYHEDRON" || element == "POLYGON"; }
  /// The number of values of a variable.
  [[nodiscard]] std::size_t tuples(std::size_t variable) const {
    return cell_centered[variable] ? elements : nodes;
  }
};

/// The contents of a file.
struct TecplotFile {
  std::string title;
  std::vector<std::string> variables;
  std::vector<Zone> zones;
  std::vector<std::string> notes;
};

/// Reads an ASCII data file (Tecplot 360 Data Format Guide, "ASCII data"): TITLE, VARIABLES, ZONE
/// with POINT and BLOCK packing, repeated values (3*1.5), shared variables and connectivity,
/// cell-centred variables, polygons and polyhedra by their faces. Throws InputError naming file and
/// line.
TecplotFile read_tecplot_text(const InputText& text);

}  // namespace hiac::formats::tecplot
