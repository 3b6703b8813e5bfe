// What hiac-check says of its findings, line by line, and as JSON.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/meshes.hpp"
#include "tools/check/report.hpp"

namespace hiac::tools {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// A table without the line of the cells and the verdict.
std::string middle(const Judgement& judgement, std::size_t max_ids = 10) {
  const std::string table =
      judgement_table(test::structured(1, test::Cut::bricks), judgement, max_ids);
  const std::size_t first = table.find('\n') + 1, last = table.rfind('\n', table.size() - 2) + 1;
  return table.substr(first, last - first);
}

Json facts(const Judgement& judgement, std::size_t max_ids = 10) {
  return judgement_facts(judgement, max_ids);
}

Judgement found(std::vector<Finding> findings) {
  Judgement judgement;
  judgement.findings = std::move(findings);
  return judgement;
}

TEST(CheckReport, BeginsWithTheCellsAndEndsWithTheVerdict) {
  const ZooMesh mesh = test::side_by_side(test::structured(1, test::Cut::bricks),
                                          test::structured(1, test::Cut::tetrahedra));
  Judgement judgement;
  EXPECT_EQ(judgement_table(mesh, judgement, 10),
            "  6 tetrahedron4, 1 brick8; 16 nodes\n"
            "  valid as far as asked (--overlap: overlaps, too)\n");
  judgement.overlaps_asked = true;
  EXPECT_EQ(judgement_table(mesh, judgement, 10),
            "  6 tetrahedron4, 1 brick8; 16 nodes\n  valid\n");
  EXPECT_EQ(judgement_table(ZooMesh{}, judgement, 10), "  no cells; 0 nodes\n  valid\n");
  judgement.findings = {{Defect::nonplanar_face, {{0}}}};  // a warning
  EXPECT_THAT(judgement_table(mesh, judgement, 10), EndsWith("\n  valid\n"));
  judgement.findings.push_back({Defect::inverted, {{0}}});
  EXPECT_THAT(judgement_table(mesh, judgement, 10), EndsWith("\n  INVALID\n"));
  judgement.overlaps_asked = false;
  EXPECT_THAT(judgement_table(mesh, judgement, 10), EndsWith("\n  INVALID\n"));
}

TEST(CheckReport, WhatIsWorstComesFirst) {
  const Judgement judgement = found({{Defect::left_handed, {{0}, {1}}},
                                     {Defect::unused_node, {{8}}},
                                     {Defect::inverted, {{5}, {7}, {11}}},
                                     {Defect::duplicate_node, {{3, 1}, {4}}},
                                     {Defect::zero_volume, {{12}}}});
  EXPECT_EQ(middle(judgement, 2),
            "  INVALID          1 cells without volume: 12\n"
            "  INVALID          3 inverted cells: 5 7 ...\n"
            "  warning          2 nodes at the place of another: 3=1 4\n"
            "  warning          1 nodes of no cell: 8\n"
            "  note             2 left-handed cells: the whole mesh is: 0 1\n");
  EXPECT_EQ(reasons(judgement), "3 inverted cells, 1 cells without volume");
  EXPECT_EQ(facts(judgement, 2), Json::parse(R"({"valid": false, "findings": [
    {"defect": "zero_volume", "severity": "invalid", "text": "cells without volume", "count": 1,
     "ids": [12]},
    {"defect": "inverted", "severity": "invalid", "text": "inverted cells", "count": 3,
     "ids": [5, 7]},
    {"defect": "duplicate_node", "severity": "warning", "text": "nodes at the place of another",
     "count": 2, "ids": [[3, 1], 4]},
    {"defect": "unused_node", "severity": "warning", "text": "nodes of no cell", "count": 1,
     "ids": [8]},
    {"defect": "left_handed", "severity": "note", "text": "left-handed cells: the whole mesh is",
     "count": 2, "ids": [0, 1]}]})"));
}

