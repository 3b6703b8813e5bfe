#include "hiac/cluster/whole_ranges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hiac/cluster/byte_stream.hpp"
#include "hiac/cluster/chosen_rank.hpp"
#include "hiac/mesh/parts/used_nodes.hpp"
#include "hiac/session/field_range.hpp"
#include "hiac/session/field_values.hpp"
#include "hiac/session/value_key.hpp"

namespace hiac {
namespace {

constexpr std::array<double, 2> kExtremes{0, 100};

// For every node of every part whether its values count there: every node of a cell counts in one
// of the parts that have it, that of the lowest number.
std::vector<std::vector<std::uint8_t>> counted_nodes(Communicator& all,
                                                     std::span<const NumberedPart> own) {
  using Record = std::array<std::uint64_t, 2>;  // the node, the part
  std::vector<std::vector<std::uint8_t>> counted;
  std::vector<Bytes> to(all.size());
  std::vector<std::vector<std::pair<std::size_t, NodeId>>> told(all.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    const ZooMesh& mesh = own[k].mesh;
    counted.push_back(mark_used_nodes(mesh.nodes.view(), mesh.node_count()));
    const std::vector<bool> maybe_shared = nodes_on_boundary(mesh);
    for (NodeId node = 0; node < mesh.node_count(); ++node) {
      if (!maybe_shared[node]) continue;
      const std::uint64_t number = own[k].global_nodes[node];
      const std::uint32_t rank = chosen_rank(std::array{number}, all.size());
      told[rank].emplace_back(k, node);
      ByteWriter(to[rank]).put(Record{number, own[k].number});
    }
  }
  std::vector<std::vector<Record>> received;
  std::vector<Record> sorted;
  for (const Bytes& bytes : all.exchange(std::move(to))) {
    received.push_back(ByteReader(bytes).get_all<Record>(bytes.size() / sizeof(Record)));
    sorted.insert(sorted.end(), received.back().begin(), received.back().end());
  }
  std::ranges::sort(sorted);
  std::vector<Bytes> answers(all.size());
  for (std::size_t rank = 0; rank < received.size(); ++rank)
    for (const Record& record : received[rank]) {
      const auto first = std::ranges::lower_bound(sorted, Record{record[0], 0});
      ByteWriter(answers[rank]).put(static_cast<std::uint8_t>((*first)[1] == record[1] ? 1 : 0));
    }
  const std::vector<Bytes> answered = all.exchange(std::move(answers));
  for (std::size_t rank = 0; rank < told.size(); ++rank) {
    ByteReader from(answered[rank]);
    for (const auto& [part, node] : told[rank]) counted[part][node] = from.get<std::uint8_t>();
  }
  return counted;
}

// The finite values of a field of all parts of this process, those of shared nodes once.
class Values {
 public:
  Values(std::span<const NumberedPart> own, const FieldRanges::Wanted& wanted,
         std::span<const std::vector<std::uint8_t>> counted) {
    for (std::size_t k = 0; k < own.size(); ++k) {
      const Field field = scalar_field(own[k].mesh, wanted.field);
      const bool of_nodes = field.location == FieldLocation::node;
      for (std::size_t i = 0; i < field.values.size(); ++i) {
        const double value = field.values[i];
        if (std::isfinite(value) && !(wanted.logarithmic && !(value > 0)) &&
            (!of_nodes || counted[k][i] != 0))
          values_.push_back(value);
      }
    }
  }

  [[nodiscard]] Interval extent(Communicator& all) const {
    const Interval own = extent_of(values_);
    Bytes mine;
    ByteWriter message(mine);
    message.put(own.low);
    message.put(own.high);
    Interval whole = extent_of({});
    for (const Bytes& received : all_gather(all, mine)) {
      ByteReader from(received);
      whole.low = std::min(whole.low, from.get<double>());
      whole.high = std::max(whole.high, from.get<double>());
    }
    return whole;
  }

  // As percentile() (field_values.hpp) of the values of all processes, of which there are some.
  [[nodiscard]] double percentile(Communicator& all, double percent) const {
    const std::uint64_t count = sum_of_all(all, std::array<std::uint64_t, 1>{values_.size()})[0];
    const PercentileRank rank = percentile_rank(percent, count);
    const double below = value_at(all, rank.below);
    return rank.share == 0 ? below
                           : (1 - rank.share) * below + rank.share * value_at(all, rank.below + 1);
  }

 private:
  [[nodiscard]] double value_at(Communicator& all, std::uint64_t rank) const {
    RankedKey ranked(rank);
    while (!ranked.found()) {
      std::vector<std::uint64_t> counts(RankedKey::kDigits);
      for (const double value : values_) ranked.count(key_of(value), counts);
      ranked.take(sum_of_all(all, counts));
    }
    return value_of(ranked.key());
  }

  std::vector<double> values_;
};

}  // namespace

ParsedScene with_whole_ranges(Communicator& all, std::span<const NumberedPart> own,
                              ParsedScene parsed) {
  FieldRanges ranges(parsed);
  if (!ranges.are_open()) return parsed;
  const std::vector<FieldRanges::Wanted> wanted = ranges.wanted();
  const auto counted = counted_nodes(all, own);
  std::vector<Interval> ends;
  for (const FieldRanges::Wanted& range : wanted) {
    const Values values(own, range, counted);
    Interval whole = values.extent(all);
    if (!whole.empty() && range.percents != kExtremes) {
      const auto end = [&](double percent, double extreme, double at) {
        return percent == at ? extreme : values.percentile(all, percent);
      };
      whole = {end(range.percents[0], whole.low, 0), end(range.percents[1], whole.high, 100)};
    }
    ends.push_back(whole);
  }
  ranges.set_ends(ends);
  return ranges.place(std::move(parsed));
}

}  // namespace hiac
