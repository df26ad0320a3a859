// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Tests that the wrenches of bodies and grippers are published in their own frame, for any position
// and orientation of the frame.
#include "nodes/forest/grab_manager.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error_text.h"
#include "ros/conversions/grab_conversions.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr int RATE = 60;  // [Hz]

/// Returns a rotation about the axis (1, 2, 2) / 3 by 1 rad, which maps no axis of a frame to
/// another axis.
Quat turned() {
  const SinCos half = sinCos(0.5);
  return {half.cos, half.sin / 3.0, 2.0 * half.sin / 3.0, 2.0 * half.sin / 3.0};
}

/// An oak in still air, a grab manager and a tf buffer.
class GrabManagerRig {
 public:
  GrabManagerRig() : forest_(layout(), forest::flatTerrain(), forest::Settings()) {
    tree_ = forest::growTree(forest_.layout(), 0, forest_.terrain());
    forest_.advance(now());
  }
  static forest::Layout layout() {
    forest::Layout out;
    out.species = {forest::shippedSpecies("oak")};
    forest::TreeSeed seed;
    seed.seed = 4;
    out.trees = {seed};
    return out;
  }
  Nanoseconds now() const { return TickGrid(RATE).timeOf(tick_); }
  const forest::Forest& forest() const { return forest_; }
  const forest::Branch& branch(int i) const {
    return tree_.skeleton.branches[static_cast<std::size_t>(i)];
  }
  Vec3 pointOn(int i, double along) const {
    const Pose pose = forest_.pose(tree_, 0, now())[static_cast<std::size_t>(i)];
    return tree_.foot + pose.position + along * axisZ(pose.orientation);
  }

  /// Sets the transform of a frame at the next tick.
  void show(const std::string& frame, const Pose& pose) {
    geometry_msgs::TransformStamped out;
    out.header.frame_id = options_.frame_id;
    out.header.stamp = toStamp(TickGrid(RATE).timeOf(tick_ + 1));
    out.child_frame_id = frame;
    out.transform.translation = toVector(pose.position);
    const Quat& q = pose.orientation;
    out.transform.rotation.w = q.w, out.transform.rotation.x = q.x;
    out.transform.rotation.y = q.y, out.transform.rotation.z = q.z;
    tf_.setTransform(out, "test");
  }
  void report(forest::Body body, const Pose& in_frame) {
    ForestInput event;
    event.kind = ForestInput::BODY;
    event.body = body;
    event.body.in_frame = in_frame;
    inputs_.addFirst(event);
  }
  std::uint32_t grab(const Grab::Request& request) {
    Grab::Response response;
    grabs_manager_.grab(request, response);
    return response.id;
  }
  /// Same settings as in forest_animator.
  void tick() {
    ++tick_;
    grabs_manager_.follow(now(), [](const std::string& what, const std::string& why) {
      ADD_FAILURE() << what << ": " << why;
    });
    for (ForestInput& event : inputs_.take(now())) {
      grabs_manager_.followFrame(event);
      if (event.kind == ForestInput::GRAB) forest_.addGrab(event.grab);
      if (event.kind == ForestInput::MOVE)
        forest_.moveGrab(event.grab.id, event.grab.target, event.grab.holder);
      if (event.kind == ForestInput::BODY) forest_.setBody(event.body);
    }
    forest_.advance(now());
    grabs_manager_.update();
  }
  std::vector<ContactForce> forces() const { return grabs_manager_.forces().forces; }
  std::string releaseAll() {
    Release::Request request;
    request.all = true;
    return grabs_manager_.release(request);
  }
  ForestInputs& inputs() { return inputs_; }
  GrabManager::State state() const { return grabs_manager_.state(); }
  std::string errorAtTick(ForestInput event) {
    return errorOf([&] { grabs_manager_.followFrame(event); });
  }

 private:
  std::int64_t tick_{6000};
  ForestOptions options_;
  forest::Forest forest_;
  forest::Tree tree_;
  forest::TreeCache cache_{100000};
  ForestInputs inputs_{false};
  tf2_ros::Buffer tf_;
  GrabManager grabs_manager_{GrabDependencies{options_, forest_, cache_, inputs_, tf_}};
};

// Returns the components along the axes of a frame, computed with dot products.
Vec3 alongAxes(const Quat& frame, const Vec3& v) {
  return Vec3(dot(axisX(frame), v), dot(axisY(frame), v), dot(axisZ(frame), v));
}

// Returns a request by which the frame "hand" holds a branch for a minute.
Grab::Request requestOfHand(int branch, double along, double stiffness) {
  Grab::Request out;
  out.branch = static_cast<std::uint32_t>(branch);
  out.along = along;
  out.frame = "hand";
  out.has_stiffness = out.has_damping = out.has_force_limit = out.has_lease = true;
  out.stiffness = stiffness;
  out.damping = 200.0;
  out.force_limit = 1e4;
  out.lease = 60.0;
  return out;
}

