#include "hiac/derive/derive_field.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hiac/base/error.hpp"

namespace hiac {
namespace {

using testing::HasSubstr;

// Two tetrahedra with a common face and a node that no cell uses; fields of every kind.
ZooMesh sample() {
  ZooMesh mesh;
  mesh.kinds = std::vector{CellKind::tetrahedron4, CellKind::tetrahedron4};
  mesh.elems = std::vector<std::uint64_t>{0, 4, 8};
  mesh.nodes = std::vector<NodeId>{0, 1, 2, 3, 1, 2, 3, 4};
  mesh.xyz = std::vector<double>{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 2, 2, 2, 9, 9, 9};
  const auto add = [&](const char* name, FieldLocation location, std::uint32_t components,
                       std::size_t tuples, double first) {
    std::vector<double> values(tuples * components);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = first + 0.75 * static_cast<double>(i);
    mesh.fields.push_back({name, "Pa", location, components, std::move(values)});
  };
  add("p", FieldLocation::node, 1, 6, -2);
  add("v", FieldLocation::node, 3, 6, 1);
  add("S Mises", FieldLocation::node, 6, 6, -3);
  add("c", FieldLocation::cell, 1, 2, 5);
  add("k", FieldLocation::corner, 1, 8, 0.5);
  return mesh;
}

double value_of(const ZooMesh& mesh, const char* reference, std::size_t i) {
  return scalar_field(mesh, reference).values[i];
}

// What an expression is, told again in C++, for tuple i.
using Truth = std::function<double(const ZooMesh&, std::size_t)>;

struct Case {
  const char* text;
  FieldLocation location;
  Truth truth;
};

const Case kCases[] = {
    {"2*p + 1", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) { return 2 * value_of(m, "p", i) + 1; }},
    {"-p^2", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) { return -std::pow(value_of(m, "p", i), 2); }},
    {"v:x - v:z/4", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) {
       return value_of(m, "v:x", i) - value_of(m, "v:z", i) / 4;
     }},
    {"magnitude(v)", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) { return value_of(m, "v:magnitude", i); }},
    {"sqrt(v:x^2+v:y^2+v:z^2)", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) { return value_of(m, "v:magnitude", i); }},
    {"von_mises(S Mises) * 1.5e-1", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) { return 0.15 * value_of(m, "S Mises:von_mises", i); }},
    {"\"S Mises\":xy + principal_3(\"S Mises\")", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) {
       return value_of(m, "S Mises:xy", i) + value_of(m, "S Mises:principal_3", i);
     }},
    {"p > 0 && p <= 1 ? ln(p) : exp(-p)", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) {
       const double p = value_of(m, "p", i);
       return p > 0 && p <= 1 ? std::log(p) : std::exp(-p);
     }},
    {"p == -2 || p != p", FieldLocation::node,
     [](const ZooMesh&, std::size_t i) { return i == 0 ? 1.0 : 0.0; }},
    {"sin(pi*x) + y*z", FieldLocation::node,
     [](const ZooMesh& m, std::size_t i) {
       const auto at = m.position(static_cast<NodeId>(i));
       return std::sin(std::numbers::pi * at[0]) + at[1] * at[2];
     }},
    {"c*10 + y", FieldLocation::cell,
     [](const ZooMesh& m, std::size_t i) {
       return value_of(m, "c", i) * 10 + (i == 0 ? 0.5 : 1.0);
     }},
    {"cell_average(p) - c", FieldLocation::cell,
     [](const ZooMesh& m, std::size_t i) {
       double sum = 0;
       for (const NodeId node : m.cell_nodes(static_cast<CellId>(i))) sum += value_of(m, "p", node);
       return sum / 4 - value_of(m, "c", i);
     }},
    {"k + p + 100*c + 1000*x", FieldLocation::corner,
     [](const ZooMesh& m, std::size_t i) {
       const NodeId node = m.nodes[i];
       return value_of(m, "k", i) + value_of(m, "p", node) + 100 * value_of(m, "c", i / 4) +
              1000 * m.position(node)[0];
     }},
    {"7", FieldLocation::node, [](const ZooMesh&, std::size_t) { return 7.0; }},
};

TEST(DeriveField, ComputesWhatAnExpressionSays) {
  const ZooMesh mesh = sample();
  for (const Case& one : kCases) {
    SCOPED_TRACE(one.text);
    const Field field = derive_field(mesh, std::string("q = ") + one.text);
    EXPECT_EQ(field.name, "q");
    EXPECT_EQ(field.components, 1U);
    ASSERT_EQ(field.location, one.location);
    const std::size_t count = one.location == FieldLocation::node   ? 6
                              : one.location == FieldLocation::cell ? 2
                                                                    : 8;
    ASSERT_EQ(field.values.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      const double truth = one.truth(mesh, i);
      EXPECT_NEAR(field.values[i], truth, 1e-14 * (1 + std::abs(truth))) << i;
    }
  }
}

