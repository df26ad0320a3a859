// Promotion and demotion.
#include <gtest/gtest.h>

#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr double HELD = 3600.0;  // [s] a fade that does not end

PhysicsSettings allOfIt() {
  PhysicsSettings out;
  out.promotion = Promotion::DEPTH;
  out.linger = 0.0;
  return out;
}

/// Returns the largest RMS(q - q~) over the amplitude of q~ of all joints.
double differenceFromProcedural(const PhysicsSettings& settings) {
  PhysicsRig rig(settings);
  rig.forest.setWind(steadyWind(Vec3(2, 1, 0)));
  rig.run(0.5);
  rig.touch(rig.twig(), 10.0);
  const std::size_t n = rig.branches().size();
  std::vector<double> square(n, 0.0), amplitude(n, 0.0);
  double ticks = 0.0;
  rig.run(6.0, [&] {
    const auto a = rig.angles(rig.now()), b = rig.procedural(rig.now());
    for (std::size_t i = 0; i < n; ++i) {
      square[i] += std::pow(difference(a[i], b[i]), 2);
      amplitude[i] = std::max(amplitude[i], std::hypot(b[i].first, b[i].second));
    }
    ++ticks;
  });
  EXPECT_EQ(rig.forest.physicsFigures().branches, n);
  double worst = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    worst = std::max(worst, std::sqrt(square[i] / ticks) / amplitude[i]);
  return worst;
}

// N10, E1, S1-26: a whole tree made physical in steady wind moves as before; in the printed form it
// does not.
TEST(HandOver, CompensatedWindKeepsTheProceduralMotion) {
  PhysicsSettings settings = allOfIt();
  settings.fade = HELD;
  const double compensated = differenceFromProcedural(settings);
  settings.wind_forcing = WindForcing::PAPER;
  const double printed = differenceFromProcedural(settings);
  std::printf("RMS difference from procedural over amplitude: compensated %.2e, printed %.2f\n",
              compensated, printed);
  EXPECT_LT(compensated, 0.01);
  EXPECT_GT(printed, 0.5);
}

/// Left and right limits of the visible motion at a switch: the largest difference of angles [rad],
/// and of rates over the peak rate, over all joints.
struct Jump {
  double angle{0.0}, rate{0.0};

  void add(const Jump& other) {
    angle = std::max(angle, other.angle);
    rate = std::max(rate, other.rate);
  }
};

constexpr Nanoseconds FINE = 10000;  // between samples [ns]

using Angles = std::vector<JointAngles>;

/// Returns angles and rates at a stamp, from two samples on one side of it.
struct Limit {
  Angles q, rate;

  /// @param from,to angles of two samples; the stamp is `way` times their distance beyond `to`.
  Limit(const Angles& from, const Angles& to, double way, Nanoseconds apart) : q(to), rate(to) {
    const double h = apart * 1e-9;
    for (std::size_t i = 0; i < to.size(); ++i) {
      rate[i] = {(to[i].first - from[i].first) / h, (to[i].second - from[i].second) / h};
      q[i] = {to[i].first + way * h * rate[i].first, to[i].second + way * h * rate[i].second};
    }
  }
};

Jump interpolate(const Limit& left, const Limit& right, double peak) {
  Jump out;
  for (std::size_t i = 0; i < left.q.size(); ++i)
    out.add({difference(left.q[i], right.q[i]), difference(left.rate[i], right.rate[i]) / peak});
  return out;
}

Angles sampleAt(PhysicsRig& rig, Nanoseconds stamp) {
  rig.forest.advance(stamp);
  return rig.angles(stamp);
}

// Advances to the next tick and applies a change there; returns the visible motion before and
// after.
Jump jumpAt(PhysicsRig& rig, double peak, const std::function<void(PhysicsRig&)>& change) {
  const Nanoseconds stamp = rig.grid.timeOf(rig.tick + 1);
  PhysicsRig with = rig;
  const Angles before = sampleAt(with, stamp - 2 * FINE), last = sampleAt(with, stamp - FINE);
  with.forest.advance(stamp);
  ++with.tick;
  change(with);
  const Angles first = sampleAt(with, stamp + FINE), after = sampleAt(with, stamp + 2 * FINE);
  rig.advance();
  return interpolate({before, last, 1.0, FINE}, {after, first, 1.0, -FINE}, peak);
}

