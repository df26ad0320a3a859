// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/wind_reader.h"

#include <gtest/gtest.h>

#include "core/config/scenario.h"
#include "scenes/wind/wind_examples.h"

namespace vegetation_sim::wind {
namespace {

struct Read {
  std::vector<Source> sources;
  std::uint64_t seed{0};
};

Read read(const std::string& text) {
  Read out;
  Scenario scenario = Scenario::parse(text, "test.yaml");
  YamlSection section = scenario.section("wind");
  out.sources = readWind(section, out.seed);
  scenario.finish();
  return out;
}

std::string faultsOf(const std::string& text) {
  try {
    read(text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

// N11
TEST(ReadWind, ACurrentIsABreezeWithTheDefaultsOfWater) {
  const std::string begin = "wind: {primitives: [{name: tide, kind: ";
  const Primitive water = read(begin + "current}]}").sources.at(0).primitive;
  EXPECT_EQ(water.kind, Kind::BREEZE);
  EXPECT_EQ(water.name, "tide");
  EXPECT_EQ(water.velocity, Vec3(0.3, 0.0, 0.0));
  EXPECT_EQ(water.turbulence, 0.1);
  EXPECT_EQ(water.length_scale, 3.0);
  const std::string keys = ", velocity: [0.1, 0.2, 0], turbulence: 0.5, length_scale: 4}]}";
  const Field one({read(begin + "current" + keys).sources[0].primitive});
  const Field other({read(begin + "breeze" + keys).sources[0].primitive});
  EXPECT_EQ(one.hash(), other.hash());
  EXPECT_NE(faultsOf(begin + "current, radius: 3}]}").find("radius is not a known key"),
            std::string::npos);
  EXPECT_NE(faultsOf(begin + "stream}]}").find("gauss_markov, current"), std::string::npos);
}

TEST(ReadWind, TakesEveryKey) {
  const Read wind = read(R"(
wind:
  seed: 18446744073709551615
  primitives:
    - {name: sea_breeze, kind: breeze, velocity: [4, 1, 0], turbulence: 0.25, length_scale: 60}
    - {name: disc, kind: disk, velocity: [6, 0, 0], radius: 12, omega: 1.5, phase: 0.5,
       envelope: paper, position: [1, 2, 3], orbit_radius: 20, orbit_period: 45, fade_in: 0}
    - name: squall
      kind: gust
      start: 5
      end: 60
      velocity: [0, 9, 0]
      front_speed: 7
      rise_length: 4
      plateau_length: 8
      decay_length: 20
      repeat: 30
      radius: 25
      trajectory:
        - {t: 0, position: [0, -40, 0]}
        - {t: 30.5, position: [10, -40, 0]}
    - {name: twister, kind: tornado, speed: 14, core_radius: 3, inflow: 0.4, updraft: 0.3}
    - {name: rotor, kind: blast, speed: 12, core_radius: 1, radius: 6, attached_frame: drone}
    - {name: slipstream, kind: wake, radius: 0.9, inflow: 0.2, plateau_length: 6, decay_length: 3,
       attached_frame: car}
)");
  EXPECT_EQ(wind.seed, 18446744073709551615ULL);
  ASSERT_EQ(wind.sources.size(), 6u);
  const Primitive &breeze = wind.sources[0].primitive, &disk = wind.sources[1].primitive;
  EXPECT_EQ(breeze.velocity, Vec3(4.0, 1.0, 0.0));
  EXPECT_EQ(breeze.length_scale, 60.0);
  EXPECT_EQ(breeze.t_off, 0);
  EXPECT_EQ(disk.envelope, Envelope::PAPER);
  EXPECT_EQ(disk.trajectory.at(0).position, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(disk.fade_in, 0.0);
  EXPECT_EQ(disk.fade_out, 1.0);
  const Primitive& squall = wind.sources[2].primitive;
  EXPECT_EQ(squall.t_on, at(5.0));
  EXPECT_EQ(squall.epoch, at(5.0));
  EXPECT_EQ(squall.t_off, at(60.0));
  EXPECT_EQ(squall.trajectory.at(1).stamp, at(30.5));
  EXPECT_EQ(wind.sources[4].attached_frame, "drone");
  const Primitive& wake = wind.sources[5].primitive;
  EXPECT_EQ(wake.radius, 0.9);
  EXPECT_EQ(wake.inflow, 0.2);
  EXPECT_EQ(wake.plateau_length, 6.0);
  EXPECT_EQ(wake.decay_length, 3.0);
}

TEST(ReadWind, OfNothingIsStillAir) {
  EXPECT_TRUE(read("").sources.empty());
  EXPECT_TRUE(read("wind: {seed: 3}").sources.empty());
}

TEST(ReadWind, NamesFileKeyValueAndRange) {
  EXPECT_EQ(faultsOf("wind: {primitives: [{name: a, kind: disk, radius: -3}]}"),
            "test.yaml: wind: primitives[0]: radius = -3 m is outside 0.01 to 100000 m");
  EXPECT_EQ(faultsOf("wind: {primitives: [{name: a, kind: disk, radius: wide}]}"),
            "test.yaml: wind: primitives[0]: radius = 'wide' is not a number");
  EXPECT_EQ(
      faultsOf("wind: {primitives: [{name: a, kind: breeze, velocity: [1, .nan, 0]}]}"),
      "test.yaml: wind: primitives[0]: velocity[1] = nan m/s is not finite, allowed is -200 to "
      "200 m/s");
}

TEST(ReadWind, RefusesKeysOfAnotherKind) {
  EXPECT_NE(faultsOf("wind: {primitives: [{name: a, kind: breeze, core_radius: 3}]}")
                .find("core_radius is not a known key"),
            std::string::npos);
  EXPECT_NE(faultsOf("wind: {primitives: [{name: a, kind: wake, velocity: [1, 0, 0]}]}")
                .find("velocity is not a known key"),
            std::string::npos);
}

TEST(ReadWind, ReportsAllFaultsAtOnce) {
  const std::string faults = faultsOf(R"(
wind:
  seed: -1
  sed: 3
  primitives:
    - {kind: disk}
    - {name: a, kind: whirl}
    - {name: b}
    - {name: c, kind: disk, start: 5, end: 5}
    - {name: d, kind: disk, position: [0, 0, 0], trajectory: [{t: 1, position: [0, 0, 0]}]}
    - {name: e, kind: disk, trajectory: [{t: 1}, {t: 1, position: [0, 0, 0], pose: 1}]}
    - {name: e, kind: gust, velocity: [0, 0, 3]}
    - {name: f, kind: breeze, attached_frame: drone}
    - {name: g, kind: wake, position: [0, 0, 1]}
)");
  for (const char* part :
       {"seed = '-1' is not a whole number", "sed is not a known key",
        "primitives[0]: primitive 0: name is empty",
        "primitives[1]: kind = 'whirl' is none of disk, breeze, gust, tornado, blast, wake",
        "primitives[2]: kind is missing", "primitives[3]: end is not after start",
        "primitives[4]: position and trajectory are both given",
        "primitives[5]: trajectory[0]: position is missing",
        "primitives[5]: trajectory[1]: pose is not a known key", "trajectory[1].stamp = 1.000000 s",
        "primitives[6]: name = 'e' is already in use", "velocity has no horizontal part",
        "is given, but a breeze is everywhere",
        "'g': attached_frame, orbit_radius and a trajectory of two way points are missing"})
    EXPECT_NE(faults.find(part), faults.npos) << part << "\nnot in\n" << faults;
}

}  // namespace
}  // namespace vegetation_sim::wind