TEST(DeriveField, PutsVectorsAndTensorsTogether) {
  const ZooMesh mesh = sample();
  const Field vector = derive_field(mesh, "u=vector(p, min(v:x, 3), -1)");
  ASSERT_EQ(vector.components, 3U);
  ASSERT_EQ(vector.location, FieldLocation::node);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(vector.values[3 * i], value_of(mesh, "p", i));
    EXPECT_EQ(vector.values[3 * i + 1], std::min(value_of(mesh, "v:x", i), 3.0));
    EXPECT_EQ(vector.values[3 * i + 2], -1);
  }
  const Field tensor = derive_field(mesh, "t=tensor(1, 2, 3, 4, 5, c)");
  ASSERT_EQ(tensor.components, 6U);
  ASSERT_EQ(tensor.location, FieldLocation::cell);
  EXPECT_EQ(tensor.values[6 + 4], 5);
  EXPECT_EQ(tensor.values[6 + 5], value_of(mesh, "c", 1));
}

TEST(DeriveField, TakesDeviatorsAndPrincipalValues) {
  const ZooMesh mesh = sample();
  const Field rest = derive_field(mesh, "d=deviator(S Mises)");
  const Field principal = derive_field(mesh, "s=principal(\"S Mises\")");
  ASSERT_EQ(rest.components, 6U);
  ASSERT_EQ(principal.components, 3U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(rest.values[6 * i],
                     value_of(mesh, "S Mises:xx", i) - value_of(mesh, "S Mises:trace", i) / 3);
    EXPECT_EQ(rest.values[6 * i + 5], value_of(mesh, "S Mises:xz", i));
    EXPECT_EQ(principal.values[3 * i], value_of(mesh, "S Mises:principal_1", i));
    EXPECT_EQ(principal.values[3 * i + 2], value_of(mesh, "S Mises:principal_3", i));
  }
}

// Of nine components, the symmetric part.
TEST(DeriveField, TakesTensorsOfNineComponents) {
  ZooMesh mesh = sample();
  mesh.fields.push_back({"F", "", FieldLocation::cell, 9,
                         std::vector<double>{3, 1, 0, 3, 6, 0, 0, 0, 0,  //
                                             1, 0, 4, 0, 2, 0, -4, 0, 3}});
  const Field rest = derive_field(mesh, "d=deviator(F)"),
              principal = derive_field(mesh, "s=principal(F)");
  ASSERT_EQ(rest.components, 6U);
  ASSERT_EQ(principal.components, 3U);
  EXPECT_EQ(rest.location, FieldLocation::cell);
  EXPECT_THAT(std::vector(rest.values.begin(), rest.values.end()),
              testing::ElementsAre(0, 3, -3, 2, 0, 0, -1, 0, 1, 0, 0, 0));
  ASSERT_EQ(principal.values.size(), 6U);
  // 4.5 +- sqrt(1.5^2 + 2^2), and 0
  EXPECT_NEAR(principal.values[0], 7, 1e-14);
  EXPECT_NEAR(principal.values[1], 2, 1e-14);
  EXPECT_NEAR(principal.values[2], 0, 1e-14);
  EXPECT_NEAR(principal.values[3], 3, 1e-14);
  EXPECT_NEAR(principal.values[4], 2, 1e-14);
  EXPECT_NEAR(principal.values[5], 1, 1e-14);
}

TEST(DeriveField, AveragesWholeFields) {
  const ZooMesh mesh = sample();
  const Field at_nodes = derive_field(mesh, "n=node_average(c)");
  ASSERT_EQ(at_nodes.location, FieldLocation::node);
  EXPECT_EQ(at_nodes.values[0], 5);
  EXPECT_EQ(at_nodes.values[1], 5.375);
  EXPECT_EQ(at_nodes.values[4], 5.75);
  EXPECT_TRUE(std::isnan(at_nodes.values[5]));
  const Field at_cells = derive_field(mesh, "m=cell_average(v)");
  ASSERT_EQ(at_cells.location, FieldLocation::cell);
  EXPECT_EQ(at_cells.components, 3U);
}

