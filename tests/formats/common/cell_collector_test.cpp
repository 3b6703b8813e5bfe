// Cells of a file that are converted, left out or refused, with the notes and messages that say so.
#include "formats/common/cells/cell_collector.hpp"

#include <array>

#include "tests/formats/files.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::array<std::uint8_t, 4> kTurnedNodes{1, 0, 2, 3};
const CellConversion kTetrahedron4 = converted_to(CellKind::tetrahedron4);
const CellConversion kBrick8 = converted_to(CellKind::brick8);

struct FileCell {
  int type;
  std::vector<NodeId> nodes;
  CellConversion conversion;
};

struct Collected {
  ConvertedCells cells;
  std::vector<std::string> notes;
  std::string refusal;
};

/// What becomes of the cells; `places`: with the nodes' places in the file.
Collected collected(const std::vector<FileCell>& cells, const ReadOptions& options = {},
                    bool places = false, const std::string& reason = {}) {
  CellCollector collector(options, "f", [](int type) { return "type" + std::to_string(type); });
  collector.reserve(cells.size(), 8 * cells.size());
  if (places) collector.keep_places();
  if (!reason.empty()) collector.explain(reason);
  Collected result;
  try {
    for (std::size_t i = 0; i < cells.size(); ++i)
      collector.add(i, cells[i].type, cells[i].nodes, cells[i].conversion);
    result.cells = collector.finish(cells.size(), result.notes);
  } catch (const InputError& error) {
    result.refusal = error.what();
  }
  return result;
}

CellConversion with_further_nodes(CellConversion conversion) {
  conversion.further_nodes = true;
  return conversion;
}

TEST(CellCollector, CellsOfKindsAreTakenInTheirOrder) {
  const Collected all =
      collected({{0, {4, 5, 6, 7}, kTetrahedron4},
                 {1, {0, 1, 2, 3}, converted_to(CellKind::tetrahedron4, kTurnedNodes)},
                 {2, {9, 8, 7, 6, 5}, with_further_nodes(kTetrahedron4)}},
                {}, true);
  EXPECT_EQ(all.refusal, "");
  EXPECT_THAT(all.cells.kinds, testing::Each(CellKind::tetrahedron4));
  EXPECT_THAT(all.cells.elems, ElementsAre(0, 4, 8, 12));
  EXPECT_THAT(all.cells.nodes, ElementsAre(4, 5, 6, 7, 1, 0, 2, 3, 9, 8, 7, 6));
  EXPECT_THAT(all.cells.places, ElementsAre(0, 1, 2, 3, 1, 0, 2, 3, 0, 1, 2, 3));
  EXPECT_TRUE(all.cells.all_kept);
  EXPECT_THAT(all.cells.kept, IsEmpty());
  EXPECT_THAT(all.notes, ElementsAre("took the first nodes of cells of linear types with more: 1 "
                                     "type2 of 5 nodes"));
  EXPECT_THAT(collected({{0, {4, 5, 6, 7}, kTetrahedron4}}).cells.places, IsEmpty());
}

TEST(CellCollector, CellsWithoutVolumeAreDropped) {
  const FileCell solid{0, {0, 1, 2, 3}, kTetrahedron4};
  const FileCell line{1, {0, 1}, kNoVolume};
  const FileCell triangle{2, {0, 1, 2}, kNoVolume};
  const Collected middle = collected({line, solid, triangle, line, solid});
  EXPECT_FALSE(middle.cells.all_kept);
  EXPECT_THAT(middle.cells.kept, ElementsAre(1, 4));
  EXPECT_THAT(middle.notes, ElementsAre("dropped cells without volume: 2 type1, 1 type2"));
  const Collected last = collected({solid, solid, line});
  EXPECT_FALSE(last.cells.all_kept);
  EXPECT_THAT(last.cells.kept, ElementsAre(0, 1));
  EXPECT_THAT(collected({solid, line, solid}).cells.kept, ElementsAre(0, 2));
  EXPECT_EQ(collected({{3, {0, 1, 2}, kWrongCount}}).refusal,
            "f: cell 0: a type3 cannot have 3 nodes");
}

