// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/forest_part.h"

#include <algorithm>

#include "tree/mesh/geometry_level.h"
#include "tree/mesh/skin.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scenes {
namespace {

/// Displays draw between ticks: trees are drawn so long after the last one.
constexpr Nanoseconds AFTER_TICK = 5000000;

}  // namespace

ForestPart::ForestPart(const Scenario& scenario, int threads)
    : forest_(*scenario.forest, scenario.terrain, scenario.levels) {
  forest_.setPhysics(scenario.physics);
  forest_.setThreads(threads);
  for (forest::ForestReplica* replica : {&replica_, &shown_})
    replica->setLayout(*scenario.forest, scenario.terrain);
  for (std::uint32_t id = 0; id < forest_.layout().treeCount(); ++id) {
    trees_.push_back(forest::growTree(forest_.layout(), id, forest_.terrain()));
    posers_.emplace_back(trees_.back());
  }
  const forest::Species& species = forest_.layout().species[trees_[0].seed.species];
  mesh_ = forest::buildMesh(trees_[0].skeleton, species, forest::meshDetail(3));
  setWind(scenario.wind);
}

void ForestPart::setWind(const wind::Field& wind) {
  forest_.setWind(wind);
  replica_.setWind(wind);
  shown_.setWind(wind);
}

void ForestPart::advance(Nanoseconds stamp, bool key_frame) {
  stamp_ = stamp;
  forest_.advance(stamp);
  replica_.apply(forest_.update(key_frame));
  shown_.apply(forest_.updateView(key_frame));
}

void ForestPart::addTo(Hashes& hashes) {
  hashes.state.add(forest_.hash());
  for (const forest::Reaction& reaction : forest_.reactions()) {
    hashes.reference.add(reaction.point);
    hashes.reference.add(reaction.force);
    hashes.reference.add(reaction.torque);
  }
  const Nanoseconds shown = stamp_ + AFTER_TICK;
  const wind::Instant wind = shown_.wind().at(shown);
  forest::BatchPoses drawn;
  for (std::uint32_t id = 0; id < trees_.size(); ++id) {
    for (const Pose& pose : forest_.poseForSensors(trees_[id], id, stamp_))
      addPose(pose, hashes.reference);
    poseAsDrawn(id, wind, shown, drawn);
    const auto count = static_cast<std::size_t>(drawn.count);
    for (const auto* row :
         {&drawn.x, &drawn.y, &drawn.z, &drawn.qw, &drawn.qx, &drawn.qy, &drawn.qz})
      addFloats(row->data(), count, hashes.display);
    if (id == 0) addMesh(drawn, hashes.display);
  }
}

void ForestPart::poseAsDrawn(std::uint32_t id, const wind::Instant& wind, Nanoseconds stamp,
                             forest::BatchPoses& out) const {
  const auto* modes = shown_.modalState(id);
  const forest::Weights weights = shown_.weights(id, stamp);
  const bool physical = !shown_.promoted(id).branches.empty();
  if (!physical && modes && forest::modalWeight(weights) >= 1.0)
    modes->pose(posers_[id], stamp, out);
  else if (physical || modes)
    forest::narrowPoses(shown_.pose(trees_[id], id, stamp), out);
  else
    posers_[id].pose(wind.relativeTo(trees_[id].foot), weights, forest::MAX_DEPTHS, out);
}

void ForestPart::addMesh(const forest::BatchPoses& poses, Hash& hash) const {
  std::vector<float> bark(3 * mesh_.bark.size());
  std::vector<float> leaves(3 * forest::LEAF_CORNERS * mesh_.leaves.size());
  const forest::Flutter flutter(secondsBetween(START, stamp_), 4.0, 0.3);
  forest::skinBark(mesh_, poses, {}, bark.data());
  forest::skinLeaves(mesh_, poses, {}, flutter, leaves.data());
  addFloats(bark, hash);
  addFloats(leaves, hash);
}

int ForestPart::lastBranch(std::uint32_t tree, int depth) const {
  const forest::Skeleton& skeleton = trees_[tree].skeleton;
  const int deepest = std::min(depth, skeleton.depths() - 1);
  return skeleton.depth_end[static_cast<std::size_t>(deepest)] - 1;
}

forest::BranchPoint ForestPart::tipPoint(std::uint32_t tree, int branch) const {
  return {tree, branch, trees_[tree].skeleton.branches[static_cast<std::size_t>(branch)].length};
}

Vec3 ForestPart::place(const forest::BranchPoint& point) const {
  const forest::Tree& tree = trees_[point.tree];
  const Pose pose = forest_.pose(tree, point.tree, stamp_)[static_cast<std::size_t>(point.branch)];
  return tree.foot + pose.position + point.along * axisZ(pose.orientation);
}

double ForestPart::height(std::uint32_t tree) const {
  const auto& branches = trees_[tree].skeleton.branches;
  const std::vector<Pose> poses = forest_.poseForSensors(trees_[tree], tree, stamp_);
  double out = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i)
    out = std::max(out, forest::tipOf(branches[i], poses[i]).z());
  return out;
}

}  // namespace vegetation_sim::scenes
