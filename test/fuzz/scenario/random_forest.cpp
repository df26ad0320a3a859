// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "forest/forest.h"
#include "fuzz/scenario/simulation.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::fuzz {
namespace {

/// Joints that diverge are stopped at FASTEST_BEND. A grab of 1 kN moves a twig of 1 g fast, too.
constexpr double FASTEST_JOINT = 0.5 * forest::FASTEST_BEND;   // [rad/s]
constexpr double LARGEST_BEND = 1.001 * forest::LARGEST_BEND;  // [rad]
constexpr double LARGEST_TREE = 60.0;                          // [branches]

forest::Species randomSpecies(Draw& draw) {
  forest::Species out;
  out.name = "plant";
  out.height = 2.0;
  out.trunk_radius = 0.05;
  out.limbs.resize(static_cast<std::size_t>(1 + draw.below(3)));
  for (std::size_t depth = 1; depth < out.limbs.size(); ++depth) out.limbs[depth].children = 4.0;
  const forest::Species plain = out;
  RandomFields fields(draw, 3.0);
  describe(fields, out);
  for (forest::LimbRule& rule : out.limbs) describe(fields, rule);
  Faults faults;
  check(out, faults);
  return faults.empty() && expectedBranches(out) < LARGEST_TREE ? out : plain;
}

forest::Layout randomLayout(Draw& draw) {
  forest::Layout out;
  out.species = {randomSpecies(draw)};
  RandomFields fields(draw, 3.0);
  describe(fields, out.motion);
  const int trees = 1 + draw.below(3);
  for (int i = 0; i < trees; ++i) {
    forest::TreeSeed tree;
    tree.seed = draw.key();
    tree.position = draw.point(4.0);
    tree.position.z() = 0.0;
    tree.yaw = draw.between(-3.0, 3.0);
    tree.scale = draw.between(0.3, 1.5);
    out.trees.push_back(tree);
  }
  return out;
}

forest::PhysicsSettings randomPhysics(Draw& draw) {
  forest::PhysicsSettings out;
  const physics::Integrator plain = out.integrator;
  RandomFields fields(draw, 3.0);
  describe(fields, out);
  // Explicit Euler is there as paper 1 prints it: a stiff grab of a twig makes it swing more and
  // more although its step is within the limit of the linear motion.
  if (out.integrator == physics::Integrator::EXPLICIT_EULER) out.integrator = plain;
  return out;
}

forest::Settings randomSettings(Draw& draw) {
  forest::Settings out;
  RandomFields fields(draw, 3.0);
  describe(fields, out);
  return out;
}

std::shared_ptr<const terrain::HeightMap> flat() {
  static const auto FLAT = std::make_shared<const terrain::HeightMap>();
  return FLAT;
}

class RandomForest final : public Simulation {
 public:
  RandomForest(Draw& draw, int threads)
      : forest_(randomLayout(draw), flat(), randomSettings(draw)) {
    forest_.setPhysics(randomPhysics(draw));
    forest_.setThreads(threads);
    replica_.setLayout(forest_.layout(), flat());
    for (std::uint32_t id = 0; id < forest_.layout().treeCount(); ++id)
      trees_.push_back(growTree(forest_.layout(), id, *flat()));
  }

  void setWind(const wind::Field& wind) override {
    forest_.setWind(wind);
    replica_.setWind(wind);
  }
  void act(Draw& draw, Nanoseconds stamp) override {
    switch (draw.below(8)) {
      case 0:
        return grab(draw);
      case 1:
        return forest_.moveGrab(anyGrab(draw), trees_[0].foot + draw.point(3.0));
      case 2:
        return forest_.release(anyGrab(draw));
      case 3:
        return forest_.push({randomPoint(draw), draw.point(80.0),
                             stamp + fromSeconds(draw.between(0.0, 1.0)), stamp});
      case 4:
      case 5:
        return placeBody(draw, stamp);
      case 6:
        return forest_.setSensor(
            {"sensor", draw.point(6.0), 20.0, draw.logarithmic(1e-3, 0.5), stamp});
      default:
        if (draw.chance(0.5)) return forest_.setSettings(randomSettings(draw));
        forest_.removeBody("body_0");
    }
  }
  void advance(Nanoseconds stamp, bool key_frame, bool lost) override {
    stamp_ = stamp;
    forest_.advance(stamp);
    const forest::StateUpdate update = forest_.update(key_frame);
    forest_.updateView(key_frame);
    in_step_ = lost ? in_step_ : replica_.apply(update);
    lost_ = lost;
  }
  void restart() override {
    forest_.reset();
    replica_.forgetState();
    in_step_ = false;
  }
  void verify() override {
    for (std::uint32_t id = 0; id < trees_.size(); ++id) checkTree(id);
    for (const forest::Reaction& reaction : forest_.reactions())
      requireWithin(reaction.force.norm(), 1e7, "reaction [N]");
  }
  std::uint64_t hash() const override { return forest_.hash(); }

