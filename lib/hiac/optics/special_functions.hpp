#pragma once

namespace hiac {

// Functions of the Gaussian integrals, for finite x >= 0. Piecewise polynomials of x / (x + 2),
// derived in special_functions_fit.py. Relative error at most 2e-15 unless stated otherwise
// (asserted in tests/optics/special_functions_test.cpp).

/// The scaled complementary error function exp(x^2) erfc(x).
double erfcx(double x);

/// The integral of erfc from x to infinity, scaled: exp(x^2) int_x^inf erfc(t) dt
/// = 1/sqrt(pi) - x erfcx(x), without the cancellation of that difference.
double ierfcx(double x);

/// Dawson's function D(x) = exp(-x^2) int_0^x exp(t^2) dt.
double dawson(double x);

/// D'(x) = 1 - 2 x D(x), without the cancellation of that difference. It has a zero at
/// x = 0.92413887...: the error is at most 1e-15 (absolute) for x < 1.25 and relative beyond.
double dawson_derivative(double x);

}  // namespace hiac
