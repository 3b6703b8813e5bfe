#!/usr/bin/env python3
"""Prints special_functions_table.hpp: the polynomials that special_functions.cpp evaluates.

Every function f of x >= 0 is written f(x) = w(x) p(t) with t = x / (x + 2) in [0, 1) and a weight
w that carries f's behaviour at 0 and at infinity. [0, 1] is cut into kIntervals equal intervals;
on each, p is the Chebyshev interpolant, rewritten in powers of the local variable y in [-1, 1].
Values come from power series (x < 9) and asymptotic series (x >= 9, where the smallest term is
below 1e-34) in decimal arithmetic: Abramowitz and Stegun 7.1.6, 7.1.23; DLMF 7.6.2, 7.12.1.

Usage: special_functions_fit.py > special_functions_table.hpp   (standard library only)
"""

from decimal import Decimal, getcontext

getcontext().prec = 160
INTERVALS = 32
DEGREE = 12
ASYMPTOTIC_FROM = 9


def pi():
    """Machin's formula."""

    def arctan_inverse(n):
        total = term = Decimal(1) / n
        k = 1
        while abs(term) > Decimal(10) ** -155:
            term = -term / (n * n)
            k += 2
            total += term / k
        return total

    return 4 * (4 * arctan_inverse(5) - arctan_inverse(239))


PI = pi()
SQRT_PI = PI.sqrt()


def power_series(x, sign):
    """sum of sign^k 2^k x^(2k+1) / (2k+1)!!: D(x) for -1, e^(x^2) erf(x) sqrt(pi)/2 for +1."""
    total = term = x
    k = 0
    while abs(term) > Decimal(10) ** -150:
        k += 1
        term = term * sign * 2 * x * x / (2 * k + 1)
        total += term
    return total


def asymptotic_series(x, sign):
    """sum for k >= 1 of sign^k (2k-1)!! / (2 x^2)^k up to the smallest term."""
    total = Decimal(0)
    term = Decimal(1)
    k = 0
    while True:
        k += 1
        following = term * sign * (2 * k - 1) / (2 * x * x)
        if abs(following) >= abs(term) or abs(following) < Decimal(10) ** -60:
            return total
        term = following
        total += term


def erfcx_pair(x):
    """erfcx(x) and 1/sqrt(pi) - x erfcx(x)."""
    if x < ASYMPTOTIC_FROM:
        value = (x * x).exp() - 2 / SQRT_PI * power_series(x, 1)
        return value, 1 / SQRT_PI - x * value
    rest = asymptotic_series(x, -1)
    return (1 + rest) / (x * SQRT_PI), -rest / SQRT_PI


def dawson_pair(x):
    """D(x) and D'(x) = 1 - 2 x D(x)."""
    if x < ASYMPTOTIC_FROM:
        value = power_series(x, -1)
        return value, 1 - 2 * x * value
    rest = asymptotic_series(x, 1)
    return (1 + rest) / (2 * x), -rest


def weighted(x):
    """p of erfcx, ierfcx, dawson, dawson_derivative at x > 0; s = 2 / (x + 2)."""
    s = 2 / (x + 2)
    e0, e1 = erfcx_pair(x)
    d0, d1 = dawson_pair(x)
    return e0 / s, e1 / s**2, d0 / (x * s**2), d1 / s**2


def cosine(x):
    """cos(x) for 0 <= x <= pi."""
    total = term = Decimal(1)
    k = 0
    while abs(term) > Decimal(10) ** -150:
        k += 2
        term = -term * x * x / (k * (k - 1))
        total += term
    return total


def chebyshev_coefficients(values, count):
    n = len(values)
    out = []
    for k in range(count):
        total = sum(v * cosine_table[(k * (2 * j + 1)) % (4 * n)] for j, v in enumerate(values))
        out.append(total * (1 if k == 0 else 2) / n)
    return out


def monomial_coefficients(chebyshev):
    result = [Decimal(0)] * len(chebyshev)
    previous, current = [Decimal(1)], [Decimal(0), Decimal(1)]
    for c in chebyshev:
        for power, t in enumerate(previous):
            result[power] += c * t
        following = [Decimal(0)] + [2 * t for t in current]
        for power, t in enumerate(previous):
            following[power] -= t
        previous, current = current, following
    return result


NODES = 28
cosine_table = [cosine(PI * min(k, 4 * NODES - k) / (2 * NODES)) for k in range(4 * NODES)]
# cos(pi (2j+1) / (2 NODES)) is cosine_table[2j+1]; multiples of the angle wrap at 4 NODES.

NAMES = ("kErfcx", "kIerfcx", "kDawson", "kDawsonDerivative")


def main():
    tables = {name: [] for name in NAMES}
    neglected = 0.0
    for interval in range(INTERVALS):
        samples = []
        for j in range(NODES):
            y = cosine_table[2 * j + 1]
            t = (interval + (y + 1) / 2) / INTERVALS
            samples.append(weighted(2 * t / (1 - t)))
        for index, name in enumerate(NAMES):
            c = chebyshev_coefficients([row[index] for row in samples], NODES - 1)
            rest = sum(abs(v) for v in c[DEGREE + 1 :])
            neglected = max(neglected, float(rest / max(abs(v) for v in c)))
            tables[name].append(monomial_coefficients(c[: DEGREE + 1]))

    print("// Written by special_functions_fit.py; the method is described there.")
    print(f"// Largest relative sum of neglected Chebyshev coefficients: {neglected:.1e}.")
    print("#pragma once\n\nnamespace hiac::special_functions_table {\n")
    print(f"inline constexpr int kIntervals = {INTERVALS};")
    print(f"inline constexpr int kDegree = {DEGREE};")
    print("\n// clang-format off")
    for name in NAMES:
        print(f"// {DEGREE + 1} coefficients an interval, one interval after another.")
        print(f"inline constexpr double {name}[kIntervals][kDegree + 1] = {{")
        numbers = [repr(float(v)) for row in tables[name] for v in row]
        for i in range(0, len(numbers), 4):
            print("    " + ", ".join(numbers[i : i + 4]) + ",")
        print("};")
    print("// clang-format on\n\n}  // namespace hiac::special_functions_table")


if __name__ == "__main__":
    main()