TEST(DeriveField, KeepsTheUnitOfOneField) {
  const ZooMesh mesh = sample();
  EXPECT_EQ(derive_field(mesh, "q=magnitude(v)").unit, "Pa");
  EXPECT_EQ(derive_field(mesh, "q=node_average(c)").unit, "Pa");
  EXPECT_EQ(derive_field(mesh, "q=deviator(S Mises)").unit, "Pa");
  EXPECT_EQ(derive_field(mesh, "q=p*p").unit, "");
  EXPECT_EQ(derive_field(mesh, "q=sqrt(p)").unit, "");
  EXPECT_EQ(derive_field(mesh, "q=(2*p)").unit, "");
}

// A field hides the coordinate or the constant of its name.
TEST(DeriveField, PrefersFieldsToCoordinates) {
  ZooMesh mesh = sample();
  mesh.fields[0].name = "x";
  EXPECT_EQ(derive_field(mesh, "q=x").values[1], -1.25);
  mesh.fields[0].name = "pi";
  EXPECT_EQ(derive_field(mesh, "q=pi").values[1], -1.25);
}

TEST(DeriveField, RefusesWhatItDoesNotUnderstand) {
  const ZooMesh mesh = sample();
  const std::vector<std::pair<std::string, std::string>> rows{
      {"q", "derive q: not understood (NAME=EXPRESSION expected)"},
      {"=p", "NAME=EXPRESSION expected"},
      {"q=", "NAME=EXPRESSION expected"},
      {"q=w", "field 'w'"},
      {"q=v", "field 'v'"},
      {"q=v:w", "field 'v:w'"},
      {"q=curl(v)", "there is no function curl"},
      {"q=magnitude(w)", "field 'w:magnitude'"},
      {"q=(p", "not understood"},
      {"q=magnitude(v", "a ( is not closed"},
      {"q=\"p", "a \" is not closed"},
      {"q=p+", "not understood"},
      {"q=p p", "not understood"},
      {"q=1+", "not understood ("},
      {"q=p=1", "single ="},
      {"q=min(p", "not understood"},
      {"q=p+c", "'p' is a field of nodes, 'c' one of cells (node_average(c) or cell_average(p)"},
      {"q=vector(p,p)", "3 arguments expected, 2 found"},
      {"q=deviator(v)", "has 3 components"},
      {"q=principal(w)", "field 'w': there is no such field (expected one of p, v, S Mises, c, k)"},
      {"q=node_average(p)", "is one of nodes already"},
      {"q=cell_average(c)", "is one of cells already"},
      {"p=2*p", "there is already a field 'p'"}};
  for (const auto& [formula, message] : rows) {
    try {
      derive_field(mesh, formula);
      ADD_FAILURE() << formula;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message)) << formula;
      EXPECT_THAT(error.what(), HasSubstr("derive " + formula)) << formula;
    }
  }
}

