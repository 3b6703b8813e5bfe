#pragma once

#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac::starter {

/// What a first view shows.
struct Choice {
  Field field;       ///< a scalar, with the name by which scalar_field knows it
  double low, high;  ///< the range to show; equal for a field with one value
  std::vector<std::string> notes;
  bool is_height = false;  ///< no field of the mesh: its extinction is the same everywhere
};

/// The field that says most, or the one that is asked for (starter_view.hpp). Throws UsageError for
/// one that does not exist, and InputError(subject, ...) for one without finite values.
Choice choose_field(const ZooMesh& mesh, const std::string& asked, const std::string& subject);

}  // namespace hiac::starter
