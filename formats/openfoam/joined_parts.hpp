#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "formats/openfoam/case_part.hpp"

namespace hiac::formats::openfoam {

/// How the parts of a decomposed case make one mesh.
struct JoinedParts {
  std::size_t points = 0;  ///< of the whole
  /// For every point of every part its place in the whole.
  std::vector<std::vector<std::size_t>> point_places;
  /// For every cell of the whole its part and its place there.
  std::vector<std::pair<std::size_t, std::size_t>> cells;
  std::vector<std::string> notes;
};

/// Joins parts, in the order of their numbers: by pointProcAddressing and cellProcAddressing, which
/// say what points and cells of the parts were in the whole, where all parts have them and they fit
/// together; else by the patches of type "processor", whose faces are one with those of the patch
/// on the other side, face for face, and cells one part after the other. Throws InputError naming
/// the file where a patch does not meet its other side.
///
/// OpenFOAM User Guide, "Running applications in parallel"; processorPolyPatch.H (the order of
/// faces and of their points).
JoinedParts join_parts(const std::vector<CasePart>& parts);

}  // namespace hiac::formats::openfoam
