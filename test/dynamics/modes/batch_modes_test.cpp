// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/batch_modes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "scenes/dynamics/chain_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::physics {
namespace {

struct Rig {
  explicit Rig(int links) : chain(fractalTree(links, 6)), modes(slowestModes(chain, 10)) {
    const Random random(2);
    for (std::size_t m = 0; m < modes.size(); ++m)
      amplitude.push_back(random.uniform(m, -0.3, 0.3));
  }
  LinearChain chain;
  Modes modes;
  std::vector<double> amplitude;
};

// N13: floats keep 6e-8 of each of a dozen products.
TEST(BatchModes, AgreeWithThePlainSum) {
  for (const int links : {1, 7, 16, 333}) {
    const Rig rig(links);
    BatchBends bends;
    BatchModes(rig.modes).bends(rig.amplitude, bends);
    for (std::size_t i = 0; i < rig.modes.length / 2; ++i) {
      double first = 0.0, second = 0.0, size = 0.0;
      for (std::size_t m = 0; m < rig.modes.size(); ++m) {
        const double *shape = rig.modes.shapeOf(m) + 2 * i, a = rig.amplitude[m];
        first += a * shape[0];
        second += a * shape[1];
        size += std::fabs(a) * (std::fabs(shape[0]) + std::fabs(shape[1]));
      }
      EXPECT_NEAR(bends.first[i], first, 1e-6 * size);
      EXPECT_NEAR(bends.second[i], second, 1e-6 * size);
    }
  }
}

// N13: amplitudes are state; the bends that follow from them are the same everywhere.
TEST(BatchModes, GiveTheSameBitsOnEveryInstructionSet) {
  const Rig rig(333);
  const BatchModes modes(rig.modes);
  BatchBends first;
  modes.bends(rig.amplitude, first);
  ASSERT_GE(instructionSets().size(), 2u);
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    BatchBends other;
    modes.bends(rig.amplitude, other);
    forceInstructionSet("");
    EXPECT_EQ(0, std::memcmp(first.first.data(), other.first.data(), 333 * sizeof(float))) << set;
    EXPECT_EQ(0, std::memcmp(first.second.data(), other.second.data(), 333 * sizeof(float))) << set;
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
