// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/sampling/batch_wind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t BLOCKS = 64, LANES = 16, COUNT = 48 * BLOCKS;

/// Random places in the layout of fillWind: rows of 16 x, y and z.
std::vector<float> randomPlaces(double size) {
  const Random random(5);
  std::vector<float> out;
  for (std::size_t i = 0; i < COUNT; ++i)
    out.push_back(static_cast<float>(i / LANES % 3 == 2 ? random.uniform(i, 0.0, 6.0)
                                                        : random.uniform(i, -size, size)));
  return out;
}

class BatchWindOf : public testing::TestWithParam<int> {};

// S1-16, S2-20: single precision keeps seven digits, here of speeds up to 10 m/s and of waves and
// profiles with slopes up to 5 m/s per metre at places up to 30 m away.
TEST_P(BatchWindOf, IsTheLawToSinglePrecision) {
  const wind::Field field({wind::oneOfEach()[static_cast<std::size_t>(GetParam())]}, 3);
  std::vector<float> air(COUNT);
  std::size_t moved = 0;
  for (const double time : {5.0, 8.7, 30.1}) {
    const wind::Instant wind = field.at(wind::at(time));
    const std::vector<float> places = randomPlaces(25.0);
    fillWind(FloatWind(wind, 40.0), places.data(), air.data(), BLOCKS);
    for (std::size_t i = 0; i < COUNT; i += i % LANES == LANES - 1 ? 2 * LANES + 1 : 1) {
      const Vec3 law = wind.velocity(Vec3(places[i], places[i + LANES], places[i + 2 * LANES]));
      const Vec3 ours(air[i], air[i + LANES], air[i + 2 * LANES]);
      ASSERT_LT(length(ours - law), 2e-5) << time << " s, " << i;
      moved += length(law) > 0.01;
    }
  }
  EXPECT_GT(moved, 20u);
}

TEST_P(BatchWindOf, HasTheSameBitsOnEveryInstructionSet) {  // N6
  const wind::Field field({wind::oneOfEach()[static_cast<std::size_t>(GetParam())]}, 3);
  const FloatWind wind(field.at(wind::at(5.0)), 40.0);
  const std::vector<float> places = randomPlaces(25.0);
  std::vector<float> first, air(COUNT);
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    fillWind(wind, places.data(), air.data(), BLOCKS);
    if (first.empty()) first = air;
    EXPECT_EQ(air, first) << set;
  }
  forceInstructionSet("");
}

INSTANTIATE_TEST_SUITE_P(Kinds, BatchWindOf, testing::Range(0, 7), [](const auto& info) {
  return wind::kindNames()[static_cast<std::size_t>(info.param)];
});

// A wake that is left out moves nothing within reach.
TEST(BatchWind, LeavesOutOnlyAWakeThatIsAway) {  // N11
  const wind::Primitive wake = wind::oneOfEach()[static_cast<std::size_t>(wind::Kind::WAKE)];
  ASSERT_EQ(wake.kind, wind::Kind::WAKE);
  const wind::Instant now = wind::Field({wake}).at(wind::at(5.0));
  const Random random(8);
  int kept = 0, omitted = 0;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double reach = random.uniform(4 * i, 0.0, 10.0);
    const Vec3 origin(random.uniform(4 * i + 1, -90.0, 90.0),
                      random.uniform(4 * i + 2, -90.0, 90.0), 0.0);
    const bool present = !FloatWind(now.relativeTo(origin), reach).terms.empty();
    (present ? kept : omitted) += 1;
    if (present) continue;
    for (std::uint64_t k = 0; k < 20; ++k) {
      const double angle = random.uniform(100000 + 20 * i + k, 0.0, 6.3);
      const Vec3 place = origin + Vec3(std::cos(angle), std::sin(angle), 0.0) * reach;
      EXPECT_EQ(now.velocity(place + Vec3(0.0, 0.0, now.terms.at(0).centre.z())),
                Vec3(Vec3::Zero()));
    }
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(omitted, 100);
}

}  // namespace
}  // namespace vegetation_sim::forest
