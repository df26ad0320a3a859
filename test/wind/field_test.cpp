// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/field.h"

#include <gtest/gtest.h>

#include <functional>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/random.h"
#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

Vec3 randomPosition(const Random& random, std::uint64_t i, double size) {
  return {random.uniform(3 * i, -size, size), random.uniform(3 * i + 1, -size, size),
          random.uniform(3 * i + 2, 0.0, 10.0)};
}

// The sine is as exact before its epoch as after it: an odd function to the bit.
TEST(Field, SineIsExactOnBothSidesOfItsEpoch) {  // S1-15
  Primitive p = example(Kind::DISK);
  p.epoch = at(100.0);
  for (const double omega : {0.01, 1.0, 2.5}) {
    p.omega = omega;
    const Field field({p});
    for (Nanoseconds dt = 1; dt < 2 * NANOSECONDS_PER_SECOND; dt = dt * 3 + 1) {
      const Vec3 after = field.velocity(Vec3::Zero(), p.epoch + dt);
      EXPECT_EQ(field.velocity(Vec3::Zero(), p.epoch - dt), -after) << omega << " " << dt;
      EXPECT_NE(after, Vec3(Vec3::Zero())) << omega << " " << dt;
    }
  }
}

TEST(Field, WithoutSourcesIsStill) {
  EXPECT_EQ(Field().velocity(Vec3(1.0, 2.0, 3.0), at(4.0)), Vec3(Vec3::Zero()));
}

TEST(Field, SumsItsSourcesExactly) {  // S1-44
  const std::vector<Primitive> all = oneOfEach();
  const Field together(all, 5);
  const Random random(1);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Vec3 position = randomPosition(random, i, 20.0);
    const Nanoseconds stamp = at(random.uniform(100000 + i, 0.0, 45.0));
    Vec3 sum = Vec3::Zero();
    for (const Primitive& p : all) sum += Field({p}, 5).velocity(position, stamp);
    EXPECT_LT(length(together.velocity(position, stamp) - sum), 1e-12);  // order of the sum only
  }
}

TEST(Field, IsTheSameAtUnixTimes) {  // N2
  const Nanoseconds shift = 1767225600LL * NANOSECONDS_PER_SECOND + 987654321;
  std::vector<Primitive> moved;
  for (const Primitive& p : oneOfEach()) moved.push_back(later(p, shift));
  const Field early(oneOfEach(), 5), late(moved, 5);
  const Random random(2);
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const Vec3 position = randomPosition(random, i, 20.0);
    const Nanoseconds stamp = at(random.uniform(100000 + i, 0.0, 45.0));
    EXPECT_LE(length(early.velocity(position, stamp) - late.velocity(position, stamp + shift)),
              1e-12);
  }
}

TEST(Field, CopiesAndRebuiltFieldsAgreeToTheBit) {  // N2
  const Field field(oneOfEach(), 5);
  const Field copy = field, rebuilt(field.primitives(), field.seed());
  EXPECT_EQ(field.hash(), rebuilt.hash());
  for (double t = 0.0; t < 45.0; t += 0.37) {
    const Vec3 air = field.velocity(Vec3(2.0, 1.0, 3.0), at(t));
    EXPECT_EQ(air, copy.velocity(Vec3(2.0, 1.0, 3.0), at(t)));
    EXPECT_EQ(air, rebuilt.velocity(Vec3(2.0, 1.0, 3.0), at(t)));
  }
}

TEST(Field, StaysFiniteFarAwayAndLongAfter) {
  const Field field(oneOfEach(), 5);
  for (const double x : {0.0, 1e3, 1e7, 1e12, 1e200})
    for (const Nanoseconds stamp : {Nanoseconds{0}, at(20.0), LAST_STAMP})
      EXPECT_TRUE(field.velocity(Vec3(x, -x, x), stamp).allFinite()) << x << " m, " << stamp;
}

