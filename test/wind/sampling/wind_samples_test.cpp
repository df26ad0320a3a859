// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/sampling/wind_samples.h"

#include <gtest/gtest.h>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::wind {
namespace {

// N6, S2-19: the breeze on vectors of any width has the bits of the law.
TEST(WindSamples, AreTheInstantsVelocitiesToTheBit) {
  Instant wind = Field(oneOfEach(), 3).at(at(5.0));
  wind.terms.clear();
  ASSERT_FALSE(wind.modes.empty());
  constexpr std::size_t COUNT = 21, ROOM = 2 * WindSamples::ROOM;
  std::vector<double> rows(6 * ROOM, 0.0);
  double* const r = rows.data();
  for (std::size_t i = 0; i < 3 * ROOM; ++i) r[i] = Random(i).uniform(0, -50.0, 50.0);
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    sampleBreeze(wind,
                 {r, r + ROOM, r + 2 * ROOM, r + 3 * ROOM, r + 4 * ROOM, r + 5 * ROOM, COUNT});
    for (std::size_t i = 0; i < COUNT; ++i) {
      const Vec3 law = wind.velocity({r[i], r[ROOM + i], r[2 * ROOM + i]});
      ASSERT_EQ(Vec3(r[3 * ROOM + i], r[4 * ROOM + i], r[5 * ROOM + i]), law) << set << ' ' << i;
    }
  }
  forceInstructionSet("");
}

}  // namespace
}  // namespace vegetation_sim::wind
