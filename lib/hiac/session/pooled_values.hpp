#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hiac/base/temporary_file.hpp"
#include "hiac/session/field_values.hpp"

namespace hiac {

/// Finite values of any number of meshes, and exact percentiles of all of them, with the bits that
/// percentile() (field_values.hpp) has of one array that holds them all.
///
/// Memory is bounded: values beyond a limit are kept in a temporary file, of eight bytes each.
class PooledValues {
 public:
  static constexpr std::size_t kMostInMemory = std::size_t{1} << 26;

  /// `extremes_only`: percentiles 0 and 100 alone will be asked for, and no value is kept.
  /// `most_in_memory`: the number of values above which all are kept in the file.
  explicit PooledValues(bool extremes_only, std::size_t most_in_memory = kMostInMemory)
      : extremes_only_(extremes_only), most_in_memory_(most_in_memory) {}

  /// Throws InputError if the temporary file cannot be written.
  void add(std::vector<double> values);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The smallest and the largest value; empty where there is none.
  [[nodiscard]] const Interval& extent() const { return extent_; }
  /// There is a value. Throws InputError if the temporary file cannot be read.
  [[nodiscard]] double percentile(double percent);

 private:
  [[nodiscard]] double value_at(std::uint64_t rank) const;

  bool extremes_only_;
  std::size_t most_in_memory_;
  std::uint64_t count_ = 0;
  Interval extent_ = extent_of({});
  std::vector<double> values_;           // as long as there is no file
  std::unique_ptr<TemporaryFile> file_;  // all values, in the order in which they came
};

}  // namespace hiac