TEST(Field, HashChangesWithEveryPartOfIt) {  // N2
  const auto hashWith = [](const std::function<void(Primitive&)>& change) {
    Primitive p = oneOfEach()[0];
    change(p);
    return Field({p}, 5).hash();
  };
  const std::uint64_t before = hashWith([](Primitive&) {});
  const std::vector<std::function<void(Primitive&)>> changes = {
      [](Primitive& p) { p.id = 9; },
      [](Primitive& p) { p.name += "x"; },
      [](Primitive& p) { p.kind = Kind::BLAST; },
      [](Primitive& p) { p.epoch += 1; },
      [](Primitive& p) { p.t_on += 1; },
      [](Primitive& p) { p.t_off += 1; },
      [](Primitive& p) { p.fade_in += 1e-9; },
      [](Primitive& p) { p.fade_out += 1e-9; },
      [](Primitive& p) { p.trajectory.pop_back(); },
      [](Primitive& p) { p.trajectory[1].stamp += 1; },
      [](Primitive& p) { p.trajectory[1].position.z() += 1e-9; },
      [](Primitive& p) { p.orbit_radius += 1e-9; },
      [](Primitive& p) { p.orbit_period += 1e-9; },
      [](Primitive& p) { p.repeat += 1e-9; },
      [](Primitive& p) { p.velocity.y() += 1e-9; },
      [](Primitive& p) { p.radius += 1e-9; },
      [](Primitive& p) { p.omega += 1e-9; },
      [](Primitive& p) { p.phase += 1e-9; },
      [](Primitive& p) { p.envelope = Envelope::PAPER; },
      [](Primitive& p) { p.turbulence += 1e-9; },
      [](Primitive& p) { p.length_scale += 1e-9; },
      [](Primitive& p) { p.front_speed += 1e-9; },
      [](Primitive& p) { p.rise_length += 1e-9; },
      [](Primitive& p) { p.plateau_length += 1e-9; },
      [](Primitive& p) { p.decay_length += 1e-9; },
      [](Primitive& p) { p.speed += 1e-9; },
      [](Primitive& p) { p.core_radius += 1e-9; },
      [](Primitive& p) { p.inflow += 1e-9; },
      [](Primitive& p) { p.updraft += 1e-9; }};
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_NE(hashWith(changes[i]), before) << i;
  EXPECT_NE(Field({oneOfEach()[0]}, 6).hash(), before);
  EXPECT_NE(Field(oneOfEach(), 5).hash(), before);
}

/// Returns the kinds of the first golden values; another kind does not change these.
std::vector<Primitive> firstKinds() {
  std::vector<Primitive> out = oneOfEach();
  out.resize(static_cast<std::size_t>(Kind::WAKE));
  return out;
}

TEST(Field, HashIsTheSameInEveryProcess) {  // N2: golden, printed by this test on x86-64
  EXPECT_EQ(Field(firstKinds(), 5).hash(), 13177542376055932748ULL);
}

// N2: golden; g++ -O0, -O2, -O3 with AVX2 and AVX-512, and clang++ -O3 with AVX2 gave the same.
TEST(Field, VelocitiesAreTheSameBitsOnEveryMachine) {
  const auto velocities = [](const Field& field) {
    const Random random(1);
    Hash hash;
    for (std::uint64_t i = 0; i < 20000; ++i)
      hash.add(field.velocity(
          Vec3(random.uniform(4 * i, -20.0, 20.0), random.uniform(4 * i + 1, -20.0, 20.0),
               random.uniform(4 * i + 2, 0.0, 9.0)),
          at(random.uniform(4 * i + 3, 0.0, 45.0))));
    return hash.value();
  };
  EXPECT_EQ(velocities(Field(firstKinds(), 5)), 0x4b7d77fe2c538775ULL);
  EXPECT_EQ(velocities(Field({oneOfEach()[static_cast<std::size_t>(Kind::WAKE)]}, 5)),
            0x9cd31a869f05fc08ULL);
}

TEST(Field, RefusesTwoSourcesOfOneId) {
  std::vector<Primitive> twins = {oneOfEach()[0], oneOfEach()[1]};
  twins[1].id = twins[0].id;
  try {
    Field{twins};
    FAIL() << "took them";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "primitive 'breeze': id = 1 is already in use");
  }
}

TEST(Field, RefusesMoreSourcesThanItHolds) {
  std::vector<Primitive> many(MAX_PRIMITIVES + 1, example(Kind::DISK));
  for (std::size_t i = 0; i < many.size(); ++i) many[i].id = static_cast<std::uint32_t>(i);
  EXPECT_THROW(Field{many}, InvalidInput);
  many.pop_back();
  EXPECT_NO_THROW(Field{many});
}

TEST(Field, ListsTheFaultsOfAllItsSources) {
  Primitive disk = example(Kind::DISK, "left"), blast = example(Kind::BLAST, "right");
  blast.id = 2;
  disk.radius = -1.0;
  blast.core_radius = 0.0;
  try {
    Field({disk, blast});
    FAIL() << "took them";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("'left': radius = -1 m is outside 0.01 to 100000 m"), text.npos) << text;
    EXPECT_NE(text.find("'right': core_radius = 0 m is outside 0.01 to 10000 m"), text.npos);
  }
}

}  // namespace
}  // namespace vegetation_sim::wind
