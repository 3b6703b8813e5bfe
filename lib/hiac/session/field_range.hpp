#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hiac/mesh/zoo_mesh.hpp"
#include "hiac/scene/specification.hpp"
#include "hiac/session/pooled_values.hpp"

namespace hiac {

/// The ranges that a specification leaves to its fields' values ("auto", percentiles), over any
/// number of meshes: the time steps of one series have one range in common. Of one mesh alone they
/// are those of with_field_ranges (session.hpp), which says what values count.
class FieldRanges {
 public:
  /// `most_in_memory`: of each range's values (PooledValues).
  explicit FieldRanges(const ParsedScene& parsed,
                       std::size_t most_in_memory = PooledValues::kMostInMemory);

  /// Whether a range is left to the fields' values; if not, no mesh has to be added.
  [[nodiscard]] bool are_open() const { return color_ || extinction_ || skin_; }

  /// Adds the values of one mesh. Throws UsageError if a field does not exist.
  void add(const ZooMesh& mesh);

  /// What an open range is of: percentiles of the finite values in cells of a field; on a
  /// logarithmic scale of those that are positive.
  struct Wanted {
    std::string field;
    std::array<double, 2> percents;
    bool logarithmic;
  };
  /// The ranges that are open.
  [[nodiscard]] std::vector<Wanted> wanted() const;
  /// Puts these in the place of the fields' values, found elsewhere: for every range that is open
  /// its ends, empty where there is no value. No mesh must be added.
  void set_ends(std::span<const Interval> ends);

  /// Puts the points of the scene's transfer functions on the ranges of all meshes, and notes them.
  /// `parsed` is what the constructor saw. Throws InputError as with_field_ranges does.
  ParsedScene place(ParsedScene parsed);

 private:
  struct OpenRange {
    std::string field;
    std::array<double, 2> percents;
    bool logarithmic;
    PooledValues values;

    void add(const ZooMesh& mesh);
    [[nodiscard]] std::array<double, 2> ends();
  };

  template <std::size_t N>
  static std::optional<OpenRange> open_range(const std::optional<UnscaledPoints<N>>& wanted,
                                             const std::optional<TransferFunction<N>>& transfer,
                                             std::size_t most_in_memory);
  template <std::size_t N>
  void place(const std::string& key, OpenRange& range, std::optional<UnscaledPoints<N>>& wanted,
             std::optional<TransferFunction<N>>& transfer, std::vector<std::string>& notes) const;

  std::size_t meshes_ = 0;
  std::optional<OpenRange> color_, extinction_, skin_;
};

}  // namespace hiac
