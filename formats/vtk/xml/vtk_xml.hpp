#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats::vtk {

/// How the XML files of one type of dataset are read.
struct XmlReader {
  /// All pieces of a file as one mesh, which may be empty (see finish_reading, gate.hpp).
  std::function<Reading(const std::string& path, const ReadOptions& options)> read;
  /// What a file holds.
  std::function<Inventory(const std::string& path)> inspect;
};

/// The reader of "UnstructuredGrid", "StructuredGrid", "ImageData" or "RectilinearGrid"; an empty
/// one for another type.
XmlReader xml_reader(std::string_view type);

}  // namespace hiac::formats::vtk
