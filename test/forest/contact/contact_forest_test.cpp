// Bodies among the trees of a forest, from promotion to the end of the last blend.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "heap.h"
#include "scenes/forest/contact_scene.h"

namespace vegetation_sim::forest {
namespace {

// S1-W6, N12: only near branches are physical, thin wood is not penetrated, and after the drive and
// the blend nothing is held.
TEST(ContactInAForest, BranchesGoAsideAndAllReturns) {
  for (const double speed : {0.5, 3.0}) {
    Drive drive(speed);
    double deepest = 0.0;
    std::size_t most = 0, reactions = 0;
    for (int i = 0; i < 1.3 / speed * TICKS; ++i) {
      drive.driveOn();
      deepest = std::max(deepest, drive.depth());
      most = std::max(most, drive.forest().physicsFigures().branches);
      reactions += drive.forest().reactions().size();
    }
    EXPECT_LT(deepest, 0.005) << speed << " m/s";
    EXPECT_GT(reactions, 10u) << speed << " m/s";
    EXPECT_GT(most, 10u);
    EXPECT_LT(most, 668u);  // of the whole tree
    drive.forest().removeBody("arm");
    for (int i = 0; i < 8 * TICKS; ++i) drive.tick();
    EXPECT_EQ(drive.forest().physicsFigures().branches, 0u) << speed << " m/s";
    EXPECT_TRUE(drive.forest().reactions().empty());
  }
}

// N12: bodies that touch one branch after the other never exceed the cap, and released branches
// make room.
TEST(ContactInAForest, CapHoldsAlongTheWholeDrive) {
  PhysicsSettings settings;
  settings.most_branches = 20;
  settings.linger = 0.2;
  settings.blend = 0.2;
  Drive drive(0.5);
  drive.forest().setPhysics(settings);
  std::size_t most = 0, refused = 0;
  std::set<int> met;
  for (int i = 0; i < 2.6 * TICKS; ++i) {
    drive.driveOn();
    most = std::max(most, drive.forest().physicsFigures().branches);
    refused = std::max(refused, drive.forest().physicsFigures().refused);
    for (const PromotedBranch& b : drive.forest().promoted(0).branches) met.insert(b.branch);
  }
  EXPECT_EQ(most, 20u);
  EXPECT_GT(refused, 0u);
  EXPECT_GT(met.size(), 20u);
  for (int i = 0; i < 8 * TICKS; ++i) drive.tick();
  EXPECT_EQ(drive.forest().physicsFigures().refused, 0u);
  EXPECT_TRUE(drive.forest().snapshot().physics.subtrees().empty());
}

TEST(ContactInAForest, ReactionsTellBodyPlaceAndForce) {
  Drive drive(0.5);
  const Reaction* found = nullptr;
  for (int i = 0; i < 200 && !found; ++i) {
    drive.driveOn();
    for (const Reaction& reaction : drive.forest().reactions())
      if (length(reaction.force) > 1.0) found = &reaction;
  }
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Reaction::CONTACT);
  EXPECT_EQ(found->body, "arm");
  EXPECT_EQ(found->frame, "arm_link");
  EXPECT_EQ(found->grab, 0u);
  EXPECT_EQ(found->at.tree, 0u);
  EXPECT_LT(found->force.x(), 0.0);  // against the drive
  EXPECT_FALSE(found->limited);
}

// An impact takes a bounded number of substeps with any law: excess requests are counted. The
// default law has none.
TEST(ContactInAForest, BisectionsAreBounded) {
  for (const double stiffness : {5e5, 1e8}) {
    Drive drive(3.0);
    ContactRecorder recorder;
    drive.forest().setContactFinder(recorder.makeFinder());
    PhysicsSettings settings = drive.forest().physicsSettings();
    settings.contact.stiffness = stiffness;
    settings.contact.force_limit = 100.0;
    if (stiffness > 1e6) drive.forest().setPhysics(settings);
    int most = 0;
    std::size_t steps = 1;
    for (int i = 0; i < 26; ++i) {
      const int before = recorder.searches;
      drive.driveOn();
      most = std::max(most, recorder.searches - before);
      steps = std::max(steps, drive.forest().physicsFigures().steps);
    }
    EXPECT_LE(static_cast<std::size_t>(most), steps * (2 * SubstepBisection::MAX_COUNT + 4));
    EXPECT_EQ(drive.forest().physicsFigures().coarse > 0, stiffness > 1e6) << most;
    EXPECT_LT(drive.depth(), 0.005) << stiffness;
  }
}

template <typename Scene>
ContactRecorder expectImpulseIsReported(Scene& scene, int ticks) {
  ContactRecorder recorder;
  scene.forest().setContactFinder(recorder.makeFinder());
  Vec3 published = Vec3::Zero();
  for (int i = 0; i < ticks; ++i) {
    scene.driveOn();
    for (const Reaction& reaction : scene.forest().reactions()) published += reaction.force / TICKS;
  }
  EXPECT_GT(length(recorder.impulse), 1.0);
  EXPECT_LT(length(published + recorder.impulse), 1e-5 * recorder.size);
  return recorder;
}

// N3. Published wrenches carry the impulse on the trees, whatever the substeps.
// (dynamics/contact_test: the wood gains the momentum of the reported force.)
TEST(ContactInAForest, WrenchesCarryTheImpulseThatTheTreeGets) {
  Drive twigs(3.0);
  EXPECT_LT(expectImpulseIsReported(twigs, 26).shortest, 0.6 / 240.0);  // substeps
  Ram trunk(3.0, TICKS);
  EXPECT_LT(expectImpulseIsReported(trunk, 2).shortest, 0.2 / 240.0);  // bisected substeps
}

// A repeated substep leaves no trace: displacements agree with velocities between substeps.
TEST(ContactInAForest, NothingOfAPartThatIsTakenAgainIsLeft) {
  Ram ram(3.0, TICKS, 0.95);
  ContactRecorder recorder;
  ram.forest().setContactFinder(recorder.makeFinder());
  for (int i = 0; i < 2; ++i) ram.driveOn();
  EXPECT_LT(recorder.shortest, 0.2 / 240.0);
  EXPECT_GT(recorder.farthest, 5e-4);
  EXPECT_LT(recorder.leap, 0.05 * recorder.farthest);
  EXPECT_GT(recorder.repeated, 3);
  EXPECT_EQ(recorder.inconsistent, 0);
}

// Wrenches tick by tick: the force of a trunk rises over several ticks that are no shorter than
// substeps, as the law says, up to its limit; it falls at no more than the law's rate when the body
// has passed the trunk.
TEST(ContactInAForest, WrenchesRiseAndFallAsTheLawSays) {
  const physics::ContactLaw law;
  for (const auto& [speed, ticks] : {std::pair(0.1, 240), {1.0, 1920}, {3.0, 3840}}) {
    Ram ram(speed, ticks);
    double before = 0.0, rise = 0.0, fall = 0.0, hardest = 0.0;
    int rising = 0, falling = 0;
    for (int tick = 1; tick < 0.02 / speed * ticks + 20 || before > 0.0; ++tick) {
      ASSERT_LT(tick, 2.0 / speed * ticks) << speed << " m/s";  // it is through the trunk by then
      ram.driveOn();
      double force = 0.0;
      for (const Reaction& reaction : ram.forest().reactions())
        if (reaction.at.branch == 0) force = length(reaction.force);
      rise = std::max(rise, force - before);
      fall = std::max(fall, before - force);
      rising += force > before;
      falling += force < before;
      hardest = std::max(hardest, force);
      before = force;
    }
    EXPECT_LE(rise, (law.force_rate + law.stiffness * (speed + 0.02)) / ticks) << speed << " m/s";
    EXPECT_NEAR(hardest, law.force_limit, 1.0) << speed << " m/s";
    EXPECT_LE(fall, law.force_rate / ticks * (1.0 + 1e-5)) << speed << " m/s";
    EXPECT_GE(rising, 4) << speed << " m/s";
    EXPECT_GE(falling, 4) << speed << " m/s";
    std::printf("%.1f m/s, ticks of 1/%d s: rises %.0f N, falls %.0f N\n", speed, ticks, rise,
                fall);
  }
}

TEST(ContactInAForest, SavedInTheMiddleItGoesOnTheSame) {
  Drive one(1.0), other(1.0);
  for (int i = 0; i < 30; ++i) one.driveOn(), other.driveOn();
  other.forest().restore(one.forest().snapshot());
  for (int i = 0; i < 30; ++i) one.driveOn(), other.driveOn();
  EXPECT_GT(one.forest().physicsFigures().branches, 0u);
  EXPECT_EQ(one.forest().hash(), other.forest().hash());
}

TEST(ContactInAForest, BodyFarAwayWakesNoTree) {
  Drive drive(0.5);
  Body far = drive.body();
  far.pose.position = Vec3(40.0, 0.0, 1.0);
  drive.forest().setBody(far);
  for (int i = 0; i < 10; ++i) drive.tick();
  EXPECT_TRUE(drive.forest().physicalTrees().empty());
}

// N12: a tree near a body is cached and counted until the first tick without a near body.
TEST(ContactInAForest, TreesAreAtHandOnlyWhileABodyIsNear) {
  Drive drive(0.0, Vec3(-4.0, 0.0, 2.0));  // touches nothing
  Forest& forest = drive.forest();
  drive.tick();
  const long before = liveBytes();
  const auto expectHeld = [&](bool held, const char* when) {
    const auto published = static_cast<long>(forest.physicsFigures().bytes);
    const long taken = liveBytes() - before;
    EXPECT_EQ(published > 0, held) << when;
    EXPECT_LE(published, taken) << when;
    EXPECT_EQ(taken > 1000, held) << when << ": " << taken << " bytes";
    EXPECT_GT(1.1 * published + 1000.0, taken) << when;
  };
  const auto show = [&](double x) {
    Body body = drive.body();
    body.pose.position.x() = x;
    forest.setBody(body);
    drive.tick();
    EXPECT_TRUE(forest.physicalTrees().empty());
  };
  for (int turn = 0; turn < 2; ++turn) {
    show(-4.0);
    expectHeld(true, "near");
    show(-100.0);
    expectHeld(false, "far");
    show(-4.0);
    forest.removeBody("arm");
    drive.tick();
    expectHeld(false, "gone");
  }
}

TEST(ContactInAForest, TreesNearABallAreFoundInTilesToo) {
  Layout layout = gridLayout(4, 40.0);
  Tile tile;
  tile.first_tree = 16;
  tile.count = 50;
  tile.x = tile.y = 500.0;
  tile.size = 100.0;
  tile.mix = {1.0f, 1.0f, 1.0f, 1.0f};
  layout.tiles = {tile};
  const terrain::HeightMap flat;
  EXPECT_TRUE(findTreesNear(layout, flat, Vec3(-300.0, 0.0, 0.0), 1.0).empty());
  const auto near = findTreesNear(layout, flat, Vec3(40.0, 40.0, 1.0), 1.0);
  EXPECT_TRUE(std::count(near.begin(), near.end(), 5u));
  const Vec3 foot = footOf(seedInTile(tile, 17), flat);
  const auto tiled = findTreesNear(layout, flat, foot, 1.0);
  EXPECT_TRUE(std::count(tiled.begin(), tiled.end(), 33u));
  EXPECT_TRUE(std::is_sorted(tiled.begin(), tiled.end()));
}

}  // namespace
}  // namespace vegetation_sim::forest