double peakRate(PhysicsRig rig, double duration) {
  double out = 0.0;
  auto before = rig.angles(rig.now());
  rig.run(duration, [&] {
    const auto after = rig.angles(rig.now());
    for (std::size_t i = 0; i < after.size(); ++i)
      out = std::max(out, TICK_RATE * difference(before[i], after[i]));
    before = after;
  });
  return out;
}

// The tolerance is 0.1 degree, 1.7e-3. Joints bend little here, so this one is far smaller [rad].
constexpr double LARGEST_JUMP = 1e-6;

// S1-36: promotion at any phase of the wind.
TEST(HandOver, PromotionJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig(allOfIt());
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  const double peak = peakRate(rig, 3.5);
  Jump worst;
  for (int i = 0; i < 8; ++i) {
    rig.run(0.37);
    worst.add(jumpAt(rig, peak, [](PhysicsRig& r) { r.touch(r.twig(), 1.0); }));
  }
  std::printf("promotion: %.1e rad, %.1e of peak rate\n", worst.angle, worst.rate);
  EXPECT_LT(worst.angle, LARGEST_JUMP);
  EXPECT_LT(worst.rate, 0.01);
}

/// Four trees in their modes.
Clearing treesInModes(const PhysicsSettings& physics) {
  Clearing out;
  out.requireOfTheWorld();
  out.forest.setPhysics(physics);
  out.run(3.0);
  return out;
}

Clearing touched(Clearing scene, const Tree& tree, std::uint32_t id, double duration) {
  Push touch;
  touch.point = {id, static_cast<int>(tree.skeleton.branches.size()) - 1, 0.0};
  touch.until = scene.now() + seconds(duration);
  scene.forest.push(touch);
  return scene;
}

/// Returns the angles of the world, physical ones included.
Angles worldAngles(const Clearing& scene, const Tree& tree, std::uint32_t id, Nanoseconds stamp) {
  const ForestSnapshot& world = scene.forest.snapshot();
  const LevelState level = scene.forest.world().levels.of(id);
  Angles out = modalAngles(tree, world.wind.at(stamp).relativeTo(tree.foot),
                           weightsAt(level, stamp, scene.forest.layout().motion),
                           scene.forest.world().modes.find(id), stamp);
  overlay(scene.forest.promoted(id), stamp, out);
  return out;
}

/// Returns the motion right after the last tick, for the limit there. Angles in single precision
/// have steps of some 1e-9 rad, which are rates of 1e-5 rad/s here.
Limit motionAfter(const Clearing& scene, const Tree& tree, std::uint32_t id) {
  constexpr Nanoseconds APART = 500000;
  const auto at = [&](Nanoseconds after) {
    Clearing later = scene;
    later.forest.advance(scene.now() + after);
    return worldAngles(later, tree, id, scene.now() + after);
  };
  return {at(2 * APART), at(APART), 1.0, -APART};
}

// N10, E1: a whole tree in its modes becomes physical without a jump, at any phase of the wind,
// with the default fade.
TEST(HandOver, PromotionFromModesJumpsNeitherInAngleNorInRate) {
  for (const std::uint32_t id : {0u, 1u, 2u, 3u}) {
    Clearing scene = treesInModes(allOfIt());
    ASSERT_GE(scene.forest.world().levels.of(id).level, MODAL_LEVEL);
    const Tree tree = scene.tree(id);
    Jump worst;
    double peak = 0.0;
    for (int i = 0; i < 8; ++i) {
      scene.run(0.37);
      const Limit before = motionAfter(scene, tree, id);
      worst.add(interpolate(before, motionAfter(touched(scene, tree, id, 1.0), tree, id), 1.0));
      for (const JointAngles& rate : before.rate) peak = std::max(peak, difference(rate, {}));
    }
    std::printf("tree %u: %.1e rad, %.1e of the peak rate, %.2f rad/s\n", id, worst.angle,
                worst.rate / peak, peak);
    EXPECT_LT(worst.angle, LARGEST_JUMP);
    EXPECT_LT(worst.rate, 0.01 * peak);
  }
}

