// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/sampling/wind_sampler.h"

#include <gtest/gtest.h>

#include "scenes/forest/physics_scene.h"
#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

std::vector<Vec3> scattered(std::size_t count) {
  const Random random(11);
  std::vector<Vec3> out;
  for (std::uint64_t i = 0; i < count; ++i)
    out.emplace_back(random.uniform(3 * i, -20.0, 20.0), random.uniform(3 * i + 1, -20.0, 20.0),
                     random.uniform(3 * i + 2, 0.0, 20.0));
  return out;
}

// N6, S1-16: for any instruction set and number of points, the results have the bits of the law.
TEST(WindSampler, GivesTheInstantsVelocitiesToTheBit) {
  const wind::Field field(wind::oneOfEach(), 3);
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    WindSampler sampler;
    for (const std::size_t count : {1u, 7u, 16u, 17u, 301u}) {
      const std::vector<Vec3> points = scattered(count);
      sampler.clear();
      for (const Vec3& point : points) sampler.add(point);
      for (const double time : {5.0, 8.7}) {  // points stay from call to call
        const wind::Instant wind = field.at(wind::at(time));
        sampler.sample(wind);
        for (std::size_t i = 0; i < count; ++i) {
          const Vec3 ours = sampler.velocity(i), law = wind.velocity(points[i]);
          ASSERT_EQ(ours, law) << set << ", point " << i << " of " << count;
          ASSERT_GT(length(law), 0.0);
        }
      }
    }
  }
  forceInstructionSet("");
}

// The three instants of a window are those of the field, with rotated phases or without, and many
// points have the bits of one.
TEST(WindSampler, WindowsHaveTheVelocitiesOfTheirInstants) {
  std::vector<wind::Primitive> changes = wind::oneOfEach();
  wind::Primitive late = makeBreeze(77, Vec3(3, 1, 0));
  late.t_on = wind::at(8.7);  // after the first instant of a window there
  changes.push_back(late);
  const std::vector<Vec3> points = scattered(37);
  int turned = 0;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    for (const auto& primitives : {wind::oneOfEach(), changes, std::vector<wind::Primitive>{late}})
      for (const double time : {5.0, 8.7}) {
        WindWindow window;
        window.sampleAt(wind::Field(primitives, 3), wind::at(time));
        turned += window.hasSameModes();
        WindSampler sampler;
        for (const Vec3& point : points) sampler.add(point);
        sampler.sample(window);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const auto one = window.velocities(points[i]);
          EXPECT_EQ(one[1], window.now().velocity(points[i]));
          for (std::size_t instant = 0; instant < 3; ++instant) {
            ASSERT_EQ(sampler.velocity(i, instant), one[instant]) << set << ", instant " << instant;
            const Vec3 law = window.instants()[instant].velocity(points[i]);
            EXPECT_LE(length(one[instant] - law), 1e-13 * length(law));
          }
        }
      }
  }
  forceInstructionSet("");
  const int sets = static_cast<int>(instructionSets().size());
  EXPECT_EQ(turned, 4 * sets);  // but where the breeze starts between two instants
}

// S1-36: the motion before promotion is the same for many branches as for one.
TEST(WindSampler, MotionOfManyBranchesIsThatOfEach) {
  PhysicsRig rig;
  wind::Primitive breeze = makeBreeze(1, Vec3(4, 2, 0));
  breeze.epoch = PHYSICS_START;
  WindWindow window;
  window.sampleAt(wind::Field({breeze}), rig.now());
  LevelState level = LevelState::settled(3);  // finer branches stand still
  const ProceduralMotion motion(rig.tree, window, level, rig.forest.layout().motion);
  std::vector<int> branches;
  for (int i = 0; i < static_cast<int>(rig.branches().size()); i += 3) branches.push_back(i);
  ProceduralMotions motions;
  motions.update(motion, branches);
  int moving = 0;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const JointMotion one = motion.at(branches[i]), many = motions.at(i);
    EXPECT_EQ(difference(one.q, many.q), 0.0);
    EXPECT_EQ(difference(one.rate, many.rate), 0.0);
    EXPECT_EQ(difference(one.acceleration, many.acceleration), 0.0);
    moving += difference(one.acceleration, {}) > 0.0;
  }
  EXPECT_GT(moving, 10);
  EXPECT_LT(moving, static_cast<int>(branches.size()));
}

}  // namespace
}  // namespace vegetation_sim::forest
