#pragma once

#include <array>
#include <span>

namespace hiac {

/// Adds to every bin the volume of that part of a tetrahedron in which a linear field lies in the
/// bin: [edges[k], edges[k + 1]), the last bin closed.
///
/// The part of the volume in which the field is below t has as its derivative the quadratic
/// B-spline whose knots are the four corners' values, times the volume (H. B. Curry and I. J.
/// Schoenberg, "On Polya frequency functions IV", J. d'Analyse Math. 17, 1966). By de Boor's
/// recurrence it is a sum of products of two linear functions, none negative between its knots;
/// their integrals over a bin are
///
///     h / 6 (2 p_s q_s + p_s q_t + p_t q_s + 2 p_t q_t),   h = t - s,
///
/// sums of positive terms whose factors are ratios of differences of the given numbers. Nothing
/// cancels: each share is right to a few units in its last place relative to itself, however small
/// it is and however close the values are. Equal values are knots of higher multiplicity; four
/// equal values put all the volume into one bin.
///
/// `values`: finite, of any size. `edges`: ascending, at least two. `bins`: one less. Volume that
/// no bin has is added to `outside`: below, above.
void add_tetrahedron(std::array<double, 4> values, double volume, std::span<const double> edges,
                     std::span<double> bins, std::array<double, 2>& outside);

}  // namespace hiac