// N3: a hand holds a limb 30 cm from its own origin in a rotated frame, moves aside and rotates. At
// rest its wrench balances the spring, both as a force and as a moment about the origin of the
// hand.
TEST(GrabManager, HandGetsForceAndTorqueInItsOwnFrame) {
  GrabManagerRig rig;
  const int limb = 46;
  const double along = 0.5 * rig.branch(limb).length, stiffness = 5000.0;
  const Pose start{rig.pointOn(limb, along) + Vec3(0.1, -0.2, 0.2), turned()};
  rig.show("hand", start);
  Grab::Request request = requestOfHand(limb, along, stiffness);
  request.keep_offset = true;
  const std::uint32_t id = rig.grab(request);
  const Vec3 in_hand = transformed(inverse(start), rig.pointOn(limb, along));
  Pose hand = start;
  for (int i = 0; i < 20 * RATE; ++i) {
    const double share = std::min(1.0, static_cast<double>(i) / RATE);
    const SinCos half = sinCos(0.2 * share);
    hand.position = start.position + share * Vec3(0.05, 0.1, -0.02);
    hand.orientation = Quat{half.cos, 0.0, half.sin, 0.0} * turned();
    rig.show("hand", hand);
    rig.tick();
  }
  const Vec3 held = rig.pointOn(limb, along), target = transformed(hand, in_hand);
  const Vec3 force = stiffness * (held - target);  // force on the hand
  const Vec3 torque = cross(held - hand.position, force);
  ASSERT_GT(length(force), 20.0);
  ASSERT_GT(length(torque), 5.0);
  ASSERT_EQ(rig.forces().size(), 1u);
  const ContactForce published = rig.forces()[0];
  EXPECT_EQ(published.frame, "hand");
  EXPECT_EQ(published.grab, id);
  EXPECT_EQ(published.body, "");
  EXPECT_EQ(published.branch, request.branch);
  EXPECT_EQ(published.along, along);
  EXPECT_LT(length(fromMsg(published.point) - held), 1e-6);
  EXPECT_LT(length(fromMsg(published.force) - force), 0.01 * length(force));
  // The margin covers the oscillation after 20 s and single precision.
  EXPECT_LT(length(fromMsg(published.wrench.force) - alongAxes(hand.orientation, force)),
            0.01 * length(force));
  EXPECT_LT(length(fromMsg(published.wrench.torque) - alongAxes(hand.orientation, torque)),
            0.01 * length(torque));
}

// A jaw keeps the direction that the limb has in the hand when the grab begins: a hand that turns
// in place bends the limb, and its wrench is the moment of the two springs.
TEST(GrabManager, JawTurnsTheLimbWithTheHand) {
  GrabManagerRig rig;
  const int limb = 46;
  const double along = 0.5 * rig.branch(limb).length, jaw = 0.3, stiffness = 5000.0;
  const Pose start{rig.pointOn(limb, along), turned()};
  rig.show("hand", start);
  Grab::Request request = requestOfHand(limb, along, stiffness);
  request.jaw_length = jaw;
  rig.grab(request);
  const auto axis = [&] {
    return Vec3((rig.pointOn(limb, along + 0.1) - rig.pointOn(limb, along - 0.1)) / 0.2);
  };
  const Vec3 in_hand = alongAxes(start.orientation, axis());
  Pose hand = start;
  for (int i = 0; i < 20 * RATE; ++i) {
    const SinCos half = sinCos(0.15 * std::min(1.0, static_cast<double>(i) / RATE));
    hand.orientation = Quat{half.cos, half.sin, 0.0, 0.0} * turned();
    rig.show("hand", hand);
    rig.tick();
  }
  const Vec3 held = rig.pointOn(limb, along), wanted = rotate(hand.orientation, in_hand);
  const Vec3 force = stiffness * (held - hand.position);  // on the hand
  const Vec3 couple = stiffness * 0.25 * jaw * jaw * cross(wanted, axis());
  const Vec3 torque = couple + cross(held - hand.position, force);
  ASSERT_GT(length(couple), 5.0);
  ASSERT_EQ(rig.forces().size(), 1u);
  EXPECT_LT(length(fromMsg(rig.forces()[0].wrench.torque) - alongAxes(hand.orientation, torque)),
            0.01 * length(torque));
  EXPECT_LT(length(fromMsg(rig.forces()[0].force) - force), 0.01 * length(couple) / jaw);
}

// A tree that has grown anew while a grab waited may have fewer branches.
TEST(GrabManager, JawOnABranchThatIsGoneIsRefused) {
  GrabManagerRig rig;
  ForestInput event;
  event.kind = ForestInput::GRAB;
  event.grab.point = {0, 99999, 0.1};
  event.grab.jaw_length = 0.1;
  EXPECT_NE(rig.errorAtTick(event).find("branch = 99999 is unknown"), std::string::npos);
}

