#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/common/mesh/field_steps.hpp"
#include "formats/common/mesh/format.hpp"

namespace hiac::formats::vtk {

/// One of the time steps that an XML file holds.
struct XmlStep {
  std::vector<double> times;  ///< of all steps
  std::size_t step = 0;
  FieldSteps field_steps;  ///< of the arrays that belong to some steps
  /// The file reduced to this step: the attributes that declare steps, and the arrays of the other
  /// steps, are replaced by blanks, so that everything else keeps its position.
  std::string text;
};

/// The requested step, or the last one, of a file that declares its steps in the element named like
/// the type (TimeValues; without it, two or more steps numbered from 0 have their numbers as times)
/// and the steps of an array in the array (TimeStep; without it, an array belongs to all steps).
/// Nothing when a file does not declare steps. Throws InputError(subject, ...), and UsageError when
/// there is no such step.
///
/// This is what vtkXMLWriter writes with appended data. (Inline, VTK 9.1 assigns all arrays to step
/// 0, in elements that are not real pieces; its own reader cannot distinguish them, and they are
/// refused here.)
std::optional<XmlStep> xml_step(std::string_view text, const std::string& type,
                                const ReadOptions& options, const std::string& subject);

}  // namespace hiac::formats::vtk
