// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/modes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "core/math/symmetric_eigen.h"
#include "scenes/dynamics/chain_scene.h"

namespace vegetation_sim::physics {
namespace {

double dotOf(const double* a, const double* b, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

// Returns all frequencies by forming the whole matrix.
std::vector<double> denseFrequencies(LinearChain& chain) {
  const std::size_t n = chain.size();
  std::vector<double> matrix(n * n), unit(n), column(n);
  for (std::size_t j = 0; j < n; ++j) {
    unit.assign(n, 0.0);
    unit[j] = 1.0 / std::sqrt(chain.stiffness()[j]);
    chain.timesMass(unit.data(), column.data());
    for (std::size_t i = 0; i < n; ++i)
      matrix[i * n + j] = column[i] / std::sqrt(chain.stiffness()[i]);
  }
  std::vector<double> out;
  for (const double value : symmetricEigen(matrix, n).values) out.push_back(1.0 / std::sqrt(value));
  return out;
}

TEST(SymmetricEigen, SolvesMatricesWithEqualValues) {
  // The matrix of a reflection and a scale has values 7, 3, 3, 3, and vectors that are determined
  // up to rotations among the equal.
  const std::vector<double> v{0.5, 0.5, -0.5, 0.5};
  std::vector<double> matrix(16);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      matrix[4 * i + j] = (i == j ? 3.0 : 0.0) + 4.0 * v[i] * v[j];
  const SymmetricEigen out = symmetricEigen(matrix, 4);
  EXPECT_NEAR(out.values[0], 7.0, 1e-14);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_NEAR(out.values[i], 3.0, 1e-14);
  EXPECT_NEAR(std::fabs(dotOf(out.vector(0), v.data(), 4)), 1.0, 1e-14);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(dotOf(out.vector(i), out.vector(j), 4), i == j ? 1.0 : 0.0, 1e-14);
}

// N13: a cantilever has every frequency of beam theory twice: (1.8751, 4.6941, 7.8548)^2 sqrt(E I /
// rho A) / l^2. 100 pieces are off by 1/100^2 of the shape's curvature, and turn about their axes,
// which the theory omits.
TEST(Modes, OfACantileverAreThoseOfBeamTheoryTwice) {
  const double length = 4.0, radius = 0.02, modulus = 8e9, density = 900.0;
  LinearChain chain(beam(100, length, radius, modulus, density));
  const Modes modes = slowestModes(chain, 6);
  ASSERT_EQ(modes.size(), 6u);
  const double unit = 0.5 * radius * std::sqrt(modulus / density) / (length * length);
  const double root[] = {1.875104, 4.694091, 7.854757};
  for (std::size_t i = 0; i < 6; ++i) {
    const double theory = root[i / 2] * root[i / 2] * unit;
    EXPECT_NEAR(modes.frequency[i], theory, 3e-3 * theory) << i;
  }
}

class ModesOf : public testing::TestWithParam<std::size_t> {};

// N13: no mode is missed, compared with those of the whole matrix.
TEST_P(ModesOf, TreesAreThoseOfTheWholeMatrix) {
  LinearChain chain(crown(GetParam(), 0.1));
  const std::vector<double> all = denseFrequencies(chain);
  for (const int count : {1, 5, 20, 1000}) {
    const Modes modes = slowestModes(chain, count);
    ASSERT_GE(modes.size(), std::min<std::size_t>(static_cast<std::size_t>(count), all.size()));
    // The error of a frequency is quadratic in the residual.
    for (std::size_t i = 0; i < modes.size(); ++i)
      EXPECT_NEAR(modes.frequency[i], all[i], 1e-7 * all[i]) << count << " " << i;
  }
}
INSTANTIATE_TEST_SUITE_P(Sizes, ModesOf, testing::Values(1, 2, 5, 31, 90));

TEST(Modes, AreOscillatorsOfUnitMassAndHoldTheTolerance) {
  LinearChain chain(fractalTree(700, 4));
  const Modes modes = slowestModes(chain, 20);
  std::vector<double> momentum(chain.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    chain.timesMass(modes.shapeOf(i), momentum.data());
    for (std::size_t j = 0; j < modes.size(); ++j)
      EXPECT_NEAR(dotOf(momentum.data(), modes.shapeOf(j), chain.size()), i == j ? 1.0 : 0.0,
                  1e-12);
    double off = 0.0, size = 0.0;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      const double spring = chain.stiffness()[k] * modes.shapeOf(i)[k];
      const double inertia = modes.frequency[i] * modes.frequency[i] * momentum[k];
      off += (spring - inertia) * (spring - inertia) / chain.stiffness()[k];
      size += spring * spring / chain.stiffness()[k];
    }
    EXPECT_LT(std::sqrt(off / size), MODE_TOLERANCE) << i;
  }
}

// N13: a count that ends inside a pair takes both.
TEST(Modes, NeverCutAPair) {
  LinearChain straight(beam(30, 4.0, 0.02, 8e9, 900.0));
  for (int count = 1; count < 12; ++count)
    EXPECT_EQ(slowestModes(straight, count).size() % 2, 0u) << count;
  LinearChain crooked(fractalTree(300, 1));
  for (int count = 1; count < 20; ++count) {
    const std::size_t size = slowestModes(crooked, count).size();
    EXPECT_LE(size, static_cast<std::size_t>(count) + 1);
    EXPECT_GE(size, static_cast<std::size_t>(count));
  }
}

TEST(Modes, OfTheSameTreeAreTheSameToTheBit) {
  LinearChain a(fractalTree(200, 2)), b(fractalTree(200, 2));
  const Modes first = slowestModes(a, 8), second = slowestModes(b, 8);
  ASSERT_EQ(first.shape.size(), second.shape.size());
  EXPECT_EQ(
      0, std::memcmp(first.shape.data(), second.shape.data(), sizeof(double) * first.shape.size()));
}

TEST(Modes, OfNothingAreNone) {
  LinearChain chain(crown(3, 0.1));
  EXPECT_EQ(slowestModes(chain, 0).size(), 0u);
  EXPECT_EQ(slowestModes(chain, -1).size(), 0u);
}

// N13: with one load vector the response to the constant load is exact, however few modes.
TEST(LoadVectors, MakeTheSteadyResponseExact) {
  LinearChain chain(fractalTree(300, 3));
  const Random random(5);
  std::vector<double> load(chain.size());
  for (std::size_t k = 0; k < load.size(); ++k) load[k] = random.uniform(k, -1.0, 1.0);
  for (const int count : {0, 1, 5}) {
    Modes modes = slowestModes(chain, count);
    const std::size_t before = modes.size();
    addLoadVectors(chain, {{load, 1}}, modes);
    ASSERT_EQ(modes.size(), before + 1);
    double off = 0.0, size = 0.0;
    std::vector<double> answer(load.size(), 0.0);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const double* phi = modes.shapeOf(i);
      const double a =
          dotOf(phi, load.data(), load.size()) / (modes.frequency[i] * modes.frequency[i]);
      for (std::size_t k = 0; k < load.size(); ++k) answer[k] += a * phi[k];
    }
    for (std::size_t k = 0; k < load.size(); ++k) {
      const double exact = load[k] / chain.stiffness()[k];
      off += (answer[k] - exact) * (answer[k] - exact);
      size += exact * exact;
    }
    EXPECT_LT(std::sqrt(off / size), 1e-9) << count;
  }
}

TEST(LoadVectors, ShareNothingWithModesNorEachOther) {
  LinearChain chain(fractalTree(300, 3));
  std::vector<double> first(chain.size(), 0.0), second(chain.size(), 1.0);
  first[400] = 1.0;
  Modes modes = slowestModes(chain, 6);
  const std::size_t before = modes.size();
  addLoadVectors(chain, {{first, 4}, {second, 4}, {first, 4}},
                 modes);  // the third brings nothing new
  ASSERT_EQ(modes.size(), before + 8);
  std::vector<double> momentum(chain.size());
  for (std::size_t i = 0; i < modes.size(); ++i) {
    chain.timesMass(modes.shapeOf(i), momentum.data());
    for (std::size_t j = 0; j < modes.size(); ++j)
      EXPECT_NEAR(dotOf(momentum.data(), modes.shapeOf(j), chain.size()), i == j ? 1.0 : 0.0, 1e-9)
          << i << " " << j;
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
