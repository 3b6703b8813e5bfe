#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "formats/vtk/xml/xml_array.hpp"

namespace hiac::formats::vtk {

/// One piece of an XML file.
struct XmlPiece {
  std::size_t points = 0;
  std::size_t cells = 0;
  std::array<long, 6> extent{};  ///< of structured datasets: first and last point along x, y, z
  std::vector<XmlArray> point_data;
  std::vector<XmlArray> cell_data;
};

/// The contents of a VTK XML file (.vtu, .vts, .vti, .vtr) and their positions: the result of
/// checking the file before it is given to VTK's reader, which trusts every number that a file
/// declares.
struct XmlLayout {
  std::string type;  ///< "UnstructuredGrid", ...
  XmlStorage storage;
  std::size_t points = 0;
  std::size_t cells = 0;
  std::vector<XmlPiece> pieces;
  /// The elements of arrays that are not in the pieces, because a later one has their name.
  std::vector<std::string_view> replaced;
  std::vector<std::string> notes;
};

/// Checks that the file, of one time step (xml_steps.hpp), is complete: well-formed to its last
/// closing tag, every array complete in its encoding, consistent counts, connectivity as long as
/// the offsets say, complete face lists of polyhedra, arrays with names, pieces that have the
/// same arrays and together cover a structured extent. Of several arrays with one name, the last is
/// read. Memory: the file's text without appended data, temporarily. Throws
/// InputError(subject, ...).
XmlLayout check_xml_file(std::string_view text, const std::string& type,
                         const std::string& subject);

/// The type attribute of the root element, if the text begins like a VTK XML file.
std::string xml_file_type(std::string_view head);

}  // namespace hiac::formats::vtk
