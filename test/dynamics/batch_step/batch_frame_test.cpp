// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Steps of a frame after its first: velocity products at predicted rates.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/dynamics/framed_chain.h"

namespace vegetation_sim::physics {
namespace {

std::vector<Vec3> tipsAt(const std::vector<Link>& links, const ChainState& state) {
  Simulation at{links};
  at.state = state;
  return at.tips();
}

// All joints turn fast, so that velocity products bend the tree as much as its springs do.
ChainState turning(std::size_t links) {
  return randomState(links, 0.1, 4.0, 5);
}

double errorAfter(const std::vector<Link>& links, const std::vector<Vec3>& exact, double seconds,
                  int steps, Products products = Products::MEAN) {
  FramedChain chain(links);
  chain.setProducts(products);
  chain.setState(0, turning(links.size()));
  for (int i = 0; i < steps; ++i) chain.step(seconds / steps);
  return rms(tipsAt(links, chain.state(0)), exact);
}

// Measured: 2.2e-4 and 5.3e-5 m; with products before the step, which are of first order, 4.6e-4.
TEST(BatchFrame, PredictedProductsAreSecondOrder) {
  const std::vector<Link> links = crown(31, 0.02);
  const double seconds = 0.4;
  Simulation exact{links, Integrator::RUNGE_KUTTA_4};
  exact.state = turning(links.size());
  for (int i = 0; i < 8192; ++i) exact.step({}, 0.0, seconds / 8192);
  const double coarse = errorAfter(links, exact.tips(), seconds, 400),
               fine = errorAfter(links, exact.tips(), seconds, 800),
               before = errorAfter(links, exact.tips(), seconds, 800, Products::START);
  EXPECT_GT(fine, 1e-6);  // far above the rounding of floats
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
  EXPECT_LT(fine, 0.25 * before);
}

// Error of the tips in two seconds over their distance from rest.
class Errors {
 public:
  Errors(const std::vector<Link>& links, const Surroundings& around)
      : links_(links), around_(around) {
    Simulation plain{links};
    const std::vector<Vec3> rest = plain.tips();
    for (int i = 1; i <= 2 * 3840; ++i) {
      plain.step(around, (i - 1) / 3840.0, 1.0 / 3840.0);
      if (i % 128) continue;
      exact_.push_back(plain.tips());
      way_ += std::pow(rms(exact_.back(), rest), 2);
    }
  }
  template <class Chain>
  double of(Products products = Products::MEAN) const {
    Chain chain(links_);
    chain.setProducts(products);
    double sum = 0.0;
    for (int i = 1; i <= 480; ++i) {
      chain.step(std::vector<Surroundings>{around_}, (i - 1) * STEP, STEP);
      if (i % 8) continue;
      const std::vector<Vec3>& exact = exact_[static_cast<std::size_t>(i / 8 - 1)];
      sum += std::pow(rms(tipsAt(links_, chain.state(0)), exact), 2);
    }
    return std::sqrt(sum / way_);
  }

 private:
  const std::vector<Link>& links_;
  const Surroundings& around_;
  std::vector<std::vector<Vec3>> exact_;
  double way_{0.0};
};

// At the tick. Measured in the gust 1.14e-5 for 1.14e-5 (1 000 links: 8.3e-6 for 8.0e-6), where
// products before the step give 7.8e-5 (2.0e-4). A pull of 20 N rings in twigs that oscillate many
// times a frame: 6.3e-4 for 2.8e-4 (1.28e-4 for 1.15e-4).
TEST(BatchFrame, IsAsExactAsAveragingInEachStepInAGust) {
  const std::vector<Link> links = fractalTree(300, 3);
  const Surroundings gust = gustAndPull(links, 18.0, 0.0), pull = gustAndPull(links, 0.0, 20.0);
  const Errors blown(links, gust);
  const double averaged = blown.of<BatchChain>();
  EXPECT_GT(blown.of<FramedChain>(Products::START), 3.0 * averaged);
  EXPECT_LT(blown.of<FramedChain>(), 1.2 * averaged);
  EXPECT_LT(Errors(links, pull).of<FramedChain>(), 1e-3);
}

// Returns the largest energy in twenty seconds of a tree without dampers, over that at the start.
double mostEnergy(double bend, Products products) {
  const std::vector<Link> links = crown(127, 0.0);
  const auto energyIn = [&](const ChainState& state) {
    return energyOf(links, state, kinematicsAt(links, state));
  };
  ChainState state = atRest(links.size());
  for (Vec2& q : state.q) q = Vec2(bend, -0.5 * bend);
  FramedChain chain(links);
  chain.setProducts(products);
  chain.setState(0, state);
  double most = 0.0;
  for (int i = 0; i < 4800; ++i) {
    chain.step(STEP);
    most = std::max(most, energyIn(chain.state(0)));
  }
  return most / energyIn(state);
}

// Measured 1.14 and 1.06; averaged in each step 1.05 and 1.06.
TEST(BatchFrame, GainsLittleEnergyEvenWithoutDampers) {
  EXPECT_LT(mostEnergy(0.02, Products::MEAN), 1.2);
  EXPECT_GT(mostEnergy(0.02, Products::START), 1.5);
  EXPECT_LT(mostEnergy(0.3, Products::MEAN), 1.1);
  EXPECT_GT(mostEnergy(0.3, Products::START), 2.0);
}

// The motion is so slow that the guard stays inactive.
ChainState gentle(std::size_t links) {
  return randomState(links, 0.002, 0.1, 5);
}

// A frame starts afresh: the prediction of the frame before does not matter.
TEST(BatchFrame, KeepsNothingFromOneToTheNext) {
  const std::vector<Link> links = fractalTree(100, 3);
  BatchChain along(links);
  along.setState(0, gentle(links.size()));
  along.step(STEP, 4);
  ASSERT_EQ(along.theta(0), 0.5);
  BatchChain anew(links);
  anew.setState(0, along.state(0), along.theta(0));
  along.step(STEP, 4);
  anew.step(STEP, 4);
  EXPECT_TRUE(sameBits(along.state(0), anew.state(0)));
}

// Averaging in each step, which costs half as much again, would give other bits.
TEST(BatchFrame, OnlyTheFirstStepAverages) {
  const std::vector<Link> links = fractalTree(100, 3);
  const auto after = [&](bool frame, int steps) {
    BatchChain chain(links);
    chain.setState(0, gentle(links.size()));
    if (frame) chain.step(STEP, steps);
    for (int i = 0; !frame && i < steps; ++i) chain.step(STEP);
    return chain.state(0);
  };
  EXPECT_TRUE(sameBits(after(true, 1), after(false, 1)));
  EXPECT_FALSE(sameBits(after(true, 2), after(false, 2)));
}

}  // namespace
}  // namespace vegetation_sim::physics