TEST(CheckReport, OffendersAreNamedAsTheyAre) {
  const Judgement judgement = found({{Defect::overlap, {{1, 4, 0.25}, {2, 6, 0.0625}}},
                                     {Defect::adjacency, {{2, 5}}},
                                     {Defect::cycle, {{9, 3}}},
                                     {Defect::possible_overlap, {{0, 1}, {2, 3}, {4, 5}, {6, 7}}},
                                     {Defect::grazing_overlap, {{0, 1, 1e-17}}}});
  const std::string under(21, ' ');
  EXPECT_EQ(middle(judgement),
            "  INVALID          1 faces whose stored neighbour is not theirs: 2:5\n"
            "  INVALID          2 pairs of cells that overlap: 1+4 2+6\n" +
                under +
                "0.25 at most (depth, of the smaller cell's size)\n"
                "  warning          4 pairs of cells, curved or with bent faces, whose overlap is "
                "undecided: 0+1 2+3 4+5 ...\n"
                "  warning          1 pairs of cells that overlap by rounding: 0+1\n" +
                under +
                "1e-17 at most (depth, of the smaller cell's size)\n"
                "  warning          1 cells of visibility cycles: 9\n");
  EXPECT_THAT(middle(judgement, 2), HasSubstr("is undecided: 0+1 2+3 ...\n"));
  const Json findings = facts(judgement)["findings"];
  EXPECT_EQ(findings[0]["ids"], Json::parse("[[2, 5]]"));
  EXPECT_EQ(findings[1]["ids"], Json::parse("[[1, 4], [2, 6]]"));
  EXPECT_EQ(findings[1]["largest"], 0.25);
  EXPECT_FALSE(findings[0].contains("largest"));
  EXPECT_EQ(findings[2]["ids"].size(), 4U);
  EXPECT_EQ(findings[4]["ids"], Json::parse("[9]"));
  EXPECT_EQ(facts(found({{Defect::nonplanar_face, {{0, kNobody, 1e-3}}}})),
            Json::parse(R"({"valid": true, "findings": [
    {"defect": "nonplanar_face", "severity": "warning", "text": "cells with a face that is not planar",
     "count": 1, "ids": [0], "largest": 0.001}]})"));
  EXPECT_EQ(reasons(found({{Defect::nonplanar_face, {{0}}}})), "");
}

// One view without cycles, and one with two groups.
Judgement with_cycles() {
  Judgement judgement;
  const VisibilityGroup three{{1, 2, 3},
                              {{1, CycleStep::face, {0.5, 0, 2}},
                               {2, CycleStep::gap, {1, 0, 0}},
                               {3, CycleStep::both_ways, {0, 1, 0}}}};
  const VisibilityGroup two{{6, 8}, {{6, CycleStep::gap, {}}, {8, CycleStep::gap, {}}}};
  judgement.views = {{"frame 0", {}}, {"frame 1", {three, two}}};
  return judgement;
}

TEST(CheckReport, CyclesAreFollowedCellByCell) {
  const Judgement judgement = with_cycles();
  EXPECT_EQ(middle(judgement),
            "  cycle            3 frame 1: 1 -face-> 2 -gap-> 3 -face both ways-> 1\n"
            "  cycle            2 frame 1: 6 -gap-> 8 -gap-> 6\n"
            "  1 of 2 views without cycles, if no cells overlap (--overlap)\n");
  EXPECT_EQ(middle(judgement, 1),
            "  cycle            3 frame 1: 1 -face-> ...\n"
            "                   1 cycles more\n"
            "  1 of 2 views without cycles, if no cells overlap (--overlap)\n");
  EXPECT_EQ(middle(judgement, 2),
            "  cycle            3 frame 1: 1 -face-> 2 -gap-> ...\n"
            "  cycle            2 frame 1: 6 -gap-> 8 -gap-> 6\n"
            "  1 of 2 views without cycles, if no cells overlap (--overlap)\n");
  EXPECT_EQ(facts(judgement, 1), Json::parse(R"({"valid": true, "findings": [], "views": [
    {"view": "frame 0", "count": 0, "groups": []},
    {"view": "frame 1", "count": 2, "groups": [
      {"count": 3, "cells": [1], "cycle_length": 3,
       "cycle": [{"cell": 1, "step": "face", "witness": [0.5, 0.0, 2.0]}]}]}],
    "cells_overlap": false})"));
  EXPECT_EQ(facts(judgement, 2)["views"][1]["groups"].size(), 2U);
}

