#pragma once

#include <array>
#include <optional>
#include <span>

namespace hiac {

/// A symmetric tensor: xx, yy, zz, xy, yz, xz, the order in which fields of six components store
/// them. Shears are the tensor's own entries; engineering shear strains are twice these.
using SymmetricTensor = std::array<double, 6>;

/// Returns the symmetric tensor of a tuple: six components as they are, or the symmetric part of
/// nine (xx, xy, xz, yx, ... zz); none for other counts.
std::optional<SymmetricTensor> symmetric_tensor(std::span<const double> tuple);

/// Returns the principal values (eigenvalues), largest first; NaN if a component is not finite.
/// Their errors are a few units of rounding of the largest component (Eigen's QL iteration).
std::array<double, 3> principal_values(const SymmetricTensor& t);

/// Returns the equivalent stress of von Mises, the square root of 3/2 times the deviator's squared
/// Frobenius norm. No square overflows or vanishes if the result does not.
double von_mises(const SymmetricTensor& t);

/// Returns the equivalent stress of Tresca: the largest principal value minus the smallest, which
/// is twice the largest shear.
double tresca(const SymmetricTensor& t);

/// Returns xx + yy + zz.
double trace(const SymmetricTensor& t);

/// Returns the tensor without its mean: t - trace(t) / 3 times the identity.
SymmetricTensor deviator(const SymmetricTensor& t);

}  // namespace hiac
