#include "hiac/mesh/fields/tensor_invariants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hiac/mesh/zoo_mesh.hpp"

namespace hiac {
namespace {

using Integers = std::array<std::array<std::int64_t, 3>, 3>;

// A rotation by an integer quaternion, times the quaternion's squared length.
Integers rotation(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return {{{a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)},
           {2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)},
           {2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d}}};
}

struct KnownTensor {
  SymmetricTensor tensor;        // exact
  std::array<double, 3> values;  // its eigenvalues, exact, largest first
};

// Tensors of whole numbers, turned in every direction, some with equal eigenvalues.
std::vector<KnownTensor> known_tensors() {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<std::int64_t> part(-9, 9), value(-50, 50);
  std::vector<KnownTensor> all;
  while (all.size() < 2000) {
    const std::array<std::int64_t, 4> q{part(random), part(random), part(random), part(random)};
    const std::int64_t n = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    if (n == 0) continue;
    const Integers r = rotation(q[0], q[1], q[2], q[3]);
    std::array<std::int64_t, 3> l{value(random), value(random), value(random)};
    if (all.size() % 4 == 1) l[1] = l[0];
    if (all.size() % 40 == 3) l[2] = l[1] = l[0];
    const auto entry = [&](std::size_t i, std::size_t j) {
      std::int64_t sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += r[i][k] * l[k] * r[j][k];
      return static_cast<double>(sum);
    };
    KnownTensor known{
        {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)}, {}};
    for (std::size_t k = 0; k < 3; ++k) known.values[k] = static_cast<double>(n * n * l[k]);
    std::ranges::sort(known.values, std::greater<>());
    all.push_back(known);
  }
  return all;
}

double largest(const KnownTensor& known) {
  return std::max(std::abs(known.values[0]), std::abs(known.values[2]));
}

TEST(TensorInvariants, AreThoseOfTheEigenvalues) {
  constexpr double kRelative = 1e-14;
  for (const KnownTensor& known : known_tensors()) {
    const auto& [one, two, three] = known.values;
    const double off = kRelative * largest(known);
    const auto values = principal_values(known.tensor);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(values[k], known.values[k], off);
    EXPECT_NEAR(tresca(known.tensor), one - three, 2 * off);
    EXPECT_EQ(trace(known.tensor), one + two + three);
    const double squares =
        (one - two) * (one - two) + (two - three) * (two - three) + (three - one) * (three - one);
    EXPECT_NEAR(von_mises(known.tensor), std::sqrt(0.5 * squares), off);
    const SymmetricTensor rest = deviator(known.tensor);
    EXPECT_NEAR(trace(rest), 0, off);
    const auto turned = principal_values(rest);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(turned[k], known.values[k] - (one + two + three) / 3, 2 * off);
  }
}

TEST(TensorInvariants, HaveClosedForms) {
  EXPECT_DOUBLE_EQ(von_mises({5, 0, 0, 0, 0, 0}), 5);                 // tension
  EXPECT_DOUBLE_EQ(von_mises({0, 0, 0, 0, 0, 2}), 2 * std::sqrt(3));  // shear
  EXPECT_DOUBLE_EQ(tresca({0, 0, 0, 0, 2, 0}), 4);
  const auto values = principal_values({0, 0, 0, 3, 0, 0});
  EXPECT_NEAR(values[0], 3, 1e-15);
  EXPECT_NEAR(values[1], 0, 1e-15);
  EXPECT_NEAR(values[2], -3, 1e-15);
  EXPECT_EQ(von_mises({7, 7, 7, 0, 0, 0}), 0);  // pressure
  EXPECT_EQ(deviator({7, 7, 7, 1, 2, 3}), (SymmetricTensor{0, 0, 0, 1, 2, 3}));
}

// A mean stress that is 1e12 times the rest leaves the rest its digits.
TEST(TensorInvariants, KeepTheirDigitsUnderPressure) {
  const double p = 0x1p40;
  EXPECT_DOUBLE_EQ(von_mises({p + 3, p, p, 0, 0, 0}), 3);
  EXPECT_EQ(deviator({p + 3, p, p, 0, 0, 0}), (SymmetricTensor{2, -1, -1, 0, 0, 0}));
}

TEST(TensorInvariants, NeitherOverflowNorVanish) {
  for (const double scale : {1e-300, 1e-200, 1e200, 1e300}) {
    const SymmetricTensor t{3 * scale, -scale, 0.5 * scale, scale, 2 * scale, -scale};
    const SymmetricTensor unit{3, -1, 0.5, 1, 2, -1};
    EXPECT_NEAR(von_mises(t) / scale, von_mises(unit), 1e-13);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(principal_values(t)[k] / scale, principal_values(unit)[k], 1e-13);
  }
}

TEST(TensorInvariants, OfWhatIsNotFiniteAreNotNumbers) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double odd : {kNan, kInfinity}) {
    EXPECT_TRUE(std::isnan(principal_values({1, 2, 3, odd, 0, 0})[1]));
    EXPECT_FALSE(std::isfinite(von_mises({1, 2, 3, odd, 0, 0})));
  }
}

// Nine components, of which each is told apart; the tensor is their symmetric part.
TEST(TensorInvariants, OfNineComponentsAreThoseOfTheSymmetricPart) {
  const std::array<double, 9> rows{1, 2, 4, 6, 16, 32, 8, 96, 256};
  EXPECT_EQ(symmetric_tensor(rows), (SymmetricTensor{1, 16, 256, 4, 64, 6}));
  const std::array<double, 6> six{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(symmetric_tensor(six), (SymmetricTensor{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(symmetric_tensor(std::span(rows).first(4)), std::nullopt);
}

TEST(TensorInvariants, AreScalarFieldsByName) {
  ZooMesh mesh;
  mesh.fields.push_back(
      {"s", "Pa", FieldLocation::cell, 6, SharedArray<double>({4., 1., 1., 0., 0., 0.})});
  mesh.fields.push_back({"F", "", FieldLocation::cell, 9,
                         SharedArray<double>({1., 2., 4., 6., 16., 32., 8., 96., 256.})});
  const auto value = [&](const char* name) { return scalar_field(mesh, name).values[0]; };
  EXPECT_DOUBLE_EQ(value("s:von_mises"), 3);
  EXPECT_DOUBLE_EQ(value("s:tresca"), 3);
  EXPECT_DOUBLE_EQ(value("s:trace"), 6);
  EXPECT_DOUBLE_EQ(value("s:principal_1"), 4);
  EXPECT_DOUBLE_EQ(value("s:principal_2"), 1);
  EXPECT_DOUBLE_EQ(value("s:principal_3"), 1);
  EXPECT_EQ(scalar_field(mesh, "s:von_mises").unit, "Pa");
  EXPECT_EQ(value("F:xz"), 4);
  EXPECT_EQ(value("F:zy"), 96);
  EXPECT_EQ(value("F:trace"), 273);
}

}  // namespace
}  // namespace hiac