// N10, E1: at first a tree from modes moves as before; then the load fades to the real one, and the
// tree follows full dynamics, which modes approximate.
TEST(HandOver, FromModesTheMotionIsKeptAtFirst) {
  for (const std::uint32_t id : {0u, 1u, 2u, 3u}) {
    Clearing scene = treesInModes(allOfIt());
    const Tree tree = scene.tree(id);
    Clearing physical = touched(scene, tree, id, 10.0);
    double off = 0.0, size = 0.0, first = 0.0;
    for (int i = 1; i <= 3 * TICK_RATE; ++i) {
      scene.advance(), physical.advance();
      const auto a = forwardKinematics(tree, worldAngles(scene, tree, id, scene.now()));
      const auto b = forwardKinematics(tree, worldAngles(physical, tree, id, scene.now()));
      for (std::size_t j = 0; j < a.size(); ++j) {
        const Branch& branch = tree.skeleton.branches[j];
        off += (tipOf(branch, a[j]) - tipOf(branch, b[j])).squaredNorm();
        size += (tipOf(branch, a[j]) - tipOf(branch, branch.rest)).squaredNorm();
      }
      if (i == TICK_RATE / 10) first = std::sqrt(off / size);
    }
    const double last = std::sqrt(off / size);
    std::printf("tree %u: RMS of all tips off the modes %.2f %% in 0.1 s, %.1f %% in 3 s\n", id,
                100.0 * first, 100.0 * last);
    EXPECT_LT(first, 0.01);
    EXPECT_LT(last, 0.1);
  }
}

/// RMS of all tips off the procedural motion, over the largest RMS of their ways in it.
struct Departure {
  double first{0.0};  ///< in 0.1 s
  double last{0.0};   ///< in 3 s

  explicit Departure(PhysicsRig rig) {
    double off = 0.0, amplitude = 0.0;
    for (int i = 1; i <= 3 * TICK_RATE; ++i) {
      rig.advance();
      const auto a = forwardKinematics(rig.tree, rig.procedural(rig.now()));
      const auto b = forwardKinematics(rig.tree, rig.angles(rig.now()));
      double size = 0.0;
      for (std::size_t j = 0; j < a.size(); ++j) {
        const Branch& branch = rig.branches()[j];
        off += (tipOf(branch, a[j]) - tipOf(branch, b[j])).squaredNorm();
        size += (tipOf(branch, a[j]) - tipOf(branch, branch.rest)).squaredNorm();
      }
      amplitude = std::max(amplitude, size);
      if (i == TICK_RATE / 10) first = off / i;
      last = off / i;
    }
    first = std::sqrt(first / amplitude);
    last = std::sqrt(last / amplitude);
  }
};

// N10, E1: a whole tree goes over from the procedural motion to full dynamics without a jump, at
// any phase of the wind, with the default fade f. The wind swings with w = 2 rad/s, so motion of
// amplitude A accelerates by w^2 A. The fade takes 10 (t / f)^3 of the compensation of that away at
// first, which moves the tree by w^2 A t^5 / (2 f^3), 2e-4 A after 0.1 s; without compensation it
// were w^2 A t^2 / 2, 2e-2 A. After the fade it is off by the dynamic response to the wind, as are
// its transients: with a lowest frequency of 4 rad/s by 2 (1 / (1 - (w / 4)^2) - 1) A = 0.67 A.
TEST(HandOver, FromProceduralTheMotionIsKeptAtFirst) {
  const auto touch = [](PhysicsRig& r) { r.touch(r.twig(), 10.0); };
  PhysicsRig rig(allOfIt());
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  const double peak = peakRate(rig, 3.5);
  for (int phase = 0; phase < 5; ++phase) {
    rig.run(0.37);
    PhysicsRig physical = rig;
    const Jump jump = jumpAt(physical, peak, touch);
    touch(physical);
    const Departure off(physical);
    std::printf(
        "phase %d: %.1e rad, %.1e of peak rate; RMS of all tips off the procedural motion "
        "%.3f %% of the amplitude in 0.1 s, %.0f %% in 3 s\n",
        phase, jump.angle, jump.rate, 100.0 * off.first, 100.0 * off.last);
    EXPECT_LT(jump.angle, LARGEST_JUMP);
    EXPECT_LT(jump.rate, 0.01);
    EXPECT_LT(off.first, 0.0003);
    EXPECT_LT(off.last, 0.08);
    EXPECT_GT(off.last, off.first);  // it does not stay procedural
  }
}

/// A branch is pulled aside and released; the blend starts in mid-recoil.
PhysicsRig recoiling() {
  PhysicsSettings settings;
  settings.linger = 0.3;
  PhysicsRig rig(settings);
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  rig.run(0.2);
  const int branch = rig.branchOfDepth(1);
  Grab grab = rig.grabOf(branch);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(0.5, [&] {
    grab.target += Vec3(0.0, 0.4, -0.2) / (0.5 * TICK_RATE);
    rig.forest.moveGrab(id, grab.target);
  });
  rig.forest.release(id);
  return rig;
}

