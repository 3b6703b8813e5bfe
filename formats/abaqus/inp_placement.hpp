#pragma once

#include <array>

#include "formats/abaqus/inp_lines.hpp"
#include "formats/abaqus/inp_vectors.hpp"

namespace hiac::formats::abaqus {

/// Maps a point to rotation (row by row) times the point, plus translation.
struct Placement {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector translation{};
  bool moved = false;
};

Vector placed(const Placement& placement, const double* point);

/// The translation, followed by the rotation about the axis from the point in data[0..2] to that in
/// data[3..5] by data[6] degrees (Abaqus: *INSTANCE, *NCOPY). Without an axis there is no rotation.
void rotate(const std::array<double, 7>& data, Placement& placement);

/// *SYSTEM: the data lines give the origin and the axes; the result takes local coordinates to
/// global ones; none when there are no data lines. Throws InputError.
std::optional<Placement> read_system(TextCursor& cursor);

/// SYSTEM=C: radius, angle in degrees, z; SYSTEM=S: radius, azimuth, elevation.
void to_rectangular(char kind, Vector& point);

/// 'R', 'C' or 'S': the parameter SYSTEM of *NODE and *NGEN.
char kind_of_system(const Keyword& keyword);

}  // namespace hiac::formats::abaqus
