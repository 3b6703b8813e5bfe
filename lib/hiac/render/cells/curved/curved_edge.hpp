#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hiac/frame/tiles/curved_outline.hpp"
#include "hiac/frame/tiles/tile.hpp"

namespace hiac {

/// A curved edge on the screen, and where it crosses a row of pixel centres: a polynomial curve in
/// homogeneous coordinates, equally valid beside and behind the eye. The row crosses it where it
/// changes sides, and the number of changes agrees with the sides of its two corners.
class CurvedEdge {
 public:
  CurvedEdge() = default;
  CurvedEdge(std::size_t degree, const EdgeControls& controls)
      : degree_(degree), x_(controls[0]), y_(controls[1]), w_(controls[2]) {}

  /// A point where the edge changes sides of a row. It lies left of the pixels from `column` on, or
  /// of those before `column`.
  struct Cut {
    int column;
    bool from_column_on;
    int sign;  ///< +1: the edge comes up, followed from its corner of lower number
  };

  /// Finds the cuts of a row of pixel centres; `begins_above`, `ends_above`: whether the corners
  /// lie on the row or above it.
  void begin_row(double center, const TileRect& tile, bool begins_above, bool ends_above);
  /// Those of the row.
  [[nodiscard]] std::span<const Cut> cuts() const { return {cuts_.data(), cut_count_}; }
  /// The sum of the signs of the cuts that lie left of pixel x.
  [[nodiscard]] int crossed_left_of(int x) const {
    int sum = 0;
    for (const Cut& cut : cuts())
      if ((x >= cut.column) == cut.from_column_on) sum += cut.sign;
    return sum;
  }

 private:
  void add_cut(const TileRect& tile, double s, bool comes_up);
  [[nodiscard]] double slack_at(double s, double x) const;

  std::size_t degree_ = 0;
  std::array<double, 4> x_, y_, w_;
  // of the current row
  double row_ = 0;                // y of the pixel centres
  std::array<double, 4> height_;  // of the control points above the row
  std::array<Cut, 3> cuts_;
  std::size_t cut_count_ = 0;
};

}  // namespace hiac