// Checks every stamp of an interval, with four samples that are 5e-5 s apart, whenever something is
// switched. @param sample advances to a stamp and returns the angles.
Jump jumpsIn(Nanoseconds start, Nanoseconds duration, double peak,
             const std::function<Angles(Nanoseconds)>& sample) {
  constexpr Nanoseconds APART = 50000;
  std::vector<Angles> looks;
  Jump out;
  for (Nanoseconds t = APART; t <= duration; t += APART) {
    looks.push_back(sample(start + t));
    if (looks.size() < 4) continue;
    out.add(interpolate({looks[0], looks[1], 0.5, APART}, {looks[3], looks[2], 0.5, -APART}, peak));
    looks.erase(looks.begin());
  }
  return out;
}

// S1-37: demotion, at the start and the end of blends.
TEST(HandOver, DemotionJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig = recoiling();
  const double peak = peakRate(rig, 1.0);
  rig.run(0.1);  // the release is a step of force
  Jump worst;
  int switches = 0;
  for (int i = 0; i < 4 * TICK_RATE; ++i) {
    PhysicsRig before = rig;
    rig.advance();
    const PhysicsFigures a = before.forest.physicsFigures(), b = rig.forest.physicsFigures();
    if (a.blending == b.blending && a.branches == b.branches) continue;
    ++switches;
    worst.add(jumpsIn(before.now(), before.grid.timeOf(before.tick + 2) - before.now(), peak,
                      [&](Nanoseconds stamp) { return sampleAt(before, stamp); }));
  }
  std::printf("demotion: %d switches, %.1e rad, %.1e of peak rate\n", switches, worst.angle,
              worst.rate);
  EXPECT_GE(switches, 2);
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
  EXPECT_LT(worst.angle, LARGEST_JUMP);
  EXPECT_LT(worst.rate, 0.01);
}

// N10, S1-37: a whole tree blends back into its modes without a jump, with the default fade and
// blend, and then moves to the bit as a tree that was never touched.
TEST(HandOver, DemotionIntoModesJumpsNeitherInAngleNorInRate) {
  for (const std::uint32_t id : {0u, 2u}) {
    Clearing untouched = treesInModes(allOfIt());
    const Tree tree = untouched.tree(id);
    Clearing scene = touched(untouched, tree, id, 1.0);
    constexpr double PEAK = 0.02;  // [rad/s] a rate that each of these trees has
    Jump worst;
    int switches = 0;
    scene.advance(), untouched.advance();
    for (int i = 0; i < 3 * TICK_RATE; ++i) {
      Clearing before = scene;
      scene.advance(), untouched.advance();
      const PhysicsFigures a = before.forest.physicsFigures(), b = scene.forest.physicsFigures();
      if (a.blending == b.blending && a.branches == b.branches) continue;
      ++switches;
      worst.add(jumpsIn(before.now(), before.grid.timeOf(before.tick + 2) - before.now(), PEAK,
                        [&](Nanoseconds stamp) {
                          before.forest.advance(stamp);
                          return worldAngles(before, tree, id, stamp);
                        }));
    }
    double off = 0.0;
    const Angles back = worldAngles(scene, tree, id, scene.now()),
                 never = worldAngles(untouched, tree, id, scene.now());
    for (std::size_t i = 0; i < back.size(); ++i)
      off = std::max(off, difference(back[i], never[i]));
    std::printf("tree %u: %d switches, %.1e rad, %.1e of the rate of 0.02 rad/s\n", id, switches,
                worst.angle, worst.rate);
    EXPECT_GE(switches, 2);
    EXPECT_EQ(scene.forest.physicsFigures().branches, 0u);
    EXPECT_LT(worst.angle, LARGEST_JUMP);
    EXPECT_LT(worst.rate, 0.01);
    EXPECT_EQ(off, 0.0);
  }
}

// S1-37: the visible motion is (1 - a) physical + a procedural with a = 3 u^2 - 2 u^3 over 1.5 s.
TEST(HandOver, BlendIsThePapersSmoothStep) {
  PromotedBranch branch{0, {}, {}, PHYSICS_START};
  const auto at = [&](double u) {
    return blendWeight(branch, PHYSICS_START + seconds(1.5 * u), 1.5);
  };
  EXPECT_DOUBLE_EQ(at(0.25), 0.15625);
  EXPECT_DOUBLE_EQ(at(0.5), 0.5);
  EXPECT_DOUBLE_EQ(at(0.75), 0.84375);
  EXPECT_EQ(at(-1.0), 0.0);
  EXPECT_EQ(at(2.0), 1.0);
  EXPECT_EQ(PhysicsSettings().blend, 1.5);
}

