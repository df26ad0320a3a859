// Grabs and pushes.
#include "tree/physical/interaction.h"

#include <gtest/gtest.h>

#include "core/error_text.h"
#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

PhysicsSettings byDepth() {
  PhysicsSettings out;
  out.promotion = Promotion::DEPTH;
  return out;
}

/// One straight pole of one joint, without leaves.
PhysicsRig poleRig() {
  Layout layout;
  Species pole;
  pole.name = "pole";
  pole.height = 2.0;
  pole.trunk_radius = 0.03;
  pole.noise = pole.lean = pole.height_variation = 0.0;
  pole.limbs[0].segments = 1;
  pole.limbs[0].taper = 1.0;
  layout.species = {pole};
  layout.trees = {TreeSeed()};
  PhysicsRig out;
  out.forest.setLayout(layout, flatTerrain());
  out.tree = growTree(layout, 0, out.forest.terrain());
  out.run(0.1);
  return out;
}

// S1-27, S1-28, E17, N3: at rest, the gripper gets k (q - q0) over the lever arm, and a push of
// that size bends the joint as much.
TEST(Interaction, WrenchIsTheJointsSpringOverItsLever) {
  PhysicsRig rig = poleRig();
  const double k = jointStiffness(rig.branches()[0], rig.forest.layout().species[0]), lever = 2.0;
  Grab grab = rig.grabOf(0);
  grab.stiffness = 1e5;
  grab.force_limit = 1e4;
  grab.target += Vec3(0.02, 0.0, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(8.0);
  ASSERT_EQ(rig.forest.reactions().size(), 1u);
  const Reaction& reaction = rig.forest.reactions()[0];
  const JointAngles q = rig.angles(rig.now())[0];
  EXPECT_EQ(reaction.grab, id);
  EXPECT_FALSE(reaction.limited);
  EXPECT_NEAR(-reaction.force.x(), k * q.second / lever, 0.01 * k * q.second / lever);
  EXPECT_NEAR(reaction.force.x(), 1e5 * (rig.tip(0).x() - grab.target.x()), 0.05);
  const double force = -reaction.force.x();
  rig.forest.release(id);
  Push push;
  push.point = grab.point;
  push.force = Vec3(force, 0.0, 0.0);
  push.until = rig.now() + seconds(10);
  rig.forest.push(push);
  rig.run(9.0);
  EXPECT_NEAR(rig.angles(rig.now())[0].second, q.second, 0.01 * q.second);
}

// Returns a grab of the pole, 1 m from its joint, by a jaw.
Grab grabByJaw(const PhysicsRig& rig, double stiffness, double force_limit, double jaw_length) {
  Grab out = rig.grabOf(0);
  out.point.along = 1.0;
  out.target = rig.pointOn(out.point);
  out.stiffness = stiffness;
  out.force_limit = force_limit;
  out.jaw_length = jaw_length;
  return out;
}

// N3: a jaw that turns by 0.3 rad about the pole that it holds bends it to where the joint balances
// the two springs: k q = K (l / 2)^2 sin(0.3 - q) - K r^2 sin q, for a jaw of length l that holds
// the pole r from the joint. A point that turns bends nothing.
TEST(Interaction, AJawThatTurnsBendsTheBranch) {
  for (const double jaw : {0.0, 0.4}) {
    PhysicsRig rig = poleRig();
    const double k = jointStiffness(rig.branches()[0], rig.forest.layout().species[0]), turn = 0.3;
    const double spring = 2000.0;
    Grab grab = grabByJaw(rig, spring, 1e5, jaw);
    grab.frame = "jaw";
    const std::uint32_t id = rig.forest.addGrab(grab);
    Pose holder;
    const SinCos half = sinCos(0.5 * turn);
    holder.orientation = Quat{half.cos, 0.0, half.sin, 0.0};
    rig.forest.moveGrab(id, grab.target, holder);
    rig.run(8.0);
    const double turning = spring * 0.25 * jaw * jaw,
                 holding = spring * grab.point.along * grab.point.along;
    double q = 0.0;
    for (int i = 0; i < 50; ++i)
      q -= (k * q + holding * std::sin(q) - turning * std::sin(turn - q)) /
           (k + holding * std::cos(q) + turning * std::cos(turn - q));
    const Reaction& reaction = rig.forest.reactions().at(0);
    const double torque = turning * std::sin(turn - q);
    EXPECT_NEAR(rig.angles(rig.now())[0].second, q, 1e-4 * turn) << jaw;
    EXPECT_NEAR(-reaction.torque.y(), torque, 1e-3 * turning + 1e-9) << jaw;
    EXPECT_FALSE(reaction.limited);
    EXPECT_EQ(q > 3e-3, jaw > 0.0);
  }
}

// N3: the torque of a jaw that opens falls at the rate of the force, at a lever of 0.1 m, to a
// final zero, even if no force goes with it.
TEST(Interaction, TorqueOfAJawFallsAfterARelease) {
  PhysicsSettings settings;
  settings.contact.force_rate = 600.0;
  PhysicsRig rig = poleRig();
  rig.forest.setPhysics(settings);
  Grab grab = grabByJaw(rig, 1e5, 1e4, 0.4);
  const SinCos half = sinCos(0.1);
  grab.direction = axisZ(Quat{half.cos, 0.0, half.sin, 0.0});
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(4.0);
  const Reaction held = rig.forest.reactions().at(0);
  const double most = 600.0 / TICK_RATE * 0.1;
  ASSERT_GT(length(held.torque), 10.0 * most);
  rig.forest.release(id);
  double last = length(held.torque);
  int published = 0;
  for (rig.advance(); !rig.forest.reactions().empty(); rig.advance(), ++published) {
    const double now = length(rig.forest.reactions()[0].torque);
    EXPECT_LE(last - now, most * (1.0 + 1e-6));
    last = now;
  }
  EXPECT_GT(published, 10);
  EXPECT_EQ(last, 0.0);
}

// N3: beyond its limit each end of a jaw pulls with half of the force limit.
TEST(Interaction, AJawKeepsToItsForceLimit) {
  PhysicsRig rig = poleRig();
  Grab grab = grabByJaw(rig, 1e6, 10.0, 0.4);
  grab.direction = Vec3::UnitX();  // a quarter turn
  rig.forest.addGrab(grab);
  rig.run(8.0);
  const Reaction& reaction = rig.forest.reactions().at(0);
  EXPECT_TRUE(reaction.limited);
  EXPECT_LE(length(reaction.torque), 10.0 * 0.2 * (1.0 + 1e-9));
  EXPECT_GT(length(reaction.torque), 1.0);
}

// N3: a push gives force times duration, however short and wherever its ends lie between steps.
TEST(Interaction, APushGivesItsImpulse) {
  const auto peak = [](double duration, Nanoseconds late) {
    PhysicsRig rig = poleRig();
    Push push;
    push.point = {0, 0, 2.0};
    push.force = Vec3(0.2 / duration, 0.0, 0.0);
    push.from = rig.now() + late;
    push.until = push.from + seconds(duration);
    rig.forest.push(push);
    double out = 0.0;
    rig.run(1.0, [&] { out = std::max(out, difference(rig.angles(rig.now())[0], {})); });
    return out;
  };
  const double shortest = peak(0.001, 0);
  EXPECT_GT(shortest, 1e-3);
  for (const double duration : {0.001, 0.0041, 0.0123, 0.025})
    for (const Nanoseconds late : {0LL, 3000000LL, 77000000LL})
      EXPECT_NEAR(peak(duration, late), shortest, 0.02 * shortest) << duration << " " << late;
}

// N3: a push has no effect before its start or after its end.
TEST(Interaction, APushKeepsToItsTime) {
  PhysicsRig rig = poleRig();
  Push push;
  push.point = {0, 0, 2.0};
  push.force = Vec3(5.0, 0.0, 0.0);
  push.from = rig.now() + 10 * (rig.grid.timeOf(rig.tick + 1) - rig.now());
  push.until = push.from + seconds(0.5);
  rig.forest.push(push);
  while (rig.now() <= push.from) {
    EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
    EXPECT_EQ(difference(rig.angles(rig.now())[0], {}), 0.0);
    rig.advance();
  }
  EXPECT_GT(difference(rig.angles(rig.now())[0], {}), 0.0);
  while (rig.now() < push.until) rig.advance();
  rig.advance();
  EXPECT_TRUE(std::all_of(rig.forest.snapshot().physics.subtrees().begin(),
                          rig.forest.snapshot().physics.subtrees().end(), [](const auto& entry) {
                            return !entry.second.joints().empty() &&
                                   !entry.second.joints()[0].wanted;
                          }));
}

// S1-44, S1-27: the effects of wind and grab add up, E17.
TEST(Interaction, WindAndForceAddUp) {
  const auto bend = [](double wind, double force) {
    PhysicsRig rig = poleRig();
    rig.forest.setWind(wind::Field({makeDisk(1, Vec3(0, 0, 0), 1000.0, Vec3(wind, 0, 0))}));
    Push push;
    push.point = {0, 0, 1.0};
    push.force = Vec3(0.0, force, 0.0);
    push.until = rig.now() + seconds(10);
    rig.forest.push(push);
    std::vector<JointAngles> out;
    rig.run(3.0, [&] { out.push_back(rig.angles(rig.now())[0]); });
    return out;
  };
  const auto wind = bend(3.0, 0.0), force = bend(0.0, 2.0), both = bend(3.0, 2.0);
  double largest = 0.0, error = 0.0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    const JointAngles sum{wind[i].first + force[i].first, wind[i].second + force[i].second};
    largest = std::max({largest, std::fabs(wind[i].second), std::fabs(force[i].first)});
    error = std::max(error, difference(sum, both[i]));
  }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(error, 0.01 * largest);  // the joint is linear, its geometry not quite
}

