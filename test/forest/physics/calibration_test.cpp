// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A whole tree is made physical, pulled and released, and its frequency and damping are read.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "scenes/forest/physics_scene.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {
namespace {

constexpr double RUN = 8.0, PULL = 0.3;  // [s]

/// What a free oscillation shows.
struct Oscillation {
  double frequency{0.0};  ///< [rad/s]
  double decay{0.0};      ///< of the amplitude [1/s]
};

/// Returns frequency and decay from the extremes of samples at the rate of ticks.
Oscillation readOscillation(const std::vector<double>& samples) {
  std::vector<double> times, sizes;
  for (std::size_t i = 1; i + 1 < samples.size(); ++i) {
    const double before = std::fabs(samples[i - 1]), at = std::fabs(samples[i]),
                 after = std::fabs(samples[i + 1]);
    if (at <= before || at < after) continue;
    const double off = 0.5 * (before - after) / (before - 2.0 * at + after);
    times.push_back((static_cast<double>(i) + off) / TICK_RATE);
    sizes.push_back(at - 0.25 * (before - after) * off);
  }
  const double duration = times.back() - times.front();
  return {PI * static_cast<double>(times.size() - 1) / duration,
          std::log(sizes.front() / sizes.back()) / duration};
}

PhysicsRig rigOf(double stiffness, double damping) {
  Layout layout = PhysicsRig::makeLayout(1, "birch");
  layout.species = {applyFactors(layout.species[0], {stiffness, damping, 1.0})};
  return PhysicsRig(layout);
}

Push pushOf(const PhysicsRig& rig, int branch, const Vec3& force, double duration) {
  Push out;
  out.point = {0, branch, 0.0};
  out.force = force;
  out.until = rig.now() + seconds(duration);
  return out;
}

/// Makes the tree physical, pulls its trunk and returns the free oscillation after that.
Oscillation calibrate(PhysicsRig rig) {
  const int top = rig.branchOfDepth(0);
  Push whole = pushOf(rig, 0, Vec3::Zero(), RUN);
  whole.whole_tree = true;
  rig.forest.push(whole);
  rig.forest.push(pushOf(rig, top, Vec3(5.0, 0.0, 0.0), PULL));
  const double rest = rig.tip(top).x();
  std::vector<double> samples;
  rig.run(RUN, [&] {
    EXPECT_EQ(rig.forest.physicsFigures().branches, rig.branches().size());
    if (secondsBetween(PHYSICS_START, rig.now()) > 2.5)  // faster modes have died out
      samples.push_back(rig.tip(top).x() - rest);
  });
  return readOscillation(samples);
}

/// Returns the slowest mode in whose shape the trunk bends along x.
Oscillation modeOf(const PhysicsRig& rig) {
  const ModalTree modal(rig.tree, rig.forest.layout().species[0]);
  return {modal.modes().frequency[0], 0.5 * modal.modes().damping[0]};
}

// Paper 1 (its calibration run): all branches of a tree are physical while the request acts, and
// the tree shows the frequency and the damping that its modes have.
TEST(Calibration, AWholeTreeShowsItsFrequencyAndDamping) {
  const PhysicsRig rig = rigOf(1.0, 0.3);
  const Oscillation seen = calibrate(rig), mode = modeOf(rig);
  std::printf("seen %.3f rad/s, %.3f 1/s; mode %.3f rad/s, %.3f 1/s\n", seen.frequency, seen.decay,
              mode.frequency, mode.decay);
  EXPECT_NEAR(seen.frequency, mode.frequency, 0.05 * mode.frequency);
  EXPECT_NEAR(seen.decay, mode.decay, 0.2 * mode.decay);
}

// S1-10: the factors of a tree are seen in its calibration.
TEST(Calibration, ShowsTheFactorsOfTheTree) {
  const Oscillation plain = calibrate(rigOf(1.0, 0.3)), stiff = calibrate(rigOf(4.0, 0.3)),
                    damped = calibrate(rigOf(1.0, 1.5));
  std::printf("stiffness 4: %.2f times the frequency; damping 5: decay %.3f to %.3f 1/s\n",
              stiff.frequency / plain.frequency, plain.decay, damped.decay);
  EXPECT_NEAR(stiff.frequency / plain.frequency, 2.0, 0.1);
  EXPECT_GT(damped.decay, 1.4 * plain.decay);  // most of it is of the air
}

TEST(Calibration, BranchesStayProceduralWithoutIt) {
  PhysicsRig rig = rigOf(1.0, 1.0);
  rig.touch(0, 1.0);
  rig.advance();
  EXPECT_LT(rig.forest.physicsFigures().branches, rig.branches().size() / 2);
}

TEST(Calibration, ATreeWithTooManyBranchesIsRefused) {
  PhysicsSettings few;
  few.most_branches = 100;
  PhysicsRig rig(few, 1, "birch");
  Push whole = pushOf(rig, 0, Vec3::Zero(), 1.0);
  whole.whole_tree = true;
  const std::string count = std::to_string(rig.branches().size());
  EXPECT_EQ(errorOf([&] { rig.forest.push(whole); }),
            "push: whole_tree: tree 0 has " + count +
                " branches, and most_branches = 100 leaves room for 100");
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
}

}  // namespace
}  // namespace vegetation_sim::forest