// S1-37, S1-38: the blend starts, is cancelled and ends without a jump, at any time.
TEST(HandOver, RegrabInTheBlendJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig = recoiling();
  const double peak = peakRate(rig, 1.0);
  while (rig.forest.physicsFigures().blending == 0) rig.advance();
  Jump worst;
  int tried = 0;
  while (rig.forest.physicsFigures().blending > 0) {
    if (++tried % 7 == 0)
      worst.add(jumpAt(rig, peak, [](PhysicsRig& r) { r.touch(r.branchOfDepth(1), 9.0); }));
    else
      rig.advance();
  }
  std::printf("regrab: %.1e rad, %.1e of peak rate, of %d instants\n", worst.angle, worst.rate,
              tried / 7);
  EXPECT_GT(tried, 60);
  EXPECT_LT(worst.angle, LARGEST_JUMP);
  EXPECT_LT(worst.rate, 0.01);
}

// A target that jumps needs as many physical branches in that tick as one that was there from the
// beginning. A limb that alone is physical would break under a force that the tree can bear.
TEST(HandOver, TargetThatJumpsMakesItsBranchesPhysicalAtOnce) {
  const auto held = [](bool jumps) {
    PhysicsRig rig;
    Grab grab = rig.grabOf(rig.branchOfDepth(1));
    grab.stiffness = 2e4;
    grab.damping = 200.0;
    grab.force_limit = 5000.0;
    const Vec3 target = grab.target + Vec3(0.2, 0, 0);
    if (!jumps) grab.target = target;
    const std::uint32_t id = rig.forest.addGrab(grab);
    rig.advance();
    if (!jumps) return rig.forest.promoted(0).branches.size();
    EXPECT_LT(rig.forest.promoted(0).branches.size(), 5u);  // no force yet
    rig.forest.moveGrab(id, target);
    rig.advance();
    EXPECT_TRUE(rig.forest.breaks().empty());
    return rig.forest.promoted(0).branches.size();
  };
  const std::size_t all = held(false);
  EXPECT_GT(all, 20u);
  EXPECT_EQ(held(true), all);
}

// S1-25: nothing is held before a branch is touched or after it has blended back.
TEST(HandOver, NothingIsHeldBeforeAndAfter) {
  PhysicsRig rig({}, 4);
  rig.run(0.2);
  EXPECT_EQ(rig.forest.physicsFigures().bytes, 0u);
  const std::uint64_t untouched = rig.forest.snapshot().physics.subtrees().size();
  EXPECT_EQ(untouched, 0u);
  Grab grab = rig.grabOf(rig.branchOfDepth(1));
  grab.target += Vec3(0.3, 0.0, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(1.0);
  const PhysicsFigures during = rig.forest.physicsFigures();
  EXPECT_EQ(during.trees, 1u);
  EXPECT_GT(during.branches, 0u);
  EXPECT_GT(during.bytes, 0u);
  rig.forest.release(id);
  rig.run(10.0);
  const PhysicsFigures after = rig.forest.physicsFigures();
  EXPECT_EQ(after.trees, 0u);
  EXPECT_EQ(after.branches, 0u);
  EXPECT_EQ(after.bytes, 0u);
  EXPECT_TRUE(rig.forest.snapshot().physics.subtrees().empty());
  std::printf("during: %zu branches, %zu bytes\n", during.branches, during.bytes);
}

// E6: without wind a tree keeps its rest shape through promotion, physics, blend and after.
TEST(HandOver, WithoutWindTheRestShapeStays) {
  PhysicsRig rig(allOfIt());
  const auto rest = rig.forest.pose(rig.tree, 0, rig.now());
  rig.touch(rig.twig(), 1.0);
  rig.run(4.0, [&] {
    const auto poses = rig.forest.pose(rig.tree, 0, rig.now());
    for (std::size_t i = 0; i < rest.size(); ++i)
      ASSERT_LT(length(poses[i].position - rest[i].position), 1e-12) << i;
  });
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
}

}  // namespace
}  // namespace vegetation_sim::forest
