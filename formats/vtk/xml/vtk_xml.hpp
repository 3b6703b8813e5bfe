#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats::vtk {

/// The functions that read the XML files of one type of dataset.
struct XmlReader {
  /// All pieces of a file as one mesh, which may be empty (see finish_reading, gate.hpp).
  std::function<Reading(const std::string& path, const ReadOptions& options)> read;
  /// The inventory of a file.
  std::function<Inventory(const std::string& path)> inspect;
};

/// The reader of "UnstructuredGrid", "StructuredGrid", "ImageData" or "RectilinearGrid"; an empty
/// one for other types.
XmlReader xml_reader(std::string_view type);

}  // namespace hiac::formats::vtk
