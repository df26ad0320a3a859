// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Trees that are grabbed, pushed and run into.
#include "scenes/catalogue.h"

namespace vegetation_sim::scenes {
namespace {

using forest::Shape;

/// Takes hold of the tip of a branch; the first grab has id 1.
void grab(World& world, std::uint32_t tree, int depth, double lease) {
  ForestPart& trees = *world.forest;
  forest::Grab grab;
  grab.point = trees.tipPoint(tree, trees.lastBranch(tree, depth));
  grab.target = trees.place(grab.point);
  grab.lease = lease;
  trees.forest().addGrab(grab);
}

void push(World& world, std::uint32_t tree, int depth, const Vec3& force) {
  ForestPart& trees = *world.forest;
  forest::Push push;
  push.point = trees.tipPoint(tree, trees.lastBranch(tree, depth));
  push.force = force;
  push.until = world.now() + fromSeconds(0.5);
  trees.forest().push(push);
}

/// A grab from tick 30, moved until tick 300 and then released; a second one whose lease ends.
void pull(World& world) {
  const int tick = world.tick();
  forest::Forest& forest = world.forest->forest();
  if (tick == 30) grab(world, 0, 1, 0.0);
  if (tick == 90) grab(world, 1, 2, 1.0);
  if (tick > 30 && tick < 150) {
    const Vec3 target = forest.grabs().at(1).target;
    forest.moveGrab(1, target + Vec3(0.004, -0.003, -0.002));
  }
  if (tick > 90 && tick < 200 && tick % 20 == 0) forest.renewGrab(2);
  if (tick == 240) world.changeWind();
  if (tick == 300) forest.release(1);
  if (tick == 480) grab(world, 0, 2, 0.0);
  if (tick > 480) forest.moveGrab(3, forest.grabs().at(3).target + Vec3(-0.002, 0.002, -0.001));
}

void pushAndGrab(World& world) {
  const int tick = world.tick();
  if (tick == 20) push(world, 0, 1, Vec3(60.0, 20.0, 0.0));
  if (tick == 60) push(world, 1, 2, Vec3(-10.0, 5.0, 3.0));
  if (tick == 200) grab(world, 0, 2, 0.0);
  if (tick > 200 && tick < 320) {
    forest::Forest& forest = world.forest->forest();
    forest.moveGrab(1, forest.grabs().at(1).target + Vec3(0.002, 0.003, -0.002));
  }
  if (tick == 420) world.forest->forest().release(1);
  if (tick == 300) world.changeWind();
  if (tick == 580) push(world, 0, 1, Vec3(-30.0, 40.0, 0.0));
}

forest::Body bodyOf(const std::string& id, Shape shape, const Vec3& size) {
  forest::Body out;
  out.id = id;
  out.frame = id + "_link";
  out.shape = shape;
  out.size = size;
  return out;
}

void place(World& world, forest::Body body, const Vec3& at, const Vec3& velocity) {
  body.pose.position = at;
  body.velocity = velocity;
  body.stamp = world.next();
  world.forest->forest().setBody(body);
}

/// A sphere, a capsule and a box drive through three trees; the box turns back and is removed.
void drive(World& world) {
  const int tick = world.tick();
  const double t = world.nextSeconds();
  place(world, bodyOf("ball", Shape::SPHERE, Vec3(0.15, 0.0, 0.0)), Vec3(-1.5 + 0.3 * t, 0.1, 1.2),
        Vec3(0.3, 0.0, 0.0));
  place(world, bodyOf("arm", Shape::CAPSULE, Vec3(0.04, 0.0, 0.6)), Vec3(3.0, -1.5 + 0.3 * t, 1.3),
        Vec3(0.0, 0.3, 0.0));
  if (tick < 500) {
    const double side = tick < 250 ? 1.0 : -1.0;
    const double way = tick < 250 ? t : 2.0 * 250.0 / 60.0 - t;
    place(world, bodyOf("crate", Shape::BOX, Vec3(0.4, 0.3, 0.5)), Vec3(4.7 + 0.4 * way, -0.2, 1.0),
          Vec3(0.4 * side, 0.0, 0.0));
  }
  if (tick == 500) world.forest->forest().removeBody("crate");
  if (tick == 300) world.changeWind();
}

void nothing(World& /*world*/) {}

/// Of the branch of depth 2 that is grabbed and pushed.
double tipHeight(World& world) {
  const ForestPart& trees = *world.forest;
  return trees.place(trees.tipPoint(0, trees.lastBranch(0, 2))).z();
}

double heightOfLast(World& world) {
  const ForestPart& trees = *world.forest;
  return trees.place(trees.tipPoint(2, trees.lastBranch(2, 0))).z();
}

}  // namespace

std::vector<SceneEntry> touchedTreeScenes() {
  return {{"grabbed_tree", "grabs taken, moved, renewed, released and ended by their lease",
           "height of the tip of a held branch [m]", nothing, pull, tipHeight},
          {"pushed_trees", "pushes and a grab with physical branches in double precision",
           "height of the tip of a held branch [m]", nothing, pushAndGrab, tipHeight},
          {"driven_trees", "contact of young trees with a sphere, a capsule and a box",
           "height of the tip of the trunk of tree 2 [m]", nothing, drive, heightOfLast},
          {"paper_physics", "dynamics, material and wind forcing as printed, promotion by depth",
           "height of the tip of a held branch [m]", nothing, pushAndGrab, tipHeight}};
}

}  // namespace vegetation_sim::scenes
