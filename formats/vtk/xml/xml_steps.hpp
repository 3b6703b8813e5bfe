#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/mesh/format.hpp"

namespace hiac::formats::vtk {

/// One of the time steps that an XML file holds.
struct XmlStep {
  std::vector<double> times;  ///< of all steps
  std::size_t step = 0;
  /// The file as if it held this step alone: what says that there are steps, and the arrays of the
  /// others, are blanks, so that everything else stays in its place.
  std::string text;
};

/// The step that the options ask for, or the last, of a file whose element of the type's name tells
/// its steps (TimeValues) and whose arrays say to which they belong (TimeStep; to all where they do
/// not say). Nothing where a file does not tell steps. Throws InputError(subject, ...), UsageError
/// where there is no such step.
///
/// As vtkXMLWriter writes them with appended data. (Inline, VTK 9.1 writes all arrays as those of
/// step 0, in pieces that are no pieces; its own reader cannot tell them apart, and they are
/// refused here.)
std::optional<XmlStep> xml_step(std::string_view text, const std::string& type,
                                const ReadOptions& options, const std::string& subject);

}  // namespace hiac::formats::vtk
