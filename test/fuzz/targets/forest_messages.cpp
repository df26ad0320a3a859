// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "forest/pick.h"
#include "fuzz/targets/decoding.h"
#include "fuzz/targets/target_lists.h"
#include "fuzz/targets/usage.h"
#include "ros/replicas/subscribed_forest.h"
#include "scenes/forest/forest_fixture.h"
#include "tree/mesh/skin.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::fuzz {
namespace {

enum PieceKind { LAYOUT, WIND, STATE, JUMP_BACK, KINDS };
constexpr std::uint32_t MOST_DRAWN = 2;
constexpr double MOST_BRANCHES = 500.0;  // of a tree that is drawn

void drawTree(const forest::ForestReplica& forest, std::uint32_t id) {
  const forest::Tree tree = forest.grow(id);
  const Nanoseconds stamp = forest.stamp();
  requireFinite(forest.pose(tree, id, stamp), "pose of a branch");
  forest::BatchPoses poses;
  forest::BatchPoser(tree).pose(forest.wind().at(stamp).relativeTo(tree.foot),
                                forest.weights(id, stamp), forest::MAX_DEPTHS, poses);
  const forest::TreeMesh mesh = forest::buildMesh(
      tree.skeleton, forest.layout().species[tree.seed.species], forest::meshDetail(1));
  std::vector<float> bark(3 * mesh.bark.size());
  forest::skinBark(mesh, poses, {}, bark.data());
  requireFinite(bark, "vertex of a tree");
}

void pick(const forest::ForestReplica& forest) {
  forest::Ray ray;
  ray.origin = SENSOR_PLACE;
  ray.direction = Vec3(-1.0, -1.0, 0.1);
  forest::pickTree(forest.layout(), forest.terrain(), ray, [&](std::uint32_t id) {
    forest::PosedTree out;
    out.tree = std::make_shared<const forest::Tree>(forest.grow(id));
    out.poses = forest.pose(*out.tree, id, forest.stamp());
    return out;
  });
}

// The work of drawing, picking and sweeping grows with the branches of the scene, which its user
// chooses; here scenes are small.
bool isSmall(const forest::Layout& layout) {
  for (const forest::Species& species : layout.species)
    if (!(expectedBranches(species) < MOST_BRANCHES)) return false;
  return true;
}

void use(const forest::ForestReplica& forest) {
  if (!forest.ready() || !isSmall(forest.layout())) return;
  const std::uint32_t count = std::min(forest.layout().treeCount(), MOST_DRAWN);
  for (std::uint32_t id = 0; id < count; ++id) drawTree(forest, id);
  for (const std::uint32_t id : forest.physicalTrees())
    if (id >= count && id < count + 2) drawTree(forest, id);
  if (forest.layout().treeCount() < 20) pick(forest);
  scan::Scene scene;
  scene.trees = scan::Trees(10 * static_cast<std::size_t>(MOST_BRANCHES));
  scene.ground = forest.terrainPtr();
  scene.trees.update(forest, SENSOR_PLACE, SENSOR_RANGE, forest.stamp());
  sweepOnce(scene);
}

void receive(const Piece& piece, SubscribedForest& forest) {
  switch (piece.kind % KINDS) {
    case LAYOUT:
      if (ForestLayout layout; decode(piece.bytes, layout)) forest.setLayout(layout);
      break;
    case WIND:
      if (WindField wind; decode(piece.bytes, wind)) {
        repairHash(wind);
        try {
          forest.setWind(fromMsg(wind));
        } catch (const InvalidInput&) {
        }
      }
      break;
    case STATE:
      if (ForestState state; decode(piece.bytes, state)) {
        state.layout_hash = forest.replica().layoutHash();
        forest.apply(state);
      }
      break;
    default:
      forest.forgetLater(START + Numbers(piece.bytes).word() * NANOSECONDS_PER_SECOND / 100);
  }
}

void run(std::string_view input) {
  SubscribedForest forest;
  for (const Piece& piece : splitPieces(input)) receive(piece, forest);
  use(forest.replica());
}

forest::Species smallSpecies() {
  forest::Species out;
  out.name = "bush";
  out.height = 2.0;
  out.limbs.resize(2);
  return out;
}

forest::Layout twoTrees() {
  forest::Layout out;
  out.species = {smallSpecies()};
  for (std::uint64_t i = 0; i < 2; ++i) {
    forest::TreeSeed tree;
    tree.seed = i;
    tree.position = Vec3(3.0 * static_cast<double>(i), 0.0, 0.0);
    out.trees.push_back(tree);
  }
  return out;
}

std::string windPiece() {
  wind::Primitive breeze = forest::makeBreeze(1, Vec3(4.0, 2.0, 0.0));
  breeze.epoch = START;
  return pieceOf(WIND, encode(toMsg(wind::Field({breeze}, 3), "map", START)));
}

/// Key frame and delta of a forest one of whose trees is held.
std::string heldTree() {
  forest::Forest forest(twoTrees(), forest::flatTerrain(), {});
  forest::Grab grab;
  grab.point = {0, 1, 0.1};
  grab.target = Vec3(0.5, 0.5, 1.5);
  forest.addGrab(grab);
  std::string out = pieceOf(LAYOUT, encode(toMsg(forest.layout()))) + windPiece();
  for (int tick = 1; tick <= 3; ++tick) {
    forest.advance(START + tick * NANOSECONDS_PER_SECOND / 60);
    out += pieceOf(STATE, encode(toMsg(forest.update(tick == 1))));
  }
  return out;
}

std::string movingTrees(int level) {
  forest::StateUpdate update;
  update.stamp = START;
  update.base.level = level;
  return pieceOf(LAYOUT, encode(toMsg(twoTrees()))) + windPiece() +
         pieceOf(STATE, encode(toMsg(update)));
}

/// A state that holds a branch of each of many large trees, which are grown to check it.
std::string manyHeldTrees() {
  forest::Layout layout;
  layout.species = {smallSpecies()};
  layout.species[0].limbs.resize(3);
  layout.species[0].limbs[1].children = 100.0;
  layout.species[0].limbs[2].children = 70.0;
  layout.tiles = {{0, 200, 7, 0.0, 0.0, 1000.0, {1.0F}}};
  forest::StateUpdate update;
  update.stamp = START;
  for (std::uint32_t id = 0; id < 200; ++id) {
    update.trees.push_back({id, {}, {forest::PromotedBranch()}});
    update.trees.back().promoted[0].branch = 1;
  }
  return pieceOf(LAYOUT, encode(toMsg(layout))) + pieceOf(STATE, encode(toMsg(update)));
}

std::string tile() {
  forest::Layout out = twoTrees();
  out.tiles = {{2, 9, 7, 0.0, 0.0, 8.0, {1.0F}}};
  return pieceOf(LAYOUT, encode(toMsg(out)));
}

std::vector<std::string> seeds() {
  const std::string jump = pieceOf(JUMP_BACK, std::string("\x10\x00", 2));
  return {heldTree(), movingTrees(2),    movingTrees(forest::MODAL_LEVEL),
          tile(),     heldTree() + jump, manyHeldTrees()};
}

}  // namespace

std::vector<Target> forestMessageTargets() {
  return {{"forest", "ForestLayout, WindField, ForestState; poses, a mesh, a pick and a sweep", run,
           seeds}};
}

}  // namespace vegetation_sim::fuzz
