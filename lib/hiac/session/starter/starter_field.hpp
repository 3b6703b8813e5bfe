#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/session/pooled_values.hpp"

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

/// Shows a range that is not the mesh's own, and notes it instead of that.
void show_range(Choice& choice, const std::array<double, 2>& range);

/// The range that a first view shows of one field of a series of meshes: that of all their values,
/// without the outermost percents where these make up most of it.
class SeriesRange {
 public:
  /// `field`: a scalar, as scalar_field accepts it.
  explicit SeriesRange(std::string field) : field_(std::move(field)), values_(false) {}

  /// Adds the values of one mesh. Throws UsageError if it has no such field.
  void add(const ZooMesh& mesh);
  /// A mesh with a value that can be shown has been added.
  [[nodiscard]] std::array<double, 2> range();

 private:
  std::string field_;
  PooledValues values_;
};

}  // namespace hiac::starter