// S1-42: physical branches return to rest after the gust.
TEST(Interaction, PhysicalBranchesReturnToRestAfterAGust) {
  PhysicsRig rig(byDepth());
  rig.forest.setWind(steadyWind(Vec3(6, 2, 0), 3.0));
  rig.touch(rig.twig(), 60.0);
  rig.run(2.0);
  double bent = 0.0;
  for (const PromotedBranch& b : rig.forest.promoted(0).branches)
    bent = std::max(bent, difference(b.q, {}));
  rig.forest.setWind(wind::Field());
  rig.run(15.0);
  double left = 0.0;
  for (const PromotedBranch& b : rig.forest.promoted(0).branches)
    left = std::max(left, difference(b.q, {}));
  EXPECT_EQ(rig.forest.physicsFigures().branches, rig.branches().size());
  EXPECT_GT(bent, 0.01);
  EXPECT_LT(left, 1e-3 * bent);
}

// S1-43: the paper's rule.
TEST(Interaction, DepthRuleMakesAllUpToTheGrabbedDepthPhysical) {
  PhysicsRig rig(byDepth());
  rig.forest.addGrab(rig.grabOf(rig.branchOfDepth(2)));
  rig.run(0.1);
  std::size_t expected = 0;
  for (const Branch& b : rig.branches()) expected += b.depth <= 2 ? 1 : 0;
  EXPECT_EQ(rig.forest.physicsFigures().branches, expected);
  for (const PromotedBranch& b : rig.forest.promoted(0).branches)
    EXPECT_LE(rig.branches()[b.branch].depth, 2);
}

