#pragma once

#include <array>

#include "hiac/mesh/cell_kind.hpp"

namespace hiac::formats {

// The edges of elements in the order in which several formats list their nodes: round the bottom,
// up the sides, round the top. Corners as in the zoo, the prism right-handed.

inline constexpr std::array<ShapeEdge, 6> kUprightTetrahedron{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<ShapeEdge, 8> kUprightPyramid{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
inline constexpr std::array<ShapeEdge, 9> kUprightPrism{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}}};
inline constexpr std::array<ShapeEdge, 12> kUprightBrick{{{0, 1},
                                                          {1, 2},
                                                          {2, 3},
                                                          {3, 0},
                                                          {0, 4},
                                                          {1, 5},
                                                          {2, 6},
                                                          {3, 7},
                                                          {4, 5},
                                                          {5, 6},
                                                          {6, 7},
                                                          {7, 4}}};

}  // namespace hiac::formats
