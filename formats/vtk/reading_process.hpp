#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/common/mesh/field_steps.hpp"

namespace hiac {
class IsolatedProcess;
class PackReader;
}  // namespace hiac

namespace hiac::formats::vtk {

/// The process in which VTK reads files. While somebody in this thread holds it, others get the
/// same one: whoever reads many files holds it, so that a large process need not be forked for
/// each.
std::shared_ptr<IsolatedProcess> reading_process();

/// What to open: a file of the type "UnstructuredGrid", "StructuredGrid", "ImageData" or
/// "RectilinearGrid", and which of its steps.
struct XmlRequest {
  std::string type;
  std::optional<std::size_t> step;
  std::optional<double> time;
  bool nearest_time = false;
};

/// What is in a file that was opened.
struct OpenedXml {
  std::size_t pieces = 0;
  std::vector<double> times;  ///< of the steps that the file declares
  std::size_t step = 0;       ///< the chosen one of them
  FieldSteps field_steps;
  std::vector<std::string> notes;
};

/// The requests about XML files. An open one is answered by an OpenedXml; the others are about the
/// file opened last, and are answered by a dataset (packed_dataset.hpp) and VTK's warnings so far.
std::string open_request(const XmlRequest& request);
std::string whole_request();
std::string piece_request(std::size_t index);
OpenedXml unpack_opened(PackReader& in);

/// The request to read a legacy file: answered by its dataset, its title and notes.
std::string legacy_request();

std::vector<std::string> unpack_texts(PackReader& in);

}  // namespace hiac::formats::vtk
