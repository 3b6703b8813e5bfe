#pragma once

#include <array>

#include "formats/abaqus/inp_lines.hpp"
#include "formats/abaqus/inp_vectors.hpp"

namespace hiac::formats::abaqus {

/// A point is mapped to rotation (row by row) times it plus translation.
struct Placement {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector translation{};
  bool moved = false;
};

Vector placed(const Placement& placement, const double* point);

/// The rotation about the axis from the point in data[0..2] to that in data[3..5] by data[6]
/// degrees, after the translation (Abaqus: *INSTANCE, *NCOPY). Without an axis nothing turns.
void rotate(const std::array<double, 7>& data, Placement& placement);

/// *SYSTEM: what the data lines say of the origin and the axes, as the placement that takes local
/// coordinates to global ones; none where there are no data lines. Throws InputError.
std::optional<Placement> read_system(TextCursor& cursor);

/// SYSTEM=C: radius, angle in degrees, z; SYSTEM=S: radius, azimuth, elevation.
void to_rectangular(char kind, Vector& point);

/// 'R', 'C' or 'S': the parameter SYSTEM of *NODE and *NGEN.
char kind_of_system(const Keyword& keyword);

}  // namespace hiac::formats::abaqus
