// What processes tell one another arrives as it was told, member by member, and says where it ends
// too soon.
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/base/error.hpp"
#include "hiac/cluster/communicator.hpp"
#include "hiac/cluster/edged_message.hpp"
#include "hiac/cluster/run_message.hpp"
#include "hiac/cluster/solo_communicator.hpp"
#include "tests/cluster/parts_of.hpp"

namespace hiac {
namespace {

// Numbers all of which differ, so that none can stand for another.
class Counting {
 public:
  double real() { return 0.5 + static_cast<double>(next_++); }
  std::uint32_t whole() { return next_++; }

 private:
  std::uint32_t next_ = 1;
};

EdgeStop stop_of(Counting& next, bool is_curved) {
  EdgeStop stop{next.real(), static_cast<std::uint8_t>(next.whole() % 6), {}, {}};
  for (std::uint64_t& corner : stop.corners) corner = (std::uint64_t{1} << 40) + next.whole();
  stop.reference.fill(std::nan(""));
  if (is_curved)
    for (double& x : stop.reference) x = next.real();
  return stop;
}

void expect_stop(const EdgeStop& found, const EdgeStop& told, bool is_curved) {
  EXPECT_EQ(found.t, told.t);
  EXPECT_EQ(found.face, told.face);
  EXPECT_EQ(found.corners, told.corners);
  if (is_curved) {
    EXPECT_EQ(found.reference, told.reference);
  } else {
    for (const double x : found.reference) EXPECT_TRUE(std::isnan(x));
  }
}

EdgedTile edged_tile(Counting& next) {
  EdgedTile tile;
  for (const RayPart part : {RayPart::skin, RayPart::inside}) {
    EdgedSegment s{};
    s.pixel = next.whole();
    s.phase = part == RayPart::skin ? EdgedPhase::skin_left : EdgedPhase::inside;
    s.middle = next.real(), s.front = next.real(), s.back = next.real();
    s.light = {{next.real(), next.real(), next.real()}, next.real()};
    s.details = {next.real(), next.real(), next.real(), next.real(), next.real(), next.real(),
                 part,        next.real(), next.real(), next.real(), next.real()};
    tile.segments.push_back(s);
  }
  for (const std::uint32_t shape : {EdgedCrossing::kPlanar, 1U, 0U}) {
    const bool is_curved = shape != EdgedCrossing::kPlanar;
    tile.crossings.rays.push_back({next.whole(), shape,
                                   is_curved ? CellKind::brick20 : CellKind::prism6, next.real(),
                                   stop_of(next, is_curved), stop_of(next, is_curved)});
  }
  for (const CellKind kind : {CellKind::tetrahedron10, CellKind::brick20}) {
    MappedCell shape{kind, {}};
    for (std::size_t k = 0; k < node_count(kind); ++k)
      for (double& x : shape.nodes[k]) x = next.real();
    tile.crossings.shapes.push_back(shape);
  }
  EdgeFragment fragment{};
  fragment.pixel = next.whole();
  fragment.share = next.real(), fragment.t = next.real();
  fragment.strip = {next.real(), next.real(), next.real(), next.real(), next.real()};
  fragment.place = {{(std::uint64_t{1} << 33) + next.whole(), next.whole()},
                    next.real(),
                    (std::uint64_t{1} << 34) + next.whole()};
  tile.fragments.push_back(fragment);
  return tile;
}

void expect_edged(const EdgedTile& found, const EdgedTile& told) {
  ASSERT_EQ(found.segments.size(), told.segments.size());
  for (std::size_t k = 0; k < told.segments.size(); ++k) {
    const EdgedSegment &s = found.segments[k], &t = told.segments[k];
    EXPECT_EQ(s.pixel, t.pixel);
    EXPECT_EQ(s.phase, t.phase);
    EXPECT_FALSE(s.is_edge);
    EXPECT_EQ((std::array{s.middle, s.front, s.back}), (std::array{t.middle, t.front, t.back}));
    EXPECT_EQ(s.light.rgb, t.light.rgb);
    EXPECT_EQ(s.light.transparency, t.light.transparency);
    const auto numbers = [](const SegmentDetails& d) {
      return std::array{d.front,      d.back,     d.light,          d.transparency,
                        d.first,      d.mean,     d.radiance_error, d.transparency_error,
                        d.front_edge, d.back_edge};
    };
    EXPECT_EQ(numbers(s.details), numbers(t.details));
    EXPECT_EQ(s.details.part, t.details.part);
  }
  ASSERT_EQ(found.crossings.rays.size(), told.crossings.rays.size());
  for (std::size_t k = 0; k < told.crossings.rays.size(); ++k) {
    const EdgedCrossing &s = found.crossings.rays[k], &t = told.crossings.rays[k];
    EXPECT_EQ(s.pixel, t.pixel);
    EXPECT_EQ(s.shape, t.shape);
    EXPECT_EQ(s.kind, t.kind);
    EXPECT_EQ(s.middle, t.middle);
    const bool is_curved = t.shape != EdgedCrossing::kPlanar;
    expect_stop(s.front, t.front, is_curved);
    expect_stop(s.back, t.back, is_curved);
  }
  ASSERT_EQ(found.crossings.shapes.size(), told.crossings.shapes.size());
  for (std::size_t k = 0; k < told.crossings.shapes.size(); ++k) {
    EXPECT_EQ(found.crossings.shapes[k].kind, told.crossings.shapes[k].kind);
    EXPECT_EQ(found.crossings.shapes[k].nodes, told.crossings.shapes[k].nodes);
  }
  ASSERT_EQ(found.fragments.size(), told.fragments.size());
  for (std::size_t k = 0; k < told.fragments.size(); ++k) {
    const EdgeFragment &s = found.fragments[k], &t = told.fragments[k];
    const auto numbers = [](const EdgeFragment& f) {
      return std::array{f.share,    f.t,        f.strip.x0,    f.strip.y0,
                        f.strip.x1, f.strip.y1, f.strip.width, f.place.along};
    };
    EXPECT_EQ(s.pixel, t.pixel);
    EXPECT_EQ(numbers(s), numbers(t));
    EXPECT_EQ(s.place.edge, t.place.edge);
    EXPECT_EQ(s.place.node, t.place.node);
  }
}

TEST(RunMessage, ArrivesAsItWasTold) {
  Counting next;
  for (const bool with_facts : {true, false}) {
    TileRuns told;
    told.counts = {(std::uint64_t{1} << 35) + next.whole(), next.whole()};
    for (const std::uint32_t pixel : {0U, 7U, static_cast<std::uint32_t>(kTilePlane - 1)}) {
      told.runs.push_back({next.real(),
                           next.real(),
                           {{next.real(), next.real(), next.real()}, next.real()},
                           pixel});
      if (with_facts)
        told.facts.push_back({next.real(), next.real(), next.real(), next.real(), next.real(),
                              next.real(), next.whole(), next.whole()});
    }
    told.covers = {{next.whole(), next.real()}, {next.whole(), next.real()}};
    if (with_facts) told.edged = edged_tile(next);
    Bytes bytes;
    ByteWriter to(bytes);
    put_runs(to, told);
    to.put(std::uint32_t{99});  // the next message begins behind this one
    ByteReader from(bytes);
    const TileRuns found = get_runs(from);
    EXPECT_EQ(from.get<std::uint32_t>(), 99U);
    EXPECT_TRUE(from.at_end());
    EXPECT_EQ(found.counts.segments, told.counts.segments);
    EXPECT_EQ(found.counts.violations, told.counts.violations);
    ASSERT_EQ(found.runs.size(), told.runs.size());
    for (std::size_t k = 0; k < told.runs.size(); ++k) {
      const RayRun &s = found.runs[k], &t = told.runs[k];
      EXPECT_EQ(s.front, t.front);
      EXPECT_EQ(s.back, t.back);
      EXPECT_EQ(s.light.rgb, t.light.rgb);
      EXPECT_EQ(s.light.transparency, t.light.transparency);
      EXPECT_EQ(s.pixel, t.pixel);
    }
    ASSERT_EQ(found.facts.size(), told.facts.size());
    for (std::size_t k = 0; k < told.facts.size(); ++k) {
      const auto numbers = [](const RunFacts& f) {
        return std::array{f.first,      f.mean,      f.radiance_error, f.transparency_error,
                          f.front_edge, f.back_edge, double(f.cells),  double(f.violations)};
      };
      EXPECT_EQ(numbers(found.facts[k]), numbers(told.facts[k]));
    }
    ASSERT_EQ(found.covers.size(), told.covers.size());
    for (std::size_t k = 0; k < told.covers.size(); ++k) {
      EXPECT_EQ(found.covers[k].pixel, told.covers[k].pixel);
      EXPECT_EQ(found.covers[k].transparency, told.covers[k].transparency);
    }
    expect_edged(found.edged, told.edged);
  }
}

TEST(FinishedMessage, ArrivesAsItWasTold) {
  Counting next;
  FinishedTile told;
  told.summary.counts = {next.whole(), next.whole()};
  told.summary.optical_depth_sum = next.real(), told.summary.optical_depth_most = next.real();
  told.summary.covered = next.whole(), told.summary.with_depth = next.whole();
  for (int k = 0; k < 5; ++k) told.values.push_back(next.real());
  Bytes bytes;
  ByteWriter to(bytes);
  put_finished(to, told);
  ByteReader from(bytes);
  const FinishedTile found = get_finished(from);
  EXPECT_TRUE(from.at_end());
  EXPECT_EQ(found.summary.counts.segments, told.summary.counts.segments);
  EXPECT_EQ(found.summary.counts.violations, told.summary.counts.violations);
  EXPECT_EQ(found.summary.optical_depth_sum, told.summary.optical_depth_sum);
  EXPECT_EQ(found.summary.optical_depth_most, told.summary.optical_depth_most);
  EXPECT_EQ(found.summary.covered, told.summary.covered);
  EXPECT_EQ(found.summary.with_depth, told.summary.with_depth);
  EXPECT_EQ(found.values, told.values);
}

TEST(ByteStream, SaysThatItEndsTooSoon) {
  Bytes bytes;
  ByteWriter to(bytes);
  to.put(std::uint32_t{5});
  to.put_all(std::span<const double>(std::array{1.5, 2.5}));
  to.put_all(std::span<const double>());
  ASSERT_EQ(bytes.size(), 20U);
  const auto fails = [](const auto& read) {
    try {
      read();
    } catch (const Error& error) {
      return error.exit_code() == ExitCode::internal;
    }
    return false;
  };
  ByteReader from(bytes);
  EXPECT_FALSE(from.at_end());
  EXPECT_EQ(from.get<std::uint32_t>(), 5U);
  EXPECT_TRUE(fails([&] { (void)from.get_all<double>(3); }));
  EXPECT_TRUE(fails([&] { (void)from.get_space(17); }));
  EXPECT_EQ(from.get_all<double>(0), std::vector<double>());
  EXPECT_EQ(from.get_all<double>(2), (std::vector{1.5, 2.5}));
  EXPECT_TRUE(from.at_end());
  EXPECT_TRUE(fails([&] { (void)from.get<std::uint8_t>(); }));
  ByteReader part(std::span<const std::byte>(bytes).first(19));
  (void)part.get_space(4);
  EXPECT_TRUE(fails([&] { (void)part.get_all<double>(2); }));
  EXPECT_EQ(part.get_space(15).size(), 15U);
}

Bytes bytes_of(std::uint8_t value, std::size_t count) {
  return Bytes(count, static_cast<std::byte>(value));
}

TEST(Communicator, GathersAndSpreads) {
  for (const std::uint32_t ranks : {1U, 2U, 5U})
    test::run_ranks(ranks, [&](Communicator& all) {
      const auto own = static_cast<std::uint8_t>(all.rank() + 10);
      const std::vector<Bytes> everywhere = all_gather(all, bytes_of(own, all.rank()));
      const std::vector<Bytes> at_first = gather(all, bytes_of(own, all.rank() + 1));
      ASSERT_EQ(everywhere.size(), ranks);
      ASSERT_EQ(at_first.size(), all.rank() == 0 ? ranks : 0U);
      for (std::uint8_t r = 0; r < ranks; ++r) {
        const auto told = static_cast<std::uint8_t>(r + 10);
        EXPECT_EQ(everywhere[r], bytes_of(told, r));
        if (all.rank() == 0) {
          EXPECT_EQ(at_first[r], bytes_of(told, r + 1U));
        }
      }
      EXPECT_EQ(broadcast(all, bytes_of(own, 3)), bytes_of(10, 3));
      // the largest one is at neither end
      EXPECT_EQ(most_of_all(all, all.rank() == ranks / 2 ? 7 : all.rank() % 2), 7U);
      const std::array<std::uint64_t, 2> counts{1, all.rank()};
      EXPECT_EQ(sum_of_all(all, counts),
                (std::vector<std::uint64_t>{ranks, ranks * (ranks - 1) / 2}));
    });
}

TEST(SoloCommunicator, HandsOutNumbersAgain) {
  SoloCommunicator alone;
  EXPECT_EQ(alone.rank(), 0U);
  EXPECT_EQ(alone.size(), 1U);
  for (int round = 0; round < 2; ++round) {
    alone.restart_numbers();
    for (std::uint64_t k = 0; k < 3; ++k) EXPECT_EQ(alone.take_number(), k);
  }
  EXPECT_EQ(alone.exchange({bytes_of(4, 2)}), (std::vector<Bytes>{bytes_of(4, 2)}));
}

}  // namespace
}  // namespace hiac