// S1-W3, S1-W7: a light touch makes only the named branch physical.
TEST(Interaction, OnlyWhatIsNamedIsPhysical) {
  PhysicsRig rig;
  const int a = rig.twig(), b = rig.branchOfDepth(2);
  rig.touch(a, 1.0);
  rig.touch(b, 1.0);
  rig.run(0.2);
  const auto promoted = rig.forest.promoted(0).branches;
  ASSERT_EQ(promoted.size(), 2u);
  EXPECT_EQ(promoted[0].branch, std::min(a, b));
  EXPECT_EQ(promoted[1].branch, std::max(a, b));
}

// S1-W7, S1-W8: the influence grows with the load while it is held.
TEST(Interaction, TwigLoadLeavesTheTrunkAloneHeavyLoadTakesIt) {
  const auto takesTrunk = [](double newton) {
    PhysicsRig rig;
    Push push;
    push.point = {0, rig.branchOfDepth(1), 0.1};
    push.force = Vec3(0, newton, 0);
    push.until = rig.now() + seconds(1);
    rig.forest.push(push);
    rig.run(0.5);
    return rig.forest.promoted(0).branches.front().branch == 0;
  };
  EXPECT_FALSE(takesTrunk(0.5));
  EXPECT_TRUE(takesTrunk(2000.0));
}

