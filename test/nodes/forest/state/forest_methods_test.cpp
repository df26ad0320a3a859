// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Tests that forest_animator moves its trees by the methods that the scenario selects.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "dynamics/integration/integrator.h"
#include "nodes/forest/forest_options.h"
#include "nodes/rigs/forest_rig.h"
#include "package_folder.h"

namespace vegetation_sim {
namespace {

using forest::PhysicsSettings;

constexpr char FILE_NAME[] = PACKAGE_FOLDER "/test/nodes/scenarios/methods.yaml";

/// Returns the settings of the file, written by hand.
PhysicsSettings wanted() {
  PhysicsSettings out;
  out.dynamics = physics::Dynamics::PAPER;
  out.integrator = physics::Integrator::EXPLICIT_EULER;
  out.precision = forest::Precision::DOUBLE;
  out.material = forest::Material::PAPER;
  out.wind_forcing = forest::WindForcing::PAPER;
  out.promotion = forest::Promotion::DEPTH;
  out.influence_tolerance = 0.007;
  out.most_branches = 777;
  out.fade = 0.6;
  out.linger = 3.0;
  out.blend = 1.25;
  out.contact.stiffness = 200000.0;
  out.contact.force_limit = 1500.0;
  out.contact.force_rate = 90000.0;
  out.contact.push_speed = 0.75;
  return out;
}

/// Returns the hash of a forest of the same trees with these settings at a stamp.
std::uint64_t hashWith(const PhysicsSettings& settings, Nanoseconds stamp) {
  const ForestScene scene = loadForestScene(FILE_NAME);
  forest::Forest out(scene.layout, scene.terrain, ForestTuning().settings);
  out.setPhysics(settings);
  out.advance(stamp);
  return out.hash();
}

// S1-30, S1-31, S1-33: the published state is that of a forest with the settings of the file, and
// no setting keeps its default.
TEST(ForestMethods, MatchTheScenario) {
  ClockedForest forest(3000);
  forest.run(3);
  const Nanoseconds stamp = fromMsg(forest.state.last().header.stamp);
  const std::uint64_t published = forest.state.last().hash;
  EXPECT_EQ(published, hashWith(wanted(), stamp));
  const PhysicsSettings usual;
  const std::vector<std::function<void(PhysicsSettings&)>> changes{
      [&](PhysicsSettings& s) { s.dynamics = usual.dynamics; },
      [&](PhysicsSettings& s) { s.integrator = usual.integrator; },
      [&](PhysicsSettings& s) { s.precision = usual.precision; },
      [&](PhysicsSettings& s) { s.material = usual.material; },
      [&](PhysicsSettings& s) { s.wind_forcing = usual.wind_forcing; },
      [&](PhysicsSettings& s) { s.promotion = usual.promotion; },
      [&](PhysicsSettings& s) { s.influence_tolerance = usual.influence_tolerance; },
      [&](PhysicsSettings& s) { s.most_branches = usual.most_branches; },
      [&](PhysicsSettings& s) { s.fade = usual.fade; },
      [&](PhysicsSettings& s) { s.linger = usual.linger; },
      [&](PhysicsSettings& s) { s.blend = usual.blend; },
      [&](PhysicsSettings& s) { s.contact.stiffness = usual.contact.stiffness; },
      [&](PhysicsSettings& s) { s.contact.force_limit = usual.contact.force_limit; },
      [&](PhysicsSettings& s) { s.contact.force_rate = usual.contact.force_rate; },
      [&](PhysicsSettings& s) { s.contact.push_speed = usual.contact.push_speed; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    PhysicsSettings other = wanted();
    changes[i](other);
    EXPECT_NE(published, hashWith(other, stamp)) << "setting " << i;
  }
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_methods_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
