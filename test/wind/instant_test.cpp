// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/instant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::wind {
namespace {

/// Returns a random source of a random kind and size.
Primitive randomSource(const Random& random, std::uint32_t id) {
  const auto draw = [&](std::uint64_t i, double low, double high) {
    return random.uniform(100 * id + i, low, high);
  };
  Primitive p = example(static_cast<Kind>(static_cast<int>(draw(0, 0.0, 6.0))));
  p.id = id;
  p.name = "source_" + std::to_string(id);
  p.velocity = Vec3(draw(1, -9.0, 9.0), draw(2, -9.0, 9.0), draw(3, -2.0, 2.0));
  p.radius = draw(4, 1.0, 30.0);
  p.omega = draw(5, 0.0, 9.0);
  p.envelope = draw(6, 0.0, 2.0) < 1.0 ? Envelope::SMOOTH : Envelope::PAPER;
  p.turbulence = 0.0;
  p.front_speed = draw(8, 0.0, 15.0);
  p.rise_length = draw(9, 0.1, 10.0);
  p.plateau_length = draw(10, 0.0, 10.0);
  p.decay_length = draw(11, 0.1, 30.0);
  p.repeat = draw(12, 0.0, 1.0) < 0.5 ? 0.0 : draw(13, 1.0, 20.0);
  p.speed = draw(14, -15.0, 15.0);
  p.core_radius = draw(15, 0.1, 20.0);
  p.inflow = draw(16, -2.0, 2.0);
  p.updraft = draw(17, -2.0, 2.0);
  p.fade_in = draw(18, 0.0, 5.0);
  p.trajectory = {{at(0.0), Vec3(draw(19, -20.0, 20.0), draw(20, -20.0, 20.0), 3.0)},
                  {at(9.0), Vec3(draw(21, -20.0, 20.0), draw(22, -20.0, 20.0), 5.0)}};
  return p;
}

std::uint64_t cases(std::uint64_t by_default) {
  const char* text = std::getenv("WIND_FUZZ_CASES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : by_default;
}

TEST(SpeedBound, HoldsForRandomFields) {  // S1-22, S1-40
  for (std::uint64_t c = 0; c < cases(1000); ++c) {
    const Random random = Random(7).child(c);
    const Field field({randomSource(random, 1), randomSource(random, 2), randomSource(random, 3)},
                      c);
    const Instant instant = field.at(at(random.uniform(0, 0.0, 20.0)));
    const Vec3 middle(random.uniform(1, -30.0, 30.0), random.uniform(2, -30.0, 30.0), 2.0);
    const double reach = random.uniform(3, 0.0, 8.0);
    const double bound = instant.speedBound(middle, reach);
    for (std::uint64_t i = 0; i < 60; ++i) {
      const SinCos turn = sinCosTurns(random.uniform(1000 + 3 * i));
      const Vec3 offset = Vec3(turn.cos, turn.sin, 0.0) * reach * random.uniform(1001 + 3 * i) +
                          Vec3(0.0, 0.0, random.uniform(1002 + 3 * i, -2.0, 9.0));
      EXPECT_LE(length(instant.velocity(middle + offset)), bound * (1.0 + 1e-12)) << "case " << c;
    }
  }
}

TEST(SpeedBound, OfABreezeIsThreeStandardDeviationsAndRarelyPassed) {  // S1-40
  Primitive breeze = example(Kind::BREEZE);
  breeze.turbulence = 0.3;
  int passed = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Field field({breeze}, seed);
    for (double t = 0.0; t < 600.0; t += 1.0, ++all) {
      const Instant instant = field.at(at(t));
      const double sigma = 1.5 * std::sqrt(1.0 + 0.64 + 0.25);
      EXPECT_NEAR(instant.speedBound(Vec3::Zero(), 3.0), 5.0 + 3.0 * sigma, 1e-9);
      if (length(instant.velocity(Vec3::Zero())) > 5.0 + 3.0 * sigma) ++passed;
    }
  }
  EXPECT_LT(passed, all / 1000);
}

TEST(SpeedBound, IsNothingFarAway) {  // S1-22, S1-40
  std::vector<Primitive> sources = oneOfEach();
  sources.erase(sources.begin() + static_cast<int>(Kind::BREEZE));
  const Instant instant = Field(sources).at(at(7.0));
  ASSERT_EQ(instant.terms.size(), 6u);
  EXPECT_EQ(instant.speedBound(Vec3(300.0, 0.0, 0.0), 5.0), 0.0);
  EXPECT_GT(instant.speedBound(instant.terms[0].centre, 5.0), 0.0);
}

TEST(SpeedBound, DoesNotFollowTheSineOfADisk) {  // S1-40
  const Field field({printedDisk()});
  EXPECT_EQ(field.velocity(Vec3(0.0, 0.0, 0.0), 0), Vec3(Vec3::Zero()));
  EXPECT_EQ(field.at(0).speedBound(Vec3::Zero(), 1.0), 5.0);
  EXPECT_EQ(field.at(0).speedBound(Vec3(6.0, 0.0, 0.0), 1.0), 2.5);  // at d = 5
}

TEST(SpeedBound, SeesAGustOneSecondAhead) {  // S1-40
  Primitive gust = example(Kind::GUST);      // front at 6 m/s, full 5 m behind it
  const Instant instant = Field({gust}).at(at(10.0));
  EXPECT_EQ(instant.speedBound(Vec3(60.0, 0.0, 0.0), 0.0), 5.0);
  EXPECT_GT(instant.speedBound(Vec3(65.0, 0.0, 0.0), 0.0), 0.0);
  EXPECT_EQ(instant.speedBound(Vec3(66.5, 0.0, 0.0), 0.0), 0.0);
  EXPECT_EQ(instant.speedBound(Vec3(55.0, 12.0, 0.0), 1.0), 0.0);
}

TEST(SpeedBound, AddsTheSourcesThatReach) {  // S1-40
  Primitive near = printedDisk(), far = printedDisk(), breeze = example(Kind::BREEZE, "breeze");
  far.id = 2;
  far.name = "far";
  far.trajectory = {{0, Vec3(50.0, 0.0, 0.0)}};
  breeze.id = 3;
  breeze.turbulence = 0.0;
  const Instant instant = Field({near, far, breeze}).at(at(0.3));
  EXPECT_EQ(instant.speedBound(Vec3(0.0, 0.0, 0.0), 0.0), 10.0);
  EXPECT_EQ(instant.speedBound(Vec3(25.0, 0.0, 0.0), 1.0), 5.0);
  EXPECT_EQ(instant.speedBound(Vec3(25.0, 0.0, 0.0), 20.0), 10.0);  // 5 m into both: a half each
}

TEST(Instant, LeavesOutWhatHasFadedAway) {  // S1-40
  Primitive disk = printedDisk();
  disk.t_on = at(1.0);
  disk.t_off = at(2.0);
  const Field field({disk});
  EXPECT_TRUE(field.at(at(0.9)).terms.empty());
  EXPECT_EQ(field.at(at(1.5)).terms.size(), 1u);
  EXPECT_TRUE(field.at(at(2.0)).terms.empty());
}

TEST(Instant, CountedFromAnotherOriginIsTheSameField) {
  const Instant instant = Field(oneOfEach(), 5).at(at(12.0));
  const Vec3 origin(1234.5, -678.9, 12.0);
  const Instant moved = instant.relativeTo(origin);
  const Random random(3);
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Vec3 position(random.uniform(3 * i, -20.0, 20.0), random.uniform(3 * i + 1, -20.0, 20.0),
                        random.uniform(3 * i + 2, 0.0, 9.0));
    // 1e3 m lose three digits of 1e-16, times a few m/s per metre
    EXPECT_LT(length(instant.velocity(position) - moved.velocity(position - origin)), 1e-10);
  }
  for (const Mode& mode : moved.modes) {
    EXPECT_GE(mode.phase, 0.0);
    EXPECT_LE(mode.phase, 1.0);
  }
}

}  // namespace
}  // namespace vegetation_sim::wind