TEST(CellCollector, UnsupportedCellsAreRefusedOrSkippedOrTakenByTheirCorners) {
  const std::vector<FileCell> cells{
      {0, {0, 1, 2, 3}, kTetrahedron4},
      {7, {3, 2, 1, 0, 4, 5}, kUnsupported},
      {8, {5, 4, 3, 2, 1}, unsupported_with(CellKind::tetrahedron4, kTurnedNodes)}};
  EXPECT_EQ(collected({cells[0], cells[1]}).refusal,
            "f: holds volume cells that cannot be converted: 1 type7 of 6 nodes "
            "(ReadOptions::skip_unsupported leaves them out)");
  EXPECT_EQ(
      collected(cells, {}, false, "they are round").refusal,
      "f: holds volume cells that cannot be converted: 1 type7 of 6 nodes, 1 type8 of 5 nodes; "
      "they are round (ReadOptions::skip_unsupported leaves them out, "
      "ReadOptions::corners_of_unsupported takes their corners)");
  ReadOptions options;
  options.skip_unsupported = true;
  const Collected skipped = collected(cells, options);
  EXPECT_THAT(skipped.cells.kept, ElementsAre(0));
  EXPECT_THAT(skipped.notes,
              ElementsAre("skipped unsupported cells: 1 type7 of 6 nodes, 1 type8 of 5 nodes"));
  options.corners_of_unsupported = true;
  const Collected corners = collected(cells, options, true);
  EXPECT_THAT(corners.cells.kept, ElementsAre(0, 2));
  EXPECT_THAT(corners.cells.nodes, ElementsAre(0, 1, 2, 3, 4, 5, 3, 2));
  EXPECT_THAT(corners.cells.places, ElementsAre(0, 1, 2, 3, 1, 0, 2, 3));
  EXPECT_THAT(corners.notes, ElementsAre("skipped unsupported cells: 1 type7 of 6 nodes",
                                         "kept the corners alone of: 1 type8 of 5 nodes"));
}

TEST(CellCollector, RepeatedNodesMakeAnotherKindOrNone) {
  const FileCell prism{0, {10, 11, 12, 12, 14, 15, 16, 16}, kBrick8};
  const Collected taken = collected({prism}, {}, true);
  EXPECT_THAT(taken.cells.kinds, ElementsAre(CellKind::prism6));
  EXPECT_THAT(taken.cells.elems, ElementsAre(0, 6));
  ASSERT_EQ(taken.cells.places.size(), 6U);
  for (std::size_t n = 0; n < 6; ++n)
    EXPECT_EQ(prism.nodes[taken.cells.places[n]], taken.cells.nodes[n]);
  EXPECT_THAT(taken.notes, ElementsAre("cells with repeated nodes became their true kind: 1 brick8 "
                                       "to prism6"));
  const FileCell knife{0, {10, 11, 10, 13, 14, 15, 16, 17}, kBrick8};
  const std::string what = "type0 that has two opposite corners of a face in one node (a 'knife')";
  const std::string first = "; the first is cell 1 with nodes 10 11 10 13 14 15 16 17";
  EXPECT_EQ(collected({prism, knife, knife}).refusal,
            "f: holds volume cells that cannot be converted: 2 " + what + first +
                " (ReadOptions::skip_unsupported leaves them out, ReadOptions::approximate "
                "converts those with repeated nodes)");
  ReadOptions options;
  options.approximate = true;
  const FileCell large{7, {3, 2, 1}, kUnsupported};
  EXPECT_EQ(collected({large, knife}, options).refusal,
            "f: holds volume cells that cannot be converted: 1 type7 of 3 nodes, 1 " + what +
                first + " (ReadOptions::skip_unsupported leaves them out)");
  options.skip_unsupported = true;
  EXPECT_THAT(collected({knife}, options).notes,
              ElementsAre("skipped unsupported cells: 1 " + what));
}

TEST(CellCollector, FatesAreToldInWords) {
  TrueKinds kinds;
  const auto fate = [&](const CellConversion& conversion, const std::vector<NodeId>& nodes) {
    return fate_of(conversion, nodes, kinds);
  };
  EXPECT_EQ(fate(kNoVolume, {0, 1}), "dropped (no volume)");
  EXPECT_EQ(fate(unsupported_with(CellKind::brick8), {0}), "reduced where that loses nothing");
  EXPECT_EQ(fate(kUnsupported, {0}), "unsupported");
  EXPECT_EQ(fate(kWrongCount, {0}), "unsupported");
  EXPECT_EQ(fate(kTetrahedron4, {0, 1, 2, 3}), "tetrahedron4");
  EXPECT_EQ(fate(kBrick8, {0, 1, 2, 3, 4, 5, 6, 7}), "brick8");
  EXPECT_EQ(fate(kBrick8, {0, 1, 2, 3, 4, 5, 6, 6}), "wedge7");
  EXPECT_EQ(fate(kBrick8, {0, 1, 0, 3, 4, 5, 6, 7}), "unsupported");
  // the same brick, listed top first
  constexpr std::array<std::uint8_t, 8> kTopFirst{4, 5, 6, 7, 0, 1, 2, 3};
  EXPECT_EQ(fate(converted_to(CellKind::brick8, kTopFirst), {4, 4, 4, 4, 0, 1, 2, 3}), "pyramid5");
}

}  // namespace
}  // namespace hiac::formats