TEST(CheckReport, CyclesMeanNothingWhereCellsOverlap) {
  const std::string if_none = ", if no cells overlap (--overlap)\n";
  const std::string nothing =
      "1 of 2 views without cycles; but cells overlap: between them there is no order, and a "
      "cycle, or none, means nothing\n";
  for (const Defect defect : {Defect::overlap, Defect::folded_face}) {
    Judgement overlapping = with_cycles();
    overlapping.findings = {{defect, {{0, 1}}}};
    EXPECT_TRUE(overlapping.cells_overlap());
    EXPECT_THAT(middle(overlapping), EndsWith(nothing));
    EXPECT_EQ(facts(overlapping)["cells_overlap"], true);
  }
  Judgement grazing = with_cycles();
  grazing.findings = {{Defect::grazing_overlap, {{0, 1}}}};
  EXPECT_FALSE(grazing.cells_overlap());
  EXPECT_THAT(middle(grazing), EndsWith(if_none));
  Judgement asked = with_cycles();
  asked.overlaps_asked = true;
  EXPECT_THAT(middle(asked), EndsWith("1 of 2 views without cycles\n"));
  Judgement proven = with_cycles();
  proven.certificate = Certificate{Acyclicity::regular, Delaunay::weak, {}};
  EXPECT_THAT(middle(proven), HasSubstr("1 of 2 views without cycles\n"));
  proven.certificate->acyclicity = Acyclicity::unknown;
  EXPECT_THAT(middle(proven), HasSubstr(if_none));
}

TEST(CheckReport, CertificatesAreTold) {
  const auto told = [](const Certificate& certificate) {
    Judgement judgement;
    judgement.certificate = certificate;
    return middle(judgement);
  };
  using enum Acyclicity;
  EXPECT_EQ(told({delaunay, Delaunay::strict, {}}),
            "  Delaunay\n  proven free of cycles from everywhere: strictly Delaunay\n");
  EXPECT_EQ(told({regular, Delaunay::weak, {}}),
            "  Delaunay; some neighbours have a circumsphere in common\n"
            "  proven free of cycles from everywhere: regular\n");
  EXPECT_EQ(told({unknown, Delaunay::none, "some reason"}),
            "  not Delaunay\n  not proven free of cycles from everywhere: some reason\n");
  EXPECT_EQ(told({unknown, Delaunay::unknown, "other"}),
            "  not proven free of cycles from everywhere: other\n");
  Judgement judgement;
  judgement.certificate = Certificate{unknown, Delaunay::none, "some reason"};
  EXPECT_EQ(facts(judgement), Json::parse(R"({"valid": true, "findings": [], "acyclic": "unknown",
    "delaunay": "no", "not_proven_acyclic": "some reason"})"));
  judgement.certificate = Certificate{delaunay, Delaunay::strict, {}};
  EXPECT_EQ(facts(judgement), Json::parse(R"({"valid": true, "findings": [], "acyclic": "delaunay",
    "delaunay": "strict"})"));
}

TEST(CheckReport, ConvexityIsToldWithWhatRefutesIt) {
  const auto told = [](const MeshConvexity& convexity) {
    Judgement judgement;
    judgement.convexity = convexity;
    return middle(judgement, 2);
  };
  using enum Convexity;
  const std::vector<ReentrantEdge> edges{{1, 4, 0, 3}, {2, 9, 1, 1}, {5, 6, 0, 2}};
  EXPECT_EQ(told({convex, {}, 1, {}}), "  the mesh is convex\n");
  EXPECT_EQ(told({unknown, {}, 1, "some reason"}),
            "  whether the mesh is convex is not known: some reason\n");
  EXPECT_EQ(told({not_convex, edges, 1, {}}),
            "  the mesh is not convex: 3 edges of its boundary bend inwards: 1-4 2-9 ...\n");
  EXPECT_EQ(told({not_convex, {edges[0], edges[1]}, 2, {}}),
            "  the mesh is not convex: 2 boundary surfaces (gaps or cavities); 2 edges of its "
            "boundary bend inwards: 1-4 2-9\n");
  EXPECT_EQ(told({not_convex, {}, 3, {}}),
            "  the mesh is not convex: 3 boundary surfaces (gaps or cavities)\n");
  Judgement judgement;
  judgement.convexity = MeshConvexity{not_convex, edges, 1, {}};
  EXPECT_EQ(facts(judgement, 1)["convexity"],
            Json::parse(R"({"verdict": "not convex", "boundary_surfaces": 1, "reentrant_edges": 3,
    "edges": [{"nodes": [1, 4], "cells": [0, 3]}]})"));
  judgement.convexity = MeshConvexity{unknown, {}, 2, "some reason"};
  EXPECT_EQ(facts(judgement)["convexity"],
            Json::parse(R"({"verdict": "unknown", "boundary_surfaces": 2, "reentrant_edges": 0,
    "edges": [], "reason": "some reason"})"));
}

