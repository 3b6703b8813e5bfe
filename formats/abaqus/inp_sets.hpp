#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace hiac::formats::abaqus {

/// The numbers from `first` to `last` in steps of `step`.
struct NumberRange {
  std::int64_t first;
  std::int64_t last;
  std::int64_t step;

  friend auto operator<=>(const NumberRange&, const NumberRange&) = default;
};

/// A set of nodes or elements as the deck defines it; some of its numbers may not exist.
struct NumberSet {
  std::string name;  ///< as it is first written
  std::vector<NumberRange> ranges;
  /// The order of the ranges matters (*NSET, UNSORTED).
  bool unsorted = false;
  /// A member that is not understood; empty when all members are.
  std::string unknown;
  std::size_t copied = 0;  ///< count of ranges from other sets, which may be duplicates
};

/// By name in capitals.
using NumberSets = std::map<std::string, NumberSet>;

/// Adds a number; extends the last range if the number continues it.
void add_number(std::int64_t number, std::vector<NumberRange>& ranges);

/// The set with that name, which is created if it is new.
NumberSet& set_named(NumberSets& sets, const std::string& name);

/// Adds ranges to a set; `copied` of them come from other sets. Duplicates are removed from time to
/// time, so that sets defined by other sets do not grow without bound.
void add_ranges(const std::vector<NumberRange>& ranges, NumberSet& set, std::size_t copied = 0);

/// The places of numbers in a growing list; the last place if a number occurs more than once.
class Places {
 public:
  /// Adds the entries of `numbers` that are new since the last call.
  void follow(const std::vector<std::int64_t>& numbers);
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t number) const;

 private:
  std::unordered_map<std::int64_t, std::size_t> places_;
  std::size_t known_ = 0;
};

/// The numbers of a set that `places` contains, each once: ascending or, for an unsorted set, in
/// the order of the set. `numbers` is the list that `places` follows. `looked_at` grows by the
/// count of numbers that were looked up.
std::vector<std::int64_t> members_of(const NumberSet& set, const Places& places,
                                     const std::vector<std::int64_t>& numbers,
                                     std::size_t& looked_at);

}  // namespace hiac::formats::abaqus
