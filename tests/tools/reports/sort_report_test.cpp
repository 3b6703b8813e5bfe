// What hiac-sort says of orders that it has made or verified.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"
#include "tools/sort/report.hpp"

namespace hiac::tools {
namespace {

using SortJson = nlohmann::ordered_json;

ReportedOrder exact_order_report() {
  OrderStatistics s;
  s.shared_faces = 100;
  s.unmatched_faces = 30;
  s.both_ways = 4;
  s.edge_on = 7;
  s.gap_pairs = 50;
  s.gap_arrows = 12;
  s.cells_in_groups = 9;
  s.largest_group = 5;
  s.relation_seconds = 0.125;
  s.gap_seconds = 2;
  s.component_seconds = 0.0625;
  return {3, "exact", s, 2, 1.5};
}

ZooMesh mixed() {
  return test::side_by_side(test::structured(1, test::Cut::bricks),
                            test::structured(1, test::Cut::tetrahedra));
}

const SortJson kSeconds = SortJson::parse(R"({"read": 0.25, "order": 1.5})");
constexpr std::uint64_t kPeak = 7U << 20U;  // of seven cells

TEST(SortReport, OneOrderIsAParagraph) {
  const std::string begins = "  cells            7 (6 tetrahedron4, 1 brick8)\n";
  const std::string ends =
      "  groups           2 of several cells, 9 cells in them, 5 in the largest\n"
      "  seconds          read 0.250, order 1.500\n"
      "  memory           7.0 MiB at its peak, 1048576 bytes a cell\n";
  ReportedOrder order = exact_order_report();
  EXPECT_EQ(statistics_table(mixed(), {order}, kSeconds, kPeak),
            begins +
                "  algorithm        exact\n"
                "  shared faces     100: 89 crossed one way, 7 edge-on, 4 both ways\n"
                "  unmatched faces  30\n"
                "  gap arrows       12 from 50 pairs of faces\n"
                "  order's seconds  relation 0.125, gaps 2.000, components 0.062\n" +
                ends);
  order.statistics.convex = true;
  EXPECT_NE(
      statistics_table(mixed(), {order}, kSeconds, kPeak)
          .find("  unmatched faces  30, the boundary of a convex body: no gaps\n  gap arrows"),
      std::string::npos);
  order.algorithm = "stein";
  EXPECT_EQ(statistics_table(mixed(), {order}, kSeconds, kPeak),
            begins + "  algorithm        stein\n" + ends);
}

TEST(SortReport, SeveralOrdersAreATable) {
  const ReportedOrder order = exact_order_report();
  EXPECT_EQ(
      statistics_table(ZooMesh{}, {order, order}, SortJson::object(), 1U << 19U),
      "  cells            0 ()\n"
      "   frame      one way    edge-on  both ways gap arrows   groups  largest in groups   "
      "seconds\n"
      "       3           89          7          4         12        2        5         9     "
      "1.500\n"
      "       3           89          7          4         12        2        5         9     "
      "1.500\n"
      "  seconds          \n"
      "  memory           0.5 MiB at its peak, 524288 bytes a cell\n");
}

TEST(SortReport, ARightOrderSaysWhatWasTested) {
  OrderCheck check;
  check.groups = 3;
  check.arrows = 40;
  EXPECT_EQ(check_text(check, {}), "verified: 40 arrows of the relation and 3 groups");
  check.pairs = 21;
  EXPECT_EQ(check_text(check, {}), "verified: 21 pairs of cells and 3 groups");
  check.left_out = 2;
  check.in_part = 5;
  EXPECT_EQ(check_text(check, {}),
            "verified: 21 pairs of cells and 3 groups; 2 cells without an inside or not convex "
            "only by their arrows of the relation; 5 cells with curved or warped faces without "
            "what is nearer to a face than twice what it deviates from a plane");
  EXPECT_EQ(check_text(OrderCheck{}, {}), "verified: 0 pairs of cells and 0 groups");
  EXPECT_EQ(check_facts(check), SortJson::parse(R"({"right": true, "pairs": 21,
    "cells_left_out": 2, "cells_in_part": 5, "arrows": 40, "groups": 3, "wrong_pairs": [],
    "wrong_pair_count": 0, "groups_without_cycle": 0})"));
}

TEST(SortReport, AWrongOrderSaysWhere) {
  VisibilityOrder order;
  order.cells = std::vector<CellId>{4, 2, 0, 1, 3};
  OrderCheck check;
  check.pairs = 10;
  check.groups = 2;
  check.wrong = {{4, 2}, {4, 1}, {0, 2}};
  check.wrong_count = 3;
  const std::string pairs =
      "the order is wrong: cell 4 comes before 2 that a ray meets first, cell 4 comes before 1 "
      "that a ray meets first, cell 0 comes before 2 that a ray meets first";
  const std::string checked = " (10 pairs of cells and 2 groups checked)";
  EXPECT_EQ(check_text(check, order), pairs + checked);
  check.wrong_count = 8;
  EXPECT_EQ(check_text(check, order), pairs + " and 5 more" + checked);
  const std::string loose = "the group of 2 cells from place 1 on (cell 2) is no cycle";
  check.loose = {{1, 2}, {3, 2}};
  EXPECT_EQ(check_text(check, order),
            pairs + " and 5 more, " + loose +
                ", the group of 2 cells from place 3 on (cell 1) is no cycle" + checked);
  EXPECT_EQ(check_facts(check), SortJson::parse(R"({"right": false, "pairs": 10,
    "cells_left_out": 0, "cells_in_part": 0, "arrows": 0, "groups": 2,
    "wrong_pairs": [[4, 2], [4, 1], [0, 2]], "wrong_pair_count": 8, "groups_without_cycle": 2})"));
  check.wrong.clear();
  check.wrong_count = 0;
  check.loose.pop_back();
  EXPECT_EQ(check_text(check, order), "the order is wrong: " + loose + checked);
}

}  // namespace
}  // namespace hiac::tools