// S1-39: bottom physical, middle procedural, top fixed.
TEST(Interaction, ThreeBandsInOneTree) {
  PhysicsRig rig(byDepth());
  Settings settings = PhysicsRig::makeSettings();
  settings.fixed_level = 3;
  rig.forest.setSettings(settings);
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  rig.run(2.0);
  rig.touch(rig.branchOfDepth(1), 5.0);
  rig.run(0.7);
  const auto angles = rig.angles(rig.now()), procedural = rig.procedural(rig.now());
  ASSERT_GT(rig.tree.skeleton.depths(), 3);
  bool moved = false;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const int depth = rig.branches()[i].depth;
    const bool physical = i < rig.forest.snapshot().physics.subtrees().at(0).mask().size() &&
                          rig.forest.snapshot().physics.subtrees().at(0).mask()[i];
    EXPECT_EQ(physical, depth <= 1);
    if (depth < 2) continue;
    EXPECT_EQ(difference(angles[i], depth == 2 ? procedural[i] : JointAngles()), 0.0);
    moved = moved || difference(angles[i], {}) > 1e-4;
  }
  EXPECT_TRUE(moved);
}

// S1-35: a physical twig follows the motion of its procedural parent when the wind acts on the
// parent only.
TEST(Interaction, PhysicalChildOfAProceduralParentFeelsItMove) {
  PhysicsRig rig;
  const int twig = rig.twig(), parent = rig.branches()[twig].parent;
  const Vec3 at = rig.branches()[parent].rest.position, own = rig.branches()[twig].rest.position;
  const double reach = 0.9 * length(Vec3(at.x() - own.x(), at.y() - own.y(), 0.0));
  wind::Primitive disk = makeDisk(1, at, reach, Vec3(8, 8, 0));
  disk.omega = 12.0;
  disk.epoch = PHYSICS_START;
  rig.forest.setWind(wind::Field({disk}));
  rig.touch(twig, 5.0);
  double parent_moves = 0.0, twig_moves = 0.0;
  rig.run(2.0, [&] {
    const auto angles = rig.angles(rig.now());
    parent_moves = std::max(parent_moves, difference(angles[parent], {}));
    twig_moves = std::max(twig_moves, difference(angles[twig], {}));
    EXPECT_EQ(difference(rig.procedural(rig.now())[twig], {}), 0.0);
  });
  EXPECT_EQ(rig.forest.physicsFigures().branches, 1u);
  EXPECT_GT(parent_moves, 1e-3);
  EXPECT_GT(twig_moves, 1e-3 * parent_moves);
}

// S1-35, the reverse: procedural wood follows its physical parent and bends as before.
TEST(Interaction, ProceduralChildrenOfAPhysicalParentRideOnIt) {
  PhysicsRig rig;
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  const int limb = rig.branchOfDepth(1);
  Grab grab = rig.grabOf(limb);
  grab.target += Vec3(0.2, 0.2, 0.0);
  rig.forest.addGrab(grab);
  rig.run(1.0);
  const auto poses = rig.forest.pose(rig.tree, 0, rig.now());
  const auto procedural = rig.procedural(rig.now());
  const auto& mask = rig.forest.snapshot().physics.subtrees().at(0).mask();
  int riders = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Branch& b = rig.branches()[i];
    if (mask[i] || b.parent < 0 || !mask[static_cast<std::size_t>(b.parent)]) continue;
    ++riders;
    const Pose& parent = poses[static_cast<std::size_t>(b.parent)];
    const Quat turn = parent.orientation * jointRotation(b, procedural[i], JointModel::SWING);
    EXPECT_LT(length(poses[i].position - parent.position - b.h * axisZ(parent.orientation)), 1e-12);
    EXPECT_LT(length(axisX(poses[i].orientation) - axisX(turn)), 1e-12);
  }
  EXPECT_GT(riders, 0);
}

// A spring of 5 kN/m with a limit of 3 N: a light twig pulled from 4 m away stays calm.
TEST(Interaction, ForceIsLimitedAndReported) {
  PhysicsRig rig;
  Grab grab = rig.grabOf(rig.twig());
  grab.stiffness = 5000.0;
  grab.damping = 20.0;
  grab.force_limit = 3.0;
  grab.target += Vec3(4.0, 0.0, 1.0);
  rig.forest.addGrab(grab);
  double fastest = 0.0;
  rig.run(5.0, [&] {
    ASSERT_EQ(rig.forest.reactions().size(), 1u);
    EXPECT_LE(length(rig.forest.reactions()[0].force), 3.0 * (1.0 + 1e-9));
    for (const PromotedBranch& b : rig.forest.promoted(0).branches)
      fastest = std::max(fastest, difference(b.rate, {}));
  });
  EXPECT_TRUE(rig.forest.reactions()[0].limited);
  EXPECT_EQ(rig.forest.physicsFigures().capped_forces, 1u);
  EXPECT_LT(fastest, 200.0);
  const double still = difference(rig.forest.promoted(0).branches.back().rate, {});
  EXPECT_LT(still, 0.5);
}

