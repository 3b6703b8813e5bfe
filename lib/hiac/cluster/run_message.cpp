#include "hiac/cluster/run_message.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "hiac/cluster/edged_message.hpp"

namespace hiac {
namespace {

static_assert(kTilePlane <= std::numeric_limits<std::uint16_t>::max());

// A run's numbers are what it begins with, and its pixel.
constexpr std::size_t kRunNumbers = offsetof(RayRun, pixel);
static_assert(std::is_trivially_copyable_v<RayRun> && kRunNumbers == 6 * sizeof(double));
constexpr std::size_t kRunBytes = kRunNumbers + sizeof(std::uint16_t);
// the numbers of a run's facts
constexpr std::size_t kFactNumbers = 6;

void put_facts(ByteWriter& to, std::span<const RunFacts> all) {
  std::vector<double> numbers;
  std::vector<std::uint32_t> counts;
  numbers.reserve(kFactNumbers * all.size());
  for (const RunFacts& f : all) {
    numbers.insert(numbers.end(), {f.first, f.mean, f.radiance_error, f.transparency_error,
                                   f.front_edge, f.back_edge});
    counts.insert(counts.end(), {f.cells, f.violations});
  }
  to.put_all(std::span<const double>(numbers));
  to.put_all(std::span<const std::uint32_t>(counts));
}

std::vector<RunFacts> get_facts(ByteReader& from, std::size_t count) {
  const auto numbers = from.get_all<double>(kFactNumbers * count);
  const auto counts = from.get_all<std::uint32_t>(2 * count);
  std::vector<RunFacts> all(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double* n = numbers.data() + kFactNumbers * k;
    all[k] = {n[0], n[1], n[2], n[3], n[4], n[5], counts[2 * k], counts[2 * k + 1]};
  }
  return all;
}

}  // namespace

void put_runs(ByteWriter& to, const TileRuns& runs) {
  const std::size_t count = runs.runs.size();
  to.put(static_cast<std::uint32_t>(count));
  to.put(static_cast<std::uint32_t>(runs.facts.size()));
  to.put(runs.counts.segments);
  to.put(runs.counts.violations);
  std::byte* at = to.put_space(kRunBytes * count);
  for (const RayRun& run : runs.runs) {
    const auto pixel = static_cast<std::uint16_t>(run.pixel);
    std::memcpy(at, &run, kRunNumbers);
    std::memcpy(at + kRunNumbers, &pixel, sizeof pixel);
    at += kRunBytes;
  }
  put_facts(to, runs.facts);
  to.put(static_cast<std::uint32_t>(runs.covers.size()));
  for (const SkinCover& cover : runs.covers) {
    to.put(cover.pixel);
    to.put(cover.transparency);
  }
  put_edged(to, runs.edged);
}

TileRuns get_runs(ByteReader& from) {
  const auto count = from.get<std::uint32_t>(), facts = from.get<std::uint32_t>();
  TileRuns runs;
  runs.counts.segments = from.get<std::uint64_t>();
  runs.counts.violations = from.get<std::uint64_t>();
  const std::byte* at = from.get_space(kRunBytes * count).data();
  runs.runs.resize(count);
  for (RayRun& run : runs.runs) {
    std::uint16_t pixel;
    std::memcpy(static_cast<void*>(&run), at, kRunNumbers);
    std::memcpy(&pixel, at + kRunNumbers, sizeof pixel);
    run.pixel = pixel;
    at += kRunBytes;
  }
  runs.facts = get_facts(from, facts);
  runs.covers.resize(from.get<std::uint32_t>());
  for (SkinCover& cover : runs.covers) {
    cover.pixel = from.get<std::uint32_t>();
    cover.transparency = from.get<double>();
  }
  runs.edged = get_edged(from);
  return runs;
}

void put_summary(ByteWriter& to, const TileSummary& summary) {
  to.put(summary.counts.segments);
  to.put(summary.counts.violations);
  to.put(summary.optical_depth_sum);
  to.put(summary.optical_depth_most);
  to.put(summary.covered);
  to.put(summary.with_depth);
}

TileSummary get_summary(ByteReader& from) {
  TileSummary summary;
  summary.counts.segments = from.get<std::uint64_t>();
  summary.counts.violations = from.get<std::uint64_t>();
  summary.optical_depth_sum = from.get<double>();
  summary.optical_depth_most = from.get<double>();
  summary.covered = from.get<std::uint64_t>();
  summary.with_depth = from.get<std::uint64_t>();
  return summary;
}

void put_finished(ByteWriter& to, const FinishedTile& tile) {
  put_summary(to, tile.summary);
  to.put(static_cast<std::uint64_t>(tile.values.size()));
  to.put_all(std::span<const double>(tile.values));
}

FinishedTile get_finished(ByteReader& from) {
  FinishedTile tile;
  tile.summary = get_summary(from);
  tile.values = from.get_all<double>(from.get<std::uint64_t>());
  return tile;
}

}  // namespace hiac
