// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame/laps.h"
#include "frame/posed_tree.h"
#include "frame/scene.h"
#include "tree/mesh/skin.h"

namespace vegetation_sim::forest {

/// The trees of a scenario, tick by tick and picture by picture. In `grab` a branch is pulled.
class ForestFrame {
 public:
  explicit ForestFrame(const bench::Scene& scene, const Settings& settings = {})
      : wind_(scene.wind),
        held_(*scene.forest, scene.terrain, settings),
        free_(*scene.forest, scene.terrain, settings) {
    viewer_ = bench::frameViewpoint(scene);
    for (Forest* forest : {&held_, &free_}) {
      forest->setPhysics(scene.physics);
      forest->setWind(scene.wind);
    }
    tick_ = grid_.tickAt(bench::FRAME_START);
    for (std::uint32_t id = 0; id < held_.layout().treeCount(); ++id) grow(id);
    run(2 * bench::FRAME_RATE);
    if (scene.name == "grab") hold();
    run(bench::FRAME_RATE);
  }

  void frame(bench::Laps& laps) {
    advance(free_);
    const double chosen = laps.lap("levels");
    advance(held_);
    laps.lapWithout(chosen, "physics");
    ++tick_;
    held_.update(tick_ % bench::FRAME_RATE == 0);
    laps.lap("state");
    pose();
    laps.lap("poses");
    for (Drawn& tree : drawn_) {
      skinBark(tree.mesh, tree.posed.poses, {}, tree.bark.data());
      skinLeaves(tree.mesh, tree.posed.poses, {}, Flutter(), tree.leaves.data());
    }
    laps.lap("meshes");
  }

 private:
  /// A tree as the display draws it.
  struct Drawn {
    PosedTree posed;
    TreeMesh mesh;
    std::vector<float> bark, leaves;
  };

  void grow(std::uint32_t id) {
    PosedTree posed(held_, id, viewer_);
    const Species& species = held_.layout().species[posed.tree.seed.species];
    TreeMesh mesh = buildMesh(posed.tree.skeleton, species, posed.detail);
    std::vector<float> bark(3 * mesh.bark.size()), leaves(3 * LEAF_CORNERS * mesh.leaves.size());
    drawn_.push_back({std::move(posed), std::move(mesh), bark, leaves});
  }
  void hold() {
    const Tree& tree = drawn_[0].posed.tree;
    Grab grab;
    grab.point = {0, tree.skeleton.depth_end[2] - 1, 0.0};
    grab.target = tree.foot +
                  held_.pose(tree, 0, now())[static_cast<std::size_t>(grab.point.branch)].position +
                  Vec3(0.3, 0.0, 0.0);
    held_.addGrab(grab);
  }
  Nanoseconds now() const { return grid_.timeOf(tick_); }
  void advance(Forest& forest) const {
    forest.setViewers({viewer_});
    forest.advance(grid_.timeOf(tick_ + 1));
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_)
      for (Forest* forest : {&free_, &held_}) advance(*forest);
  }
  void pose() {
    const wind::Instant wind = wind_.at(now());
    for (std::uint32_t id = 0; id < drawn_.size(); ++id)
      drawn_[id].posed.pose(held_, id, wind, now());
  }

  wind::Field wind_;
  Forest held_, free_;  ///< with and without the grab; the difference is the cost of physics
  Viewpoint viewer_;
  TickGrid grid_{bench::FRAME_RATE};
  std::int64_t tick_{0};
  std::vector<Drawn> drawn_;
};

}  // namespace vegetation_sim::forest