TEST(CheckReport, RepairsAreCounted) {
  Judgement judgement;
  judgement.repair = RepairCounts{1, 0, 2, 3};
  EXPECT_EQ(middle(judgement),
            "  repaired: 3 cells reoriented, 2 cells without volume dropped, 1 nodes merged\n");
  judgement.repair->unmerged_nodes = 4;
  EXPECT_EQ(middle(judgement),
            "  repaired: 3 cells reoriented, 2 cells without volume dropped, 1 nodes merged\n"
            "  4 nodes at the place of another left apart (other field values there, or in one "
            "cell with it)\n");
  EXPECT_EQ(facts(judgement)["repair"],
            Json::parse(R"({"reoriented_cells": 3, "dropped_cells": 2, "merged_nodes": 1,
    "unmerged_nodes": 4})"));
}

Quality some_quality() {
  Distribution angles;
  angles.count = 5;
  angles.undefined = 2;
  angles.least = 12.34567;
  angles.largest = 88;
  angles.mean = 40.5;
  angles.least_at = 7;
  angles.largest_at = 3;
  angles.percentiles = {13, 14, 25.5, 40, 60, 80, 87};
  angles.histogram = {{20, 40.5, 60}, {1, 0, 3, 1}};
  Distribution ratios;
  ratios.undefined = 7;
  ratios.histogram = {{1}, {0, 0}};
  Quality quality;
  quality.parts = {2, 36, 3, 1, 4, 0, 0};
  quality.kinds = {{CellKind::prism6,
                    7,
                    1.0 / 3,
                    {{QualityFigure::least_dihedral, angles}, {QualityFigure::volume, ratios}}}};
  return quality;
}

TEST(CheckReport, QualityIsATableOfEveryKind) {
  EXPECT_EQ(
      quality_table(some_quality()),
      "  components 2, boundary faces 36, boundary shells 3, cavities 1, tunnels 4\n"
      "  quality of 7 prism6, volume 0.3333333333\n"
      "                                         least        1 %        5 %       25 %       50 %"
      "       75 %       95 %       99 %    largest  cells of both\n"
      "    least dihedral angle, degrees        12.35         13         14       25.5         40"
      "         60         80         87         88  7, 3; undefined in 2 cells\n"
      "      <20: 1  40.5..60: 3  >=60: 1\n"
      "    volume                          undefined in all 7 cells\n");
  Quality tangled = some_quality();
  tangled.kinds.clear();
  tangled.parts.tunnels.reset();
  tangled.parts.branching_edges = 5;
  tangled.parts.tangled_edges = 6;
  EXPECT_EQ(quality_table(tangled),
            "  components 2, boundary faces 36, boundary shells 3, cavities 1, tunnels not known\n"
            "  edges with more than two boundary faces: 5\n"
            "  edges whose boundary faces are in no order around them: 6\n");
  Quality defined = some_quality();
  defined.kinds[0].figures[0].distribution.undefined = 0;
  EXPECT_THAT(quality_table(defined), HasSubstr("  7, 3\n"));
  Judgement judgement;
  judgement.quality = defined;
  EXPECT_EQ(middle(judgement), quality_table(defined));
}

TEST(CheckReport, QualityIsAnObjectOfEveryKind) {
  Judgement judgement;
  judgement.quality = some_quality();
  EXPECT_EQ(facts(judgement)["quality"],
            Json::parse(R"({"components": 2, "boundary_faces": 36, "boundary_shells": 3,
    "cavities": 1, "tunnels": 4, "branching_edges": 0, "tangled_edges": 0, "kinds": [
      {"kind": "prism6", "cells": 7, "volume": 0.3333333333333333, "figures": [
        {"figure": "least_dihedral", "count": 5, "undefined": 2, "unit": "degrees",
         "least": 12.34567, "least_cell": 7, "largest": 88.0, "largest_cell": 3, "mean": 40.5,
         "percentiles": {"1": 13.0, "5": 14.0, "25": 25.5, "50": 40.0, "75": 60.0, "95": 80.0,
                         "99": 87.0},
         "histogram": {"edges": [20.0, 40.5, 60.0], "counts": [1, 0, 3, 1]}},
        {"figure": "volume", "count": 0, "undefined": 7}]}]})"));
  judgement.quality->parts.tunnels.reset();
  EXPECT_TRUE(facts(judgement)["quality"]["tunnels"].is_null());
}

}  // namespace
}  // namespace hiac::tools
