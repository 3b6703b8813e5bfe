#include "formats/gmsh/gmsh_types.hpp"

#include <array>
#include <map>

#include <fmt/format.h>

#include "formats/common/cells/edge_order.hpp"

namespace hiac::formats::gmsh {
namespace {

// Edges in Gmsh's order and direction (reference manual, "Node ordering": the nodes of the
// quadratic elements; cubic ones have the same order with two nodes per edge, as in Gmsh's
// MTetrahedron::edge_tetra and its counterparts).
constexpr std::array<ShapeEdge, 6> kTetrahedron{{{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}}};
constexpr std::array<ShapeEdge, 8> kPyramid{
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}};
constexpr std::array<ShapeEdge, 9> kPrism{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
constexpr std::array<ShapeEdge, 12> kBrick{{{0, 1},
                                            {0, 3},
                                            {0, 4},
                                            {1, 2},
                                            {1, 5},
                                            {2, 3},
                                            {2, 6},
                                            {3, 7},
                                            {4, 5},
                                            {4, 7},
                                            {5, 6},
                                            {6, 7}}};
/// Gmsh's faces of the tetrahedron: 0 2 1, 0 1 3, 0 3 2, 3 1 2.
constexpr std::array<std::uint8_t, 4> kTetrahedronFaces{1, 3, 2, 0};

struct KnownKind {
  int number;
  CellKind kind;
};
constexpr std::array<KnownKind, 12> kKinds{{{4, CellKind::tetrahedron4},
                                            {5, CellKind::brick8},
                                            {6, CellKind::prism6},
                                            {7, CellKind::pyramid5},
                                            {11, CellKind::tetrahedron10},
                                            {17, CellKind::brick20},
                                            {18, CellKind::prism15},
                                            {19, CellKind::pyramid13},
                                            {29, CellKind::tetrahedron20},
                                            {99, CellKind::brick32},
                                            {111, CellKind::prism24},
                                            {125, CellKind::pyramid21}}};

/// Elements that the zoo has no kind for, by number and number of nodes.
struct Other {
  int number;
  int nodes;
};
constexpr std::array<Other, 15> kTetrahedra{{{30, 35},
                                             {31, 56},
                                             {32, 22},
                                             {33, 28},
                                             {71, 84},
                                             {72, 120},
                                             {73, 165},
                                             {74, 220},
                                             {75, 286},
                                             {79, 34},
                                             {80, 40},
                                             {81, 46},
                                             {82, 52},
                                             {83, 58},
                                             {137, 16}}};
constexpr std::array<Other, 14> kBricks{{{12, 27},
                                         {92, 64},
                                         {93, 125},
                                         {94, 216},
                                         {95, 343},
                                         {96, 512},
                                         {97, 729},
                                         {98, 1000},
                                         {100, 44},
                                         {101, 56},
                                         {102, 68},
                                         {103, 80},
                                         {104, 92},
                                         {105, 104}}};
constexpr std::array<Other, 14> kPrisms{{{13, 18},
                                         {90, 40},
                                         {91, 75},
                                         {106, 126},
                                         {107, 196},
                                         {108, 288},
                                         {109, 405},
                                         {110, 550},
                                         {112, 33},
                                         {113, 42},
                                         {114, 51},
                                         {115, 60},
                                         {116, 69},
                                         {117, 78}}};
constexpr std::array<Other, 14> kPyramids{{{14, 14},
                                           {118, 30},
                                           {119, 55},
                                           {120, 91},
                                           {121, 140},
                                           {122, 204},
                                           {123, 285},
                                           {124, 385},
                                           {126, 29},
                                           {127, 37},
                                           {128, 45},
                                           {129, 53},
                                           {130, 61},
                                           {131, 69}}};
constexpr std::array<Other, 4> kPoints{{{15, 1}, {84, 1}, {85, 1}, {86, 1}}};
constexpr std::array<Other, 10> kLines{
    {{1, 2}, {8, 3}, {26, 4}, {27, 5}, {28, 6}, {62, 7}, {63, 8}, {64, 9}, {65, 10}, {66, 11}}};
constexpr std::array<Other, 18> kTriangles{{{2, 3},
                                            {9, 6},
                                            {20, 9},
                                            {21, 10},
                                            {22, 12},
                                            {23, 15},
                                            {24, 15},
                                            {25, 21},
                                            {42, 28},
                                            {43, 36},
                                            {44, 45},
                                            {45, 55},
                                            {46, 66},
                                            {52, 18},
                                            {53, 21},
                                            {54, 24},
                                            {55, 27},
                                            {56, 30}}};
constexpr std::array<Other, 19> kQuadrilaterals{{{3, 4},
                                                 {10, 9},
                                                 {16, 8},
                                                 {36, 16},
                                                 {37, 25},
                                                 {38, 36},
                                                 {39, 12},
                                                 {40, 16},
                                                 {41, 20},
                                                 {47, 49},
                                                 {48, 64},
                                                 {49, 81},
                                                 {50, 100},
                                                 {51, 121},
                                                 {57, 24},
                                                 {58, 28},
                                                 {59, 32},
                                                 {60, 36},
                                                 {61, 40}}};

std::span<const ShapeEdge> edges_of(CellShape shape) {
  switch (shape) {
    case CellShape::tetrahedron:
      return kTetrahedron;
    case CellShape::pyramid:
      return kPyramid;
    case CellShape::prism:
      return kPrism;
    default:
      return kBrick;
  }
}

const std::vector<std::uint8_t>& permutation_of(CellKind kind) {
  static const std::map<CellKind, std::vector<std::uint8_t>> permutations = [] {
    std::map<CellKind, std::vector<std::uint8_t>> result;
    for (const KnownKind& known : kKinds) {
      const CellShape shape = shape_of(known.kind);
      const std::span<const std::uint8_t> corners =
          shape == CellShape::prism ? std::span<const std::uint8_t>(kRightHandedPrism)
                                    : std::span<const std::uint8_t>();
      const std::span<const std::uint8_t> faces =
          known.kind == CellKind::tetrahedron20 ? std::span<const std::uint8_t>(kTetrahedronFaces)
                                                : std::span<const std::uint8_t>();
      result[known.kind] = permutation_by_edges(known.kind, corners, edges_of(shape), faces);
    }
    return result;
  }();
  return permutations.at(kind);
}

std::string_view name_of(CellShape shape) {
  constexpr std::array<std::string_view, kShapeCount> kNames{"Tetrahedron", "Pyramid", "Prism", "",
                                                             "Hexahedron"};
  return kNames[static_cast<std::size_t>(shape)];
}

using TypeTable = std::map<std::int64_t, ForeignType>;

void add_unsupported(std::span<const Other> others, CellKind corners, TypeTable& table) {
  for (const Other& other : others) {
    CellConversion conversion;
    conversion.corners = corners;
    conversion.permutation = std::span(permutation_of(corners));
    table[other.number] = {std::string(name_of(shape_of(corners))),
                           static_cast<std::size_t>(other.nodes), conversion};
  }
}

void add_flat(std::span<const Other> others, std::string_view name, TypeTable& table) {
  for (const Other& other : others) {
    CellConversion conversion;
    conversion.fate = CellFate::no_volume;
    table[other.number] = {
        name == "Point" ? std::string(name) : fmt::format("{} {}", name, other.nodes),
        static_cast<std::size_t>(other.nodes), conversion};
  }
}

TypeTable make_table() {
  TypeTable table;
  for (const KnownKind& known : kKinds) {
    CellConversion conversion;
    conversion.fate = CellFate::converted;
    conversion.kind = known.kind;
    conversion.permutation = std::span(permutation_of(known.kind));
    table[known.number] = {
        fmt::format("{} {}", name_of(shape_of(known.kind)), node_count(known.kind)),
        node_count(known.kind), conversion};
  }
  add_unsupported(kTetrahedra, CellKind::tetrahedron4, table);
  add_unsupported(kBricks, CellKind::brick8, table);
  add_unsupported(kPrisms, CellKind::prism6, table);
  add_unsupported(kPyramids, CellKind::pyramid5, table);
  add_flat(kPoints, "Point", table);
  add_flat(kLines, "Line", table);
  add_flat(kTriangles, "Triangle", table);
  add_flat(kQuadrilaterals, "Quadrilateral", table);
  return table;
}

}  // namespace

const ForeignType* element_type(std::int64_t number) {
  static const TypeTable table = make_table();
  const auto found = table.find(number);
  return found == table.end() ? nullptr : &found->second;
}

const std::optional<WrittenType>& written_type(CellKind kind) {
  static const std::array<std::optional<WrittenType>, kKindCount> table = [] {
    std::array<std::optional<WrittenType>, kKindCount> result;
    for (const KnownKind& known : kKinds) {
      const std::vector<std::uint8_t>& permutation = permutation_of(known.kind);
      WrittenType written{known.number, std::vector<std::uint8_t>(permutation.size())};
      for (std::size_t i = 0; i < permutation.size(); ++i)
        written.nodes[permutation[i]] = static_cast<std::uint8_t>(i);
      result[static_cast<std::size_t>(known.kind)] = std::move(written);
    }
    return result;
  }();
  return table[static_cast<std::size_t>(kind)];
}

}  // namespace hiac::formats::gmsh
