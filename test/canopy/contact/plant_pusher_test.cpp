// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/contact/plant_pusher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vegetation_sim::canopy {
namespace {

constexpr Nanoseconds START = 1000 * NANOSECONDS_PER_SECOND;

/// A row of reeds along x, one per metre.
struct Row {
  std::vector<PlantKind> kinds{1};
  std::vector<Plant> plants{5};
  PushState state;
  Row() {
    kinds[0].shape = PlantShape::REED;
    kinds[0].height = 1.2;
    kinds[0].radius = 0.4;
    for (std::size_t i = 0; i < plants.size(); ++i)
      plants[i].position = Vec3(static_cast<double>(i), 0.0, 0.0);
  }
};

forest::Body boxAt(const Vec3& place, const Vec3& velocity, Nanoseconds stamp) {
  forest::Body out;
  out.id = out.frame = "robot";
  out.shape = forest::Shape::BOX;
  out.size = Vec3(0.6, 0.4, 0.5);
  out.pose.position = place;
  out.velocity = velocity;
  out.stamp = stamp;
  return out;
}

struct Drive {
  double work{0.0}, energy_excess{-1e9}, largest{0.0};
  Vec3 impulse{Vec3::Zero()};
};

// Drives from x = -2 m to 7 m, and returns what the plants have got.
Drive driveThrough(Row& row, double speed, int rate) {
  PlantPusher pusher(row.kinds, row.plants);
  Drive out;
  Nanoseconds now = START;
  const Vec3 velocity(speed, 0.0, 0.0);
  for (double x = -2.0; x < 7.0; x += speed / rate) {
    const Nanoseconds next = now + NANOSECONDS_PER_SECOND / rate;
    row.state.bodies["robot"] = boxAt(Vec3(x, 0.0, 0.4), velocity, next);
    for (const PushForce& force : pusher.advance(row.state, now, next)) {
      out.work -= dot(force.force, velocity) / rate;
      out.impulse += force.force / rate;
      out.largest = std::max(out.largest, length(force.force));
    }
    double energy = 0.0;
    for (const auto& [plant, clusters] : row.state.plants)
      for (std::size_t cell = 0; cell < clusters.size(); ++cell)
        energy += energyOf(pusher.lawOf(plant), pusher.fibresOf(plant), cell, clusters[cell]);
    out.energy_excess = std::max(out.energy_excess, energy - out.work);
    now = next;
  }
  return out;
}

// Work balance: the force on the body times its way covers the energy of all plants at any time.
TEST(PlantPusher, ADriveThroughARowGivesNoPlantMoreEnergyThanTheBodyLoses) {
  for (const double speed : {0.3, 1.0, 3.0}) {
    Row row;
    const Drive drive = driveThrough(row, speed, 30);
    EXPECT_GT(drive.work, 1.0) << speed;
    EXPECT_LE(drive.energy_excess, 1e-9) << speed;
    EXPECT_LT(drive.impulse.x(), 0.0);  // against the motion
    EXPECT_LT(std::fabs(drive.impulse.y()), 0.2 * std::fabs(drive.impulse.x()));
  }
}

// Steps depend on the way of the body, so that the rate of ticks hardly matters.
TEST(PlantPusher, TheRateOfTicksHardlyChangesTheWork) {
  Row finest;
  const double work = driveThrough(finest, 1.0, 240).work;
  for (const int rate : {120, 60, 30, 10}) {
    Row row;
    EXPECT_NEAR(driveThrough(row, 1.0, rate).work / work, 1.0, 0.05) << rate;
  }
}

TEST(PlantPusher, PlantsStandUpAgainAndThenTakeNoMemory) {
  Row row;
  driveThrough(row, 1.0, 30);
  PlantPusher pusher(row.kinds, row.plants);
  EXPECT_FALSE(row.state.plants.empty());
  row.state.bodies.clear();
  Nanoseconds now = START;
  for (int i = 0; i < 300; ++i) {
    pusher.advance(row.state, now, now + NANOSECONDS_PER_SECOND / 10);
    now += NANOSECONDS_PER_SECOND / 10;
  }
  EXPECT_TRUE(row.state.plants.empty());
}

TEST(PlantPusher, ABodyThatTouchesNothingLeavesNoTrace) {
  Row row;
  PlantPusher pusher(row.kinds, row.plants);
  row.state.bodies["robot"] = boxAt(Vec3(2.0, 5.0, 0.4), Vec3::Zero(), START);
  EXPECT_TRUE(pusher.advance(row.state, START, START + NANOSECONDS_PER_SECOND).empty());
  EXPECT_TRUE(row.state.plants.empty());
  row.state.bodies["robot"] = boxAt(Vec3(2.0, 0.0, 2.5), Vec3::Zero(), START);  // flies over it
  EXPECT_TRUE(pusher.advance(row.state, START, START + NANOSECONDS_PER_SECOND).empty());
  EXPECT_TRUE(row.state.plants.empty());
}

TEST(PlantPusher, AKindWithoutStiffnessAnswersNothing) {
  Row row;
  row.kinds[0].push.stiffness = 0.0;
  EXPECT_EQ(driveThrough(row, 1.0, 30).largest, 0.0);
  EXPECT_TRUE(row.state.plants.empty());
}

// A body that parks holds the plants aside; the mean force stays, and goes to its own side.
TEST(PlantPusher, AParkedBodyHoldsPlantsAside) {
  Row row;
  PlantPusher pusher(row.kinds, row.plants);
  row.state.bodies["robot"] = boxAt(Vec3(2.0, 0.45, 0.4), Vec3::Zero(), START);
  std::vector<PushForce> forces;
  Nanoseconds now = START;
  for (int i = 0; i < 300; ++i) {
    forces = pusher.advance(row.state, now, now + NANOSECONDS_PER_SECOND / 30);
    now += NANOSECONDS_PER_SECOND / 30;
  }
  ASSERT_EQ(forces.size(), 1u);
  EXPECT_EQ(forces[0].plant, 2u);
  EXPECT_EQ(forces[0].body, "robot");
  EXPECT_GT(forces[0].force.y(), 1.0);  // the reeds press it to its own side
  EXPECT_GT(forces[0].volume, 0.0);
  for (const Cluster& cluster : row.state.plants.at(2)) EXPECT_LT(cluster.rate.size(), 1e-3);
}

PushForce forceBeside(double y) {
  Row row;
  PlantPusher pusher(row.kinds, row.plants);
  row.state.bodies["robot"] = boxAt(Vec3(2.1, y, 0.4), Vec3(0.5, 0.0, 0.0), START);
  const auto forces = pusher.advance(row.state, START, START + NANOSECONDS_PER_SECOND / 30);
  EXPECT_EQ(forces.size(), 1u);
  return forces.empty() ? PushForce() : forces[0];
}

// Force, point and torque are mirrored with the body; a torque is an axial vector.
TEST(PlantPusher, ForceAndTorqueAreMirroredWithTheBody) {
  const PushForce left = forceBeside(0.3), right = forceBeside(-0.3);
  EXPECT_GT(std::fabs(left.force.y()), 1.0);
  EXPECT_GT(length(left.torque), 0.01);
  EXPECT_LT(length(left.point - Vec3(2.1, 0.3, 0.4)), 0.5);  // within the box
  const double force = 1e-9 * length(left.force);
  for (const auto& [a, b] : {std::pair(left.force, right.force), {left.point, right.point}})
    EXPECT_LT(length(Vec3(a.x() - b.x(), a.y() + b.y(), a.z() - b.z())), force);
  const Vec3 &a = left.torque, &b = right.torque;
  EXPECT_LT(length(Vec3(a.x() + b.x(), a.y() - b.y(), a.z() + b.z())), force);
}

// A gap between ticks makes the range of a fast body as large as the row.
TEST(PlantPusher, ABodyOfAnySpeedTouchesEachPlantOnce) {
  Row row;
  PlantPusher pusher(row.kinds, row.plants);
  forest::Body body = boxAt(Vec3(-30.0, 0.0, 0.4), Vec3(100.0, 0.0, 0.0), START);
  body.size = Vec3(50.0, 50.0, 50.0);
  body.spin = Vec3(0.0, 0.0, 100.0);
  row.state.bodies["robot"] = body;
  const auto forces = pusher.advance(row.state, START, START + 10 * NANOSECONDS_PER_SECOND);
  ASSERT_EQ(forces.size(), row.plants.size());
  for (std::uint32_t id = 0; id < forces.size(); ++id) {
    EXPECT_EQ(forces[id].plant, id);
    EXPECT_TRUE(std::isfinite(length(forces[id].force)));
  }
  for (const auto& entry : row.state.plants)
    for (const Cluster& cluster : entry.second)
      EXPECT_LE(cluster.lean.size(), LARGEST_LEAN + 1e-12);
}

// A plant that leans is met beyond the place where it stands.
TEST(PlantPusher, ABodyIsNearWhatLeansTowardsIt) {
  Row row;
  PlantPusher pusher(row.kinds, row.plants);
  const forest::Body body = boxAt(Vec3(6.3, 0.0, 0.4), Vec3::Zero(), START);
  EXPECT_FALSE(pusher.isNear(row.state, body, START));
  row.state.plants[4].assign(pusher.fibresOf(4).cells(), Cluster());
  EXPECT_TRUE(pusher.isNear(row.state, body, START));
  EXPECT_FALSE(pusher.isNear(row.state, boxAt(Vec3(9.0, 0.0, 0.4), Vec3::Zero(), START), START));
}

// More than MOST_CLUSTERS cells do not lean at once.
TEST(PlantPusher, TheNumberOfCellsThatLeanIsBounded) {
  Row row;
  row.plants.assign(200, Plant());  // of 256 cells each, on one place
  row.kinds[0].push.cell = 0.02;
  PlantPusher pusher(row.kinds, row.plants);
  row.state.bodies["robot"] = boxAt(Vec3(0.0, 0.0, 0.4), Vec3::Zero(), START);
  pusher.advance(row.state, START, START + NANOSECONDS_PER_SECOND / 30);
  std::size_t cells = 0;
  for (const auto& entry : row.state.plants) cells += entry.second.size();
  EXPECT_EQ(cells, MOST_CLUSTERS);
  EXPECT_EQ(pusher.refused(), 200u - MOST_CLUSTERS / 256u);
}

}  // namespace
}  // namespace vegetation_sim::canopy
