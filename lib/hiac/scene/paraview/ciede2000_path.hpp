#pragma once

#include <array>
#include <vector>

namespace hiac::paraview {

/// A colour on the shortest path between two colours, and where: 0 at the first, 1 at the last.
struct PathColor {
  double position;
  std::array<double, 3> rgb;
};

/// Returns the difference of two CIELAB colours by CIEDE2000 (G. Sharma, W. Wu, E. Dalal, "The
/// CIEDE2000 Color-Difference Formula", Color Research and Application 30 (1), 2005).
double ciede2000(const std::array<double, 3>& lab1, const std::array<double, 3>& lab2);

/// Returns the shortest path between two display colours by CIEDE2000, as ParaView's colour space
/// "Lab/CIEDE2000" takes it: over the grid of 17 x 17 x 17 colours of the RGB cube, from each of
/// them to its up to 26 neighbours, from the colour nearest to `from` to that nearest to `to`.
/// Positions are lengths along the path. At least one colour; colours in between are interpolated
/// in CIELAB.
///
/// Based on: M. Zeyen, T. Post, H. Hagen, J. Ahrens, D. Rogers, R. Bujack, "Color Interpolation for
/// Non-Euclidean Color Spaces", IEEE VIS 2018, short papers.
std::vector<PathColor> ciede2000_path(const std::array<double, 3>& from,
                                      const std::array<double, 3>& to);

}  // namespace hiac::paraview
