// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/modes/harmonic_chain.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_fixture.h"

namespace vegetation_sim::physics {
namespace {

/// The equation of an oscillating chain: the loads of its terms.
struct Equation {
  LinearChain chain;
  std::vector<Grip> grips;

  // Returns (K - w^2 M) x - w (C + air) y, where y is the other one of cosine and sine.
  std::vector<double> load(const std::vector<double>& x, const std::vector<double>& y, double w) {
    std::vector<double> mass(x.size()), out(x.size());
    chain.timesMass(x.data(), mass.data());
    const std::vector<double> air = heldBack(y);
    for (std::size_t i = 0; i < x.size(); ++i)
      out[i] =
          chain.stiffness()[i] * x[i] - w * w * mass[i] + w * (chain.damping()[i] * y[i] + air[i]);
    return out;
  }
  std::vector<double> heldBack(const std::vector<double>& x) const {
    std::vector<SmallMotion> motion;
    chain.motionOf(x.data(), motion);
    std::vector<Wrench> wrenches;
    for (std::size_t i = 0; i < motion.size(); ++i) {
      const Vec3 arm = rotate(chain.rest()[i].orientation, grips[i].centre);
      const Vec3 force = grips[i].steady * (motion[i].move + cross(motion[i].turn, arm));
      wrenches.push_back({force, cross(arm, force)});
    }
    return chain.torquesOf(wrenches);
  }
};

// N7: the solution satisfies the equation of motion: its terms sum to the given load.
TEST(HarmonicChain, SolvesItsEquation) {
  const std::vector<Link> links = crown(60, 0.1);
  const Random random(5);
  Equation equation{LinearChain(links), {}};
  std::vector<double> cosine, sine;
  for (std::uint64_t i = 0; i < links.size(); ++i) {
    const Vec3 centre(random.uniform(8 * i, -0.1, 0.1), random.uniform(8 * i + 1, -0.1, 0.1),
                      links[i].length);
    equation.grips.push_back({centre, random.uniform(8 * i + 2, 0.0, 0.5), 0.0});
    for (std::uint64_t k = 3; k < 5; ++k) {
      cosine.push_back(random.uniform(8 * i + k, -1.0, 1.0));
      sine.push_back(random.uniform(8 * i + k + 2, -1.0, 1.0));
    }
  }
  HarmonicChain chain(links, equation.grips);
  for (const double w : {0.0, 1.0, 8.0, 30.0}) {
    std::vector<double> x = cosine, y = sine;
    chain.setFrequency(w);
    chain.solve(x, y);
    // d/dt of x cos + y sin is w (y cos - x sin).
    const std::vector<double> even = equation.load(x, y, w), odd = equation.load(y, x, -w);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(even[i], cosine[i], 1e-9) << w;
      EXPECT_NEAR(odd[i], sine[i], 1e-9) << w;
    }
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