 private:
  void checkTree(std::uint32_t id) const {
    const forest::Tree& tree = trees_[id];
    const std::vector<Pose> poses = forest_.pose(tree, id, stamp_);
    const double size =
        1.01 * tree.seed.scale * sizeBound(forest_.layout().species[tree.seed.species]);
    for (const Pose& pose : poses) requireWithin(pose.position.norm(), size, "branch [m]");
    for (const forest::PromotedBranch& branch : forest_.promoted(id).branches) {
      requireWithin(std::max(std::fabs(branch.q.first), std::fabs(branch.q.second)), LARGEST_BEND,
                    "bend of a branch [rad]");
      requireWithin(std::max(std::fabs(branch.rate.first), std::fabs(branch.rate.second)),
                    FASTEST_JOINT, "rate of a branch [rad/s]");
    }
    if (lost_ || !in_step_) return;
    const std::vector<Pose> rebuilt = replica_.pose(tree, id, stamp_),
                            sensed = forest_.poseForSensors(tree, id, stamp_);
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (rebuilt[i].position != sensed[i].position)
        throw Divergence("tree " + std::to_string(id) + ": the replica has branch " +
                         std::to_string(i) + " elsewhere");
  }
  forest::BranchPoint randomPoint(Draw& draw) const {
    const int tree = draw.below(static_cast<int>(trees_.size()));
    const auto& branches = trees_[static_cast<std::size_t>(tree)].skeleton.branches;
    const int branch = draw.below(static_cast<int>(branches.size()));
    return {static_cast<std::uint32_t>(tree), branch,
            draw.between(0.0, branches[static_cast<std::size_t>(branch)].length)};
  }
  void grab(Draw& draw) {
    forest::Grab grab;
    grab.point = randomPoint(draw);
    grab.target = trees_[grab.point.tree].foot + draw.point(2.0);
    grab.stiffness = draw.logarithmic(1.0, 1e5);
    grab.damping = draw.logarithmic(0.1, 1e3);
    grab.force_limit = draw.logarithmic(0.1, 1e3);
    if (draw.chance(0.3)) grab.lease = draw.between(0.1, 1.0);
    if (draw.chance(0.3)) grab.jaw_length = draw.between(0.01, 0.5);
    forest_.addGrab(grab);
  }
  std::uint32_t anyGrab(Draw& draw) const {
    const auto& grabs = forest_.grabs();
    if (grabs.empty()) throw InvalidInput("nothing is held");
    return std::next(grabs.begin(), draw.below(static_cast<int>(grabs.size())))->first;
  }
  void placeBody(Draw& draw, Nanoseconds stamp) {
    forest::Body body;
    body.id = "body_" + std::to_string(draw.below(2));
    body.shape = static_cast<forest::Shape>(draw.below(3));
    body.size = Vec3(draw.between(0.02, 0.3), draw.between(0.02, 0.3), draw.between(0.02, 0.3));
    const forest::Tree& tree =
        trees_[static_cast<std::size_t>(draw.below(static_cast<int>(trees_.size())))];
    body.pose.position = tree.foot + draw.point(1.0) + Vec3(0.0, 0.0, 1.0);
    body.velocity = draw.point(3.0);
    body.spin = draw.point(2.0);
    body.stamp = stamp;
    forest_.setBody(body);
  }

  forest::Forest forest_;
  forest::ForestReplica replica_;
  std::vector<forest::Tree> trees_;
  Nanoseconds stamp_{0};
  bool in_step_{false}, lost_{false};
};

}  // namespace

std::unique_ptr<Simulation> makeForest(Draw& draw, int threads) {
  return std::make_unique<RandomForest>(draw, threads);
}

}  // namespace vegetation_sim::fuzz
