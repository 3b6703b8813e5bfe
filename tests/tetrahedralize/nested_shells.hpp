#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hiac/tetrahedralize/surface.hpp"
#include "tests/tetrahedralize/surfaces.hpp"

namespace hiac::test {

/// A box or an octahedron, with whole-number coordinates, oriented outwards or inwards.
struct Shell {
  std::array<double, 3> low{}, high{};
  bool octahedron = false;
  int turn = 1;  ///< 1: outwards
  std::vector<std::size_t> children;

  [[nodiscard]] double volume() const {
    const double box = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    return octahedron ? box / 6 : box;
  }

  /// 1 inside, 0 on it, -1 outside.
  [[nodiscard]] int side(const std::array<double, 3>& p) const {
    double farthest = 0, sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double from_middle = std::abs(2 * p[c] - low[c] - high[c]) / (high[c] - low[c]);
      farthest = std::max(farthest, from_middle);
      sum += from_middle;
    }
    const double reach = octahedron ? sum : farthest;
    return reach < 1 ? 1 : (reach == 1 ? 0 : -1);
  }

  [[nodiscard]] Surface surface() const {
    Surface shell = box_surface(low, high);
    if (octahedron) {
      shell = {};
      std::array<double, 3> middle{};
      for (std::size_t c = 0; c < 3; ++c) middle[c] = (low[c] + high[c]) / 2;
      for (std::size_t c = 0; c < 3; ++c)
        for (const double end : {low[c], high[c]}) {
          shell.points.push_back(middle);
          shell.points.back()[c] = end;
        }
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint32_t x = corner % 2, y = 2 + corner / 2 % 2, z = 4 + corner / 4;
        const bool odd = (corner % 2 + corner / 2 % 2 + corner / 4) % 2 == 0;
        shell.facets.push_back({{odd ? std::vector{x, z, y} : std::vector{x, y, z}}, {}});
      }
    }
    for (Facet& facet : shell.facets)
      if (turn < 0) std::swap(facet.polygons[0][1], facet.polygons[0][2]);
    return shell;
  }
};

/// Shells within shells, none of which touch, and their surface with the shells in random order.
struct NestedShells {
  std::vector<Shell> shells;
  Surface surface;

  /// By the shells that are around it; the point must be on none.
  [[nodiscard]] int winding(const std::array<double, 3>& p) const {
    int sum = 0;
    for (const Shell& shell : shells) sum += shell.side(p) > 0 ? shell.turn : 0;
    return sum;
  }
  /// Of the part inside a shell and outside its children.
  [[nodiscard]] double volume(const Shell& shell) const {
    double volume = shell.volume();
    for (const std::size_t child : shell.children) volume -= shells[child].volume();
    return volume;
  }
};

/// Adds up to two shells side by side within a box, and theirs, and so on.
template <typename Random>
std::vector<std::size_t> add_shells(std::vector<Shell>& shells, const std::array<double, 3>& low,
                                    const std::array<double, 3>& high, bool octahedra,
                                    Random& random) {
  std::vector<std::size_t> added;
  const std::size_t axis = random() % 3;
  const double middle = 2 * std::floor((low[axis] + high[axis]) / 4);
  const std::size_t slots = shells.empty() ? 1 : random() % 3;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    Shell shell;
    bool fits = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const double from = slots == 2 && c == axis && slot == 1 ? middle : low[c];
      const double to = slots == 2 && c == axis && slot == 0 ? middle : high[c];
      // even numbers, so that an octahedron's middle is a whole number
      shell.low[c] = from + 2 + 2 * static_cast<double>(random() % 2);
      shell.high[c] = to - 2 - 2 * static_cast<double>(random() % 2);
      fits &= shell.high[c] - shell.low[c] >= 4;
    }
    if (!fits) continue;
    shell.octahedron = octahedra && random() % 2 == 0;
    shell.turn = random() % 2 == 0 ? 1 : -1;
    added.push_back(shells.size());
    shells.push_back(shell);
    // within an octahedron, a box with a third of its edges has room
    std::array<double, 3> inner_low = shell.low, inner_high = shell.high;
    for (std::size_t c = 0; c < 3 && shell.octahedron; ++c) {
      const double third = 2 * std::ceil((shell.high[c] - shell.low[c]) / 6);
      inner_low[c] += third;
      inner_high[c] -= third;
    }
    const std::size_t number = shells.size() - 1;
    shells[number].children = add_shells(shells, inner_low, inner_high, octahedra, random);
  }
  return added;
}

template <typename Random>
NestedShells nested_shells(bool octahedra, Random& random) {
  NestedShells made;
  add_shells(made.shells, {0, 0, 0}, {64, 64, 64}, octahedra, random);
  std::vector<std::size_t> order(made.shells.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) made.surface = with(made.surface, made.shells[i].surface());
  return made;
}

}  // namespace hiac::test