// A number that is given counts, even if it is 0; the others have their defaults.
TEST(GrabManager, ZeroIsNotTheDefault) {
  GrabManagerRig rig;
  Grab::Request request;
  request.branch = 46;
  request.target.point = toPoint(rig.pointOn(46, 0.0));
  const std::uint32_t plain = rig.grab(request);
  request.has_damping = true;
  const std::uint32_t undamped = rig.grab(request);
  rig.tick();
  const auto& grabs = rig.forest().grabs();
  EXPECT_EQ(grabs.at(plain).damping, 40.0);
  EXPECT_EQ(grabs.at(plain).stiffness, 2000.0);
  EXPECT_EQ(grabs.at(undamped).damping, 0.0);
  EXPECT_EQ(grabs.at(undamped).stiffness, 2000.0);
}

// N3: a body moves and rotates, and its tf is late. The wrench of a tick is in the frame's pose at
// that tick, not in the last pose from tf.
TEST(GrabManager, BodyGetsItsWrenchInItsFrameOfTheTick) {
  constexpr double LATE = 0.1;  // [s]
  GrabManagerRig rig;
  const forest::Branch& trunk = rig.branch(0);
  const Pose in_frame{Vec3(0.3, -0.1, 0.2), turned()};
  forest::Body body;
  body.id = "palm";
  body.frame = "hand";
  body.shape = forest::Shape::SPHERE;
  body.size = Vec3(0.1, 0.0, 0.0);
  body.velocity = Vec3(0.5, 0.0, 0.0);
  body.spin = Vec3(0.0, 0.0, 2.0);
  const Vec3 start(-trunk.base_radius - 0.12, 0.02, 1.0);
  int published = 0;
  for (int i = 0; i < RATE / 2; ++i) {
    const double seen = static_cast<double>(i + 1) / RATE, known = seen - LATE;
    const auto at = [&](double time) -> Pose {
      const SinCos half = sinCos(0.5 * body.spin.z() * time);
      return {start + time * body.velocity, Quat{half.cos, 0.0, 0.0, half.sin} * turned()};
    };
    body.pose = at(known);
    body.stamp = rig.now() + fromSeconds(1.0 / RATE - LATE);
    rig.report(body, in_frame);
    rig.tick();
    const Pose frame = compose(at(seen), inverse(in_frame));
    const auto& reactions = rig.forest().reactions();
    const auto forces = rig.forces();
    ASSERT_EQ(forces.size(), reactions.size());
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const forest::Reaction& reaction = reactions[k];
      const Vec3 torque = cross(reaction.point - frame.position, reaction.force);
      const Vec3 force = alongAxes(frame.orientation, reaction.force);
      EXPECT_EQ(forces[k].frame, "hand");
      EXPECT_EQ(forces[k].grab, 0u);
      EXPECT_EQ(forces[k].body, "palm");
      EXPECT_EQ(fromMsg(forces[k].force), reaction.force);
      EXPECT_LT(length(fromMsg(forces[k].wrench.force) - force), 1e-6 * length(force) + 1e-9);
      EXPECT_LT(length(fromMsg(forces[k].wrench.torque) - alongAxes(frame.orientation, torque)),
                1e-6 * length(force) + 1e-9);
      published += length(force) > 100.0;
    }
  }
  EXPECT_GT(published, 5);
}

// A rejected request changes nothing.
TEST(GrabManager, AllGrabsAreReleasedOrNone) {
  GrabManagerRig rig;
  Grab::Request request;
  request.tree = 0;
  request.branch = 46;
  request.has_lease = true;
  request.lease = 60.0;
  for (int i = 0; i < 3; ++i) rig.grab(request);
  rig.tick();
  ASSERT_EQ(rig.forest().grabs().size(), 3u);
  rig.grab(request);  // waits for its tick
  ForestInput force;
  force.kind = ForestInput::FORCE;
  while (rig.inputs().room() > 2) rig.inputs().add(force);
  EXPECT_THROW(rig.releaseAll(), InvalidInput);
  EXPECT_EQ(rig.inputs().room(), 2u);
  rig.tick();
  EXPECT_EQ(rig.forest().grabs().size(), 4u);
  EXPECT_EQ(rig.releaseAll(), "4 released");
}

// A checkpoint may be written while the queue takes a grab: it needs the id and the request.
TEST(GrabManager, GrabIsKnownBeforeItWaits) {
  GrabManagerRig rig;
  std::vector<GrabManager::State> saved;
  rig.inputs().observe([&](const ForestInput&) { saved.push_back(rig.state()); });
  Grab::Request request;
  request.branch = 46;
  const std::uint32_t id = rig.grab(request);
  ASSERT_EQ(saved.size(), 1u);
  EXPECT_EQ(saved[0].last_id, id);
  EXPECT_EQ(saved[0].requests.count(id), 1u);
}

TEST(GrabManager, GrabThatFindsNoRoomIsForgotten) {
  GrabManagerRig rig;
  Grab::Request request;
  request.branch = 46;
  rig.grab(request);
  ForestInput force;
  force.kind = ForestInput::FORCE;
  while (rig.inputs().add(force)) continue;
  EXPECT_THROW(rig.grab(request), InvalidInput);
  EXPECT_EQ(rig.state().last_id, 1u);
  EXPECT_EQ(rig.state().requests.size(), 1u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
