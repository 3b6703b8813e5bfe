#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "formats/openfoam/case_part.hpp"

namespace hiac::formats::openfoam {

/// The mesh of a decomposed case in terms of its parts.
struct JoinedParts {
  std::size_t points = 0;  ///< of the whole
  /// For every point of every part, its place in the whole mesh.
  std::vector<std::vector<std::size_t>> point_places;
  /// For every cell of the whole mesh, its part and its place there.
  std::vector<std::pair<std::size_t, std::size_t>> cells;
  std::vector<std::string> notes;
};

/// Joins parts, in the order of their numbers: by pointProcAddressing and cellProcAddressing, which
/// give the places of the parts' points and cells in the whole mesh, if all parts have them and
/// they are consistent; otherwise by the patches of type "processor", whose faces coincide one by
/// one with those of the patch on the other side; the cells then follow part after part. Patches
/// without faces are passed over. Throws InputError naming the file when a patch leads to its own
/// part, has no other side or does not match it.
///
/// OpenFOAM User Guide, "Running applications in parallel"; processorPolyPatch.H (the order of
/// faces and of their points).
JoinedParts join_parts(const std::vector<CasePart>& parts);

}  // namespace hiac::formats::openfoam