TEST(Interaction, LeaseEndsAGrabThatIsNotRenewed) {
  PhysicsRig rig;
  Grab grab = rig.grabOf(rig.twig());
  grab.lease = 0.5;
  const std::uint32_t silent = rig.forest.addGrab(grab), alive = rig.forest.addGrab(grab);
  std::vector<std::uint32_t> ended;
  rig.run(2.0, [&] {
    rig.forest.renewGrab(alive);
    for (const Grab& g : rig.forest.ended()) ended.push_back(g.id);
  });
  EXPECT_EQ(ended, std::vector<std::uint32_t>{silent});
  EXPECT_EQ(rig.forest.grabs().count(alive), 1u);
  rig.run(10.0);
  EXPECT_TRUE(rig.forest.grabs().empty());
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
}

// N3: the reaction on a gripper that opens falls at the stated rate to a final zero.
TEST(Interaction, WrenchFallsAfterAReleaseAndEndsAtZero) {
  PhysicsSettings settings;
  settings.contact.force_rate = 600.0;
  PhysicsRig rig(settings);
  Grab grab = rig.grabOf(rig.branchOfDepth(1));
  grab.target += Vec3(0.2, 0.1, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(2.0);
  double last = length(rig.forest.reactions().at(0).force);
  const double most = 600.0 / TICK_RATE;
  ASSERT_GT(last, 3.0 * most);
  rig.forest.release(id);
  int published = 0;
  for (rig.advance(); !rig.forest.reactions().empty(); rig.advance(), ++published) {
    ASSERT_EQ(rig.forest.reactions().size(), 1u);
    EXPECT_EQ(rig.forest.reactions()[0].grab, id);
    const double now = length(rig.forest.reactions()[0].force);
    EXPECT_NEAR(now, std::max(0.0, last - most), 1e-6 * most);  // a tick is whole nanoseconds
    last = now;
  }
  EXPECT_GT(published, 3);
  EXPECT_EQ(last, 0.0);
}

TEST(Interaction, SeveralGrabsHoldOneTree) {
  PhysicsRig rig;
  Grab a = rig.grabOf(rig.branchOfDepth(1)), b = rig.grabOf(0);
  b.point.branch = 3;
  b.point.along = 0.1;
  b.target = rig.pointOn(b.point);
  a.target += Vec3(0.1, 0.0, 0.0);
  b.target += Vec3(0.0, 0.02, 0.0);
  a.frame = "left";
  b.frame = "right";
  const std::uint32_t first = rig.forest.addGrab(a), second = rig.forest.addGrab(b);
  rig.run(3.0);
  ASSERT_EQ(rig.forest.reactions().size(), 2u);
  EXPECT_LT(rig.forest.reactions()[0].force.x(), -0.1);
  EXPECT_LT(rig.forest.reactions()[1].force.y(), -0.1);
  EXPECT_EQ(rig.forest.reactions()[1].frame, "right");
  rig.forest.release(first);
  rig.run(0.1);
  ASSERT_EQ(rig.forest.reactions().size(), 1u);
  EXPECT_EQ(rig.forest.reactions()[0].grab, second);
}

// A held point follows its target, and so does a moved one.
TEST(Interaction, HeldPointFollowsItsTarget) {
  PhysicsRig rig;
  Grab grab = rig.grabOf(rig.twig());
  grab.stiffness = 1e5;
  grab.force_limit = 1e4;
  const std::uint32_t id = rig.forest.addGrab(grab);
  double farthest = 0.0;
  rig.run(2.0, [&] {
    farthest = std::max(farthest, length(rig.pointOn(grab.point) - grab.target));
    grab.target += Vec3(0.0, 0.15, -0.05) / (2.0 * TICK_RATE);
    rig.forest.moveGrab(id, grab.target);
  });
  EXPECT_LT(farthest, 0.01);
}

TEST(Interaction, RefusedRequestsSayWhyAndChangeNothing) {
  PhysicsRig rig;
  rig.forest.addGrab(rig.grabOf(rig.twig()));
  rig.advance();
  const std::uint64_t hash = rig.forest.hash();
  const auto refused = [&](const std::function<void(Grab&)>& change) {
    Grab grab = rig.grabOf(rig.twig());
    change(grab);
    return errorOf([&] { rig.forest.addGrab(grab); });
  };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  };
  has(refused([](Grab& g) { g.point.tree = 7; }), "grab: tree = 7 is unknown, allowed are 0 to 0");
  has(refused([](Grab& g) { g.point.branch = -1; }), "grab: branch = -1 is unknown, allowed are 0");
  has(refused([](Grab& g) { g.point.branch = 99999; }), "grab: branch = 99999 is unknown");
  has(refused([](Grab& g) { g.point.along = 9.0; }), "grab: along = 9 m is outside 0 to ");
  has(refused([](Grab& g) { g.target.x() += 1000.0; }), "grab: distance of target from the tree");
  has(refused([](Grab& g) { g.target.y() = NAN; }), "grab: target.y = nan");
  has(refused([](Grab& g) { g.stiffness = -1.0; }), "grab: stiffness = -1 N/m is outside 1 to");
  has(refused([](Grab& g) { g.force_limit = INFINITY; }), "grab: force_limit = inf");
  has(refused([](Grab& g) { g.jaw_length = -0.1; }), "grab: jaw_length = -0.1 m is outside 0 to 1");
  has(refused([](Grab& g) { g.jaw_length = NAN; }), "grab: jaw_length = nan");
  has(refused([](Grab& g) { g.direction.z() = NAN; }), "grab: direction.z = nan");
  has(refused([](Grab& g) { g.direction *= 0.5; }), "grab: length of direction = 0.5");
  has(refused([](Grab& g) {
        g.holder.orientation = {0.0, 0.0, 0.0, 0.0};
      }),
      "grab: holder.orientation's norm = 0 is outside 0.999 to 1.001");
  const std::string all = refused([](Grab& g) { g.damping = -1.0, g.lease = -2.0; });
  has(all, "damping = -1");
  has(all, "lease = -2");
  has(errorOf([&] { rig.forest.moveGrab(77, Vec3::Zero()); }), "grab: id = 77 is unknown");
  has(errorOf([&] { rig.forest.moveGrab(1, Vec3(0, NAN, 0)); }), "target.y = nan");
  Pose nowhere;
  nowhere.position.z() = NAN;
  nowhere.orientation.w = NAN;
  const std::string holder = errorOf([&] {
    rig.forest.moveGrab(1, rig.pointOn({0, rig.twig(), 0.0}), nowhere);
  });
  has(holder, "grab: holder.position.z = nan");
  has(holder, "grab: holder.orientation's norm = nan");
  has(errorOf([&] { rig.forest.release(77); }), "grab: id = 77 is unknown");
  has(errorOf([&] { rig.forest.removeBody("arm"); }), "body 'arm' is unknown");
  PhysicsSettings wrong;
  wrong.blend = -1.0;
  wrong.integrator = static_cast<physics::Integrator>(9);
  has(errorOf([&] { rig.forest.setPhysics(wrong); }), "physics: blend = -1 s is outside");
  EXPECT_EQ(rig.forest.hash(), hash);
}

// N12: the cap holds for any request, and a refused request gets an error.
TEST(Interaction, CapHoldsAndIsReported) {
  PhysicsSettings settings = byDepth();
  settings.most_branches = 10;
  PhysicsRig rig(settings);
  rig.forest.addGrab(rig.grabOf(rig.twig()));
  rig.run(0.2);
  EXPECT_EQ(rig.forest.physicsFigures().branches, 10u);
  EXPECT_EQ(rig.forest.physicsFigures().refused, rig.branches().size() - 10);
  EXPECT_TRUE(rig.forest.snapshot().physics.subtrees().at(0).holds(rig.twig()));
  EXPECT_NE(errorOf([&] {
              rig.forest.addGrab(rig.grabOf(rig.twig() - 1));
            }).find("most_branches = 10 are physical already"),
            std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::forest
