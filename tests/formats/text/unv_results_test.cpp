// Datasets 55 and 2414 of universal files: where their heads tell name, step and time, and what
// they are refused for (Universal File Datasets).
#include <cmath>

#include <fmt/format.h>

#include "formats/common/io/input_text.hpp"
#include "formats/unv/unv_file.hpp"
#include "tests/formats/complaints.hpp"

namespace hiac::formats {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string result_row(std::initializer_list<int> fields) {
  std::string text;
  for (const int field : fields) text += fmt::format("{:10}", field);
  return text + "\n";
}
std::string result_reals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += fmt::format("{:13.5E}", value);
  return text + "\n";
}
std::string result_dataset(int number, const std::string& lines) {
  return fmt::format("    -1\n{:6}\n", number) + lines + "    -1\n";
}

/// Two tetrahedra on five points, in 20 lines.
std::string two_solids() {
  std::string nodes;
  const std::vector<std::array<double, 3>> points{
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  for (std::size_t i = 0; i < points.size(); ++i)
    nodes += result_row({static_cast<int>(i + 1), 1, 1, 11}) +
             fmt::format("{:25.16E}{:25.16E}{:25.16E}\n", points[i][0], points[i][1], points[i][2]);
  return result_dataset(2411, nodes) +
         result_dataset(2412, result_row({7, 111, 1, 1, 7, 4}) + result_row({1, 2, 3, 4}) +
                                  result_row({9, 111, 1, 1, 7, 4}) + result_row({2, 3, 4, 5}));
}

/// What the head of a dataset 2414 says.
struct ResultHead {
  std::string name = "p";
  int location = 1;
  int analysis = 4;
  int characteristic = 1;
  int result = 94;
  int type = 2;
  int values = 1;
};

std::string data_2414(const ResultHead& head, const std::string& data) {
  return two_solids() +
         result_dataset(2414, result_row({1}) + head.name + "\n" + result_row({head.location}) +
                                  "A\nB\nC\nD\nE\n" +
                                  result_row({1, head.analysis, head.characteristic, head.result,
                                              head.type, head.values}) +
                                  result_row({0, 0, 0, 0, 0, 5, 6, 0}) + result_row({0, 0}) +
                                  result_reals({0.25, 0.5, 0, 0, 0, 0}) +
                                  result_reals({0, 0, 0, 0, 0, 0}) + data);
}

std::string data_55(std::initializer_list<int> codes, std::initializer_list<int> counts,
                    const std::string& rest) {
  return two_solids() +
         result_dataset(55, "A\nB\nC\nD\nE\n" + result_row(codes) + result_row(counts) + rest);
}

ForeignMesh result_mesh(const std::string& text) {
  const ScratchFolder folder;
  ForeignMesh mesh = unv::read_unv(std::make_shared<InputText>(folder.write("a.unv", text)));
  for (ForeignField& field : mesh.fields)
    field.values = [values = field.values()] { return values; };
  return mesh;
}

TEST(UnvHeads, AnalysesTellStepsAndTimesInTheirPlaces) {
  // static, normal modes, complex modes, transient, frequency response
  for (const auto& [analysis, time] :
       std::vector<std::pair<int, double>>{{1, 6}, {2, 0.5}, {3, 6}, {4, 0.25}, {5, 0.5}}) {
    const ForeignMesh mesh = result_mesh(data_2414({.analysis = analysis}, ""));
    EXPECT_THAT(mesh.times, ElementsAre(time)) << analysis;
  }
  // another step number at the same time is another step
  const std::string two = data_2414({.analysis = 2}, "") +
                          data_2414({.name = "q", .analysis = 2}, "").substr(two_solids().size()) +
                          data_2414({.analysis = 5}, "").substr(two_solids().size());
  const ForeignMesh mesh = result_mesh(two);
  EXPECT_THAT(mesh.times, ElementsAre(0.5, 0.5));
  ASSERT_EQ(mesh.fields.size(), 3U);
  EXPECT_EQ(mesh.fields[0].step, 0U);
  EXPECT_EQ(mesh.fields[1].step, 0U);
  EXPECT_EQ(mesh.fields[2].step, 1U);
}

TEST(UnvHeads, ResultsWithoutANameHaveThatOfTheirNumber) {
  for (const auto& [result, name] : std::vector<std::pair<int, std::string>>{{1, "result 1"},
                                                                             {2, "stress"},
                                                                             {3, "strain"},
                                                                             {4, "element force"},
                                                                             {5, "temperature"},
                                                                             {6, "heat flux"},
                                                                             {7, "strain energy"},
                                                                             {8, "displacement"},
                                                                             {9, "reaction force"},
                                                                             {10, "result 10"},
                                                                             {11, "velocity"},
                                                                             {12, "acceleration"},
                                                                             {13, "result 13"}}) {
    const ForeignMesh mesh = result_mesh(data_2414({.name = "  ", .result = result}, ""));
    EXPECT_EQ(mesh.fields.at(0).name, name);
    EXPECT_EQ(result_mesh(data_2414({.name = " T 1 ", .result = result}, "")).fields.at(0).name,
              "T 1");
  }
}

TEST(UnvHeads, NumbersOfValuesLocationsAndTypesAreChecked) {
  const std::string head = ":23: impossible numbers in the head of dataset 2414";
  const std::string place =
      ":25: data at nodes, on elements or at nodes on elements (1, 2, 3) "
      "expected (";
  expect_complaints("a.unv", {{data_2414({.values = 1}, ""), ""},
                              {data_2414({.values = 200}, ""), ""},
                              {data_2414({.values = 0}, ""), head},
                              {data_2414({.values = 201}, ""), head},
                              {data_2414({.location = 0}, ""), place + "0 found)"},
                              {data_2414({.location = 4}, ""), place + "4 found)"}});
  EXPECT_THAT(result_mesh(data_2414({.type = 4}, "")).fields.size(), 1U);
  for (const int type : {1, 3, 5}) {
    const ForeignMesh mesh = result_mesh(data_2414({.type = type}, ""));
    EXPECT_THAT(mesh.notes, ElementsAre("left out result 'p': its values are not real")) << type;
    EXPECT_THAT(mesh.fields, IsEmpty());
  }
}

TEST(UnvValues, AreAtNodesOnElementsOrAtNodesOnElements) {
  const ForeignMesh nodes =
      result_mesh(data_2414({.values = 2}, result_row({4}) + result_reals({1, 2}) +
                                               result_row({2}) + result_reals({3, 4})));
  const auto at_nodes = nodes.fields.at(0).values();
  ASSERT_EQ(at_nodes.size(), 10U);
  EXPECT_TRUE(std::isnan(at_nodes[0]));
  EXPECT_EQ(at_nodes[2], 3);
  EXPECT_EQ(at_nodes[3], 4);
  EXPECT_EQ(at_nodes[6], 1);
  EXPECT_EQ(at_nodes[7], 2);
  const ForeignMesh cells = result_mesh(
      data_2414({.location = 2, .values = 7},
                result_row({9, 7}) + result_reals({1, 2, 3, 4, 5, 6}) + result_reals({7})));
  EXPECT_EQ(cells.fields.at(0).location, FieldLocation::cell);
  const auto of_cells = cells.fields[0].values();
  EXPECT_TRUE(std::isnan(of_cells[0]));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(of_cells[7 + i], static_cast<double>(i + 1));
  const ForeignMesh corners = result_mesh(
      data_2414({.location = 3}, result_row({9, 1, 4, 1}) + result_reals({1}) + result_reals({2}) +
                                     result_reals({3}) + result_reals({4}) +
                                     result_row({7, 2, 4, 1}) + result_reals({8})));
  EXPECT_EQ(corners.fields.at(0).location, FieldLocation::corner);
  EXPECT_THAT(corners.fields[0].values(), ElementsAre(8, 8, 8, 8, 1, 2, 3, 4));
}

TEST(UnvValues, SymmetricTensorsHaveTheirOwnOrder) {
  const std::string row = result_row({1}) + result_reals({11, 12, 22, 13, 23, 33});
  const auto tensor = result_mesh(data_2414({.characteristic = 4, .values = 6}, row));
  const auto values = tensor.fields.at(0).values();
  EXPECT_THAT(std::vector<double>(values.begin(), values.begin() + 6),
              ElementsAre(11, 22, 33, 12, 23, 13));
  const auto plain = result_mesh(data_2414({.characteristic = 3, .values = 6}, row));
  const auto as_written = plain.fields.at(0).values();
  EXPECT_THAT(std::vector<double>(as_written.begin(), as_written.begin() + 6),
              ElementsAre(11, 12, 22, 13, 23, 33));
}

TEST(UnvValues, CountsFitTheMesh) {
  const auto cell = [](int number, int values) {
    return data_2414({.location = 2, .values = 2},
                     result_row({number, values}) + result_reals({1, 2}));
  };
  const auto corner = [](int number, int nodes, int values) {
    std::string data = result_row({number, 1, nodes, values});
    for (int n = 0; n < nodes; ++n) data += result_reals({1, 2});
    return data_2414({.location = 3, .values = 2}, data);
  };
  const std::string message = ":36: values at 4 nodes, 2 each, expected";
  expect_complaints("a.unv", {{cell(7, 2), ""},
                              {cell(7, 1), ":36: 2 values expected"},
                              {cell(7, 3), ":36: 2 values expected"},
                              {cell(8, 2), ":36: a value for 8, which there is not"},
                              {corner(9, 4, 2), ""},
                              {corner(9, 3, 2), message},
                              {corner(9, 5, 2), message},
                              {corner(9, 4, 1), message},
                              {corner(9, 4, 3), message},
                              {data_2414({}, result_row({6}) + result_reals({1})),
                               ":36: a value for 6, which there is not"},
                              {data_2414({}, result_row({5}) + "x\n"),
                               ":37: a real in columns 1 to 13 expected ('x' found)"}});
}

TEST(UnvHeads, Dataset55TellsTheSameInOtherPlaces) {
  const std::string values = result_row({4}) + result_reals({7, 8, 9});
  // transient: load case and time step; the time
  const ForeignMesh transient =
      result_mesh(data_55({1, 4, 2, 8, 2, 3}, {2, 1, 11, 12}, result_reals({0.75}) + values));
  EXPECT_THAT(transient.times, ElementsAre(0.75));
  EXPECT_EQ(transient.fields.at(0).name, "displacement");
  EXPECT_EQ(transient.fields[0].components, 3U);
  EXPECT_EQ(transient.fields[0].location, FieldLocation::node);
  const auto all = transient.fields[0].values();
  ASSERT_EQ(all.size(), 15U);
  EXPECT_TRUE(std::isnan(all[8]));
  EXPECT_EQ(all[9], 7);
  EXPECT_EQ(all[11], 9);
  // static: the load case is the step; more than six reals take two lines
  EXPECT_THAT(
      result_mesh(data_55({1, 1, 2, 8, 2, 3}, {1, 1, 11}, result_reals({0.5}) + values)).times,
      ElementsAre(11));
  EXPECT_THAT(result_mesh(data_55({1, 2, 2, 8, 2, 3}, {2, 7, 11, 12},
                                  result_reals({0.5, 1, 1, 1, 1, 1}) + result_reals({1}) + values))
                  .times,
              ElementsAre(0.5));
  EXPECT_THAT(result_mesh(data_55({1, 4, 2, 8, 2, 3}, {1, 0, 11}, "\n" + values)).times,
              ElementsAre(11));
}

TEST(UnvHeads, Dataset55HasUpTo6IntegersAnd12Reals) {
  const auto counts = [](int integers, int reals) {
    std::string rest = result_reals({0.5, 1, 1, 1, 1, 1});
    if (reals > 6) rest += result_reals({1});
    return data_55({1, 4, 2, 8, 2, 3}, {integers, reals, 1, 2, 3, 4, 5, 6}, rest);
  };
  const auto refused = [&](int integers, int reals) {
    return Complaint{counts(integers, reals),
                     fmt::format(":29: impossible numbers of integers and reals ({} and {} found)",
                                 integers, reals)};
  };
  expect_complaints("a.unv", {{counts(0, 1), ""},
                              {counts(6, 12), ""},
                              {counts(1, 0), ""},
                              refused(7, 1),
                              refused(-1, 1),
                              refused(1, 13),
                              refused(1, -1)});
}

}  // namespace
}  // namespace hiac::formats