TEST(DeriveField, MessagesNameTheFormula) {
  ZooMesh mesh = sample();
  const auto told = [&](const char* formula) -> std::string {
    try {
      derive_field(mesh, formula);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told("q = deviator(v)"),
            "derive q = deviator(v): field 'v' has 3 components (a tensor of 6 or 9 expected)");
  EXPECT_EQ(told("q=principal(p)"),
            "derive q=principal(p): field 'p' has 1 components (a tensor of 6 or 9 expected)");
  EXPECT_EQ(told("q=deviator(\"S Mises\")"), "");
  EXPECT_EQ(told("q=tensor(p,p,p,p,p)"),
            "derive q=tensor(p,p,p,p,p): tensor: 6 arguments expected, 5 found");
  EXPECT_EQ(told("q=vector(p,p,p,p)"),
            "derive q=vector(p,p,p,p): vector: 3 arguments expected, 4 found");
  EXPECT_EQ(told("p = 2*p"), "derive p = 2*p: there is already a field 'p'");
  EXPECT_EQ(told("p = 2*c"), "");  // one of another location
  mesh.fields.clear();
  EXPECT_EQ(told("q=principal(w)"),
            "derive q=principal(w): field 'w': there is no such field (the mesh has none)");
}

TEST(DeriveField, CommasWithinParenthesesAndQuotesPartNothing) {
  ZooMesh mesh = sample();
  mesh.fields.push_back(mesh.fields[0]);
  mesh.fields.back().name = "a,b)";
  const Field field = derive_field(mesh, "q = vector(min(p, 2), \"a,b)\", -p)");
  ASSERT_EQ(field.components, 3U);
  for (std::size_t i = 0; i < 6; ++i) {
    const double p = value_of(mesh, "p", i);
    EXPECT_EQ(field.values[3 * i], std::min(p, 2.0));
    EXPECT_EQ(field.values[3 * i + 1], p);
    EXPECT_EQ(field.values[3 * i + 2], -p);
  }
  EXPECT_EQ(field.unit, "");
  EXPECT_EQ(derive_field(mesh, "q =  p ").unit, "Pa");
}

// Numbers with and without points and exponents, comparisons of one sign and of two, white space,
// and fields whose names hold more than letters: each against what it is in C++, where the field
// is 2.
TEST(DeriveField, TakesTextsApartByTheirSigns) {
  ZooMesh mesh = sample();
  for (const char* name : {"e", "e1", "_a", "a.b", "T_2",
                           "gr\xc3\xb6\xc3\x9f"
                           "e",
                           "s p", "p@q"})
    mesh.fields.push_back({name, "", FieldLocation::cell, 1, std::vector<double>{2, 2}});
  const std::pair<const char*, double> rows[] = {
      {"12", 12},
      {"1.25*e", 2.5},
      {".5*e", 1},
      {"1e2*e", 200},
      {"1E2", 100},
      {"1e+2", 100},
      {"2.5e-2*e", 0.05},
      {"3e1+e1", 32},
      {"e*e1", 4},
      {"_a*10+a.b", 22},
      {"T_2-1", 1},
      {"gr\xc3\xb6\xc3\x9f"
       "e+1",
       3},
      {"\"s p\"+1", 3},
      {"\"s p\"@cell+1", 3},
      {"e@cell+1", 3},
      {"e:value+1", 3},
      {"p@q+1", 3},
      {"e>=2 ? 5 : 6", 5},
      {"e<=2 ? 5 : 6", 5},
      {"e>2 ? 5 : 6", 6},
      {"e<2 ? 5 : 6", 6},
      {"e==2 ? 5 : 6", 5},
      {"e!=2 ? 5 : 6", 6},
      {"e==3 ? 5 : 6", 6},
      {"(e>1)+10*(e>=3)", 1},
      {"max(e,3)", 3},
      {"max (e, 3)", 3},
      {" magnitude( e ) ", 2},
      {"magnitude (e)*e", 4},
      {"cell_average(p@node)*0 + e", 2},
      {"\te + e\n", 4},
      {"2*(e)", 4},
      {"(e)*(e)", 4},
      {"(2)*magnitude(e)", 4},
      {"pi - pi + e", 2},
      {"pi*0 + sqrt(e*2)", 2},
  };
  for (const auto& [text, value] : rows) {
    const Field field = derive_field(mesh, std::string(" \t q\r\n=") + text);
    EXPECT_EQ(field.name, "q");
    // an expression of numbers alone has values at the nodes
    ASSERT_EQ(field.values.size(), field.location == FieldLocation::cell ? 2U : 6U) << text;
    for (const double found : field.values) EXPECT_DOUBLE_EQ(found, value) << text;
  }
}

TEST(DeriveField, AveragesWithinExpressions) {
  const ZooMesh mesh = sample();
  const Field at_nodes = derive_field(mesh, "q=2*node_average(c) + p");
  ASSERT_EQ(at_nodes.location, FieldLocation::node);
  EXPECT_EQ(at_nodes.values[0], 2 * 5 - 2);
  EXPECT_EQ(at_nodes.values[1], 2 * 5.375 - 1.25);
  EXPECT_EQ(at_nodes.values[4], 2 * 5.75 + 1);
  // of a component, which is none of a whole field
  const Field of_vector = derive_field(mesh, "q=cell_average(v:y)");
  EXPECT_EQ(of_vector.components, 1U);
  ASSERT_EQ(of_vector.location, FieldLocation::cell);
  for (CellId cell = 0; cell < 2; ++cell) {
    double sum = 0;
    for (const NodeId node : mesh.cell_nodes(cell)) sum += value_of(mesh, "v:y", node);
    EXPECT_DOUBLE_EQ(of_vector.values[cell], sum / 4);
  }
}

// The mean of a cell's nodes, along each axis.
TEST(DeriveField, CellsAreInTheirMiddles) {
  const ZooMesh mesh = sample();
  const Field field = derive_field(mesh, "q=0*c + x + 10*y + 100*z");
  EXPECT_DOUBLE_EQ(field.values[0], 0.5 * 111);
  EXPECT_DOUBLE_EQ(field.values[1], 111);
  const Field bent = derive_field(mesh, "q=0*k + x + 10*y + 100*z");
  const double corners[] = {0, 2, 20, 200, 2, 20, 200, 222};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(bent.values[i], corners[i]);
}

}  // namespace
}  // namespace hiac
