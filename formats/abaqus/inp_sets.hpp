#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace hiac::formats::abaqus {

/// Numbers from, to, in steps of.
struct NumberRange {
  std::int64_t first;
  std::int64_t last;
  std::int64_t step;

  friend auto operator<=>(const NumberRange&, const NumberRange&) = default;
};

/// A set of nodes or elements as the deck tells it; of its numbers some may be of none.
struct NumberSet {
  std::string name;  ///< as it is first written
  std::vector<NumberRange> ranges;
  /// The order of the ranges counts (*NSET, UNSORTED).
  bool unsorted = false;
  /// What of the set is not known; empty where all is.
  std::string unknown;
  std::size_t copied = 0;  ///< of the ranges so many may be there twice: they are of other sets
};

/// By name in capitals.
using NumberSets = std::map<std::string, NumberSet>;

/// Adds a number, to the last range where it continues that.
void add_number(std::int64_t number, std::vector<NumberRange>& ranges);

/// The set of that name, which is made when it is new.
NumberSet& set_named(NumberSets& sets, const std::string& name);

/// Adds ranges to a set, `copied` of which are of other sets. Now and then those that it has more
/// than once are dropped, so that sets that are made of sets do not grow without end.
void add_ranges(const std::vector<NumberRange>& ranges, NumberSet& set, std::size_t copied = 0);

/// The places of numbers in a list that grows; of a number that the list has twice, the last.
class Places {
 public:
  /// Looks at what of `numbers` is new since the last time.
  void follow(const std::vector<std::int64_t>& numbers);
  [[nodiscard]] std::optional<std::size_t> find(std::int64_t number) const;

 private:
  std::unordered_map<std::int64_t, std::size_t> places_;
  std::size_t known_ = 0;
};

/// The numbers of a set that `places` has, each once: rising, or of an unsorted set in its order.
/// `numbers` is the list that `places` follows. `looked_at` grows by the numbers that were tried.
std::vector<std::int64_t> members_of(const NumberSet& set, const Places& places,
                                     const std::vector<std::int64_t>& numbers,
                                     std::size_t& looked_at);

}  // namespace hiac::formats::abaqus
