// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <vector>

#include "frame/scene.h"
#include "vegetation_sim/forest/forest.h"

namespace vegetation_sim::forest {

/// What the governor foretells of the trees of a scenario against what they show: their motion on
/// the rungs that it chose, beside that of all of them in modes.
class Prediction {
 public:
  explicit Prediction(const bench::Scene& scene)
      : chosen_(*scene.forest, scene.terrain, Settings()),
        exact_(*scene.forest, scene.terrain, inModes()) {
    eye_.id = "eye";
    eye_.eye = bench::frameEye(scene);
    for (Forest* forest : {&chosen_, &exact_}) forest->setWind(scene.wind);
    tick_ = grid_.tickAt(bench::FRAME_START);
    const std::size_t trees = chosen_.layout().treeCount();
    for (std::uint32_t id = 0; id < trees; ++id)
      trees_.push_back(growTree(chosen_.layout(), id, chosen_.terrain()));
    run(static_cast<int>(trees) + 10 * bench::FRAME_RATE);  // a tree a tick gets its modes
  }

  /// Errors of one tree at one look [pixel].
  struct Look {
    double predicted, measured;
  };
  using Looks = std::map<std::uint32_t, std::vector<Look>>;  // by tree that moves

  /// Looks about three times a second, for some seconds.
  Looks look(int seconds) {
    Looks out;
    for (int i = 0; i < 3 * seconds; ++i) {
      run(bench::FRAME_RATE / 3);
      for (const Plant& plant : chosen_.plants())
        if (plant.chosen != MODAL_LEVEL && exact_.memory().levels.of(plant.id).level == MODAL_LEVEL)
          out[plant.id].push_back(
              {plant.error[static_cast<std::size_t>(plant.chosen)], measured(plant.id)});
    }
    return out;
  }

 private:
  static Settings inModes() {
    Settings out;
    out.tolerance = 0.01;
    out.budget = {1e6, 100000000, 1000};
    return out;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_)
      for (Forest* forest : {&chosen_, &exact_}) {
        eye_.stamp = grid_.timeOf(tick_);
        forest->setViewer(eye_);
        forest->advance(eye_.stamp);
      }
  }
  // Farthest that any tip of a tree is from where its modes have it.
  double measured(std::uint32_t id) const {
    const Tree& tree = trees_[id];
    const Nanoseconds stamp = chosen_.memory().stamp;
    const auto right = exact_.pose(tree, id, stamp), shown = chosen_.pose(tree, id, stamp);
    double out = 0.0;
    for (std::size_t b = 0; b < right.size(); ++b) {
      const Branch& branch = tree.skeleton.branches[b];
      const Vec3 tip = tipOf(branch, right[b]);
      const double distance = length(tree.foot + tip - eye_.eye.position);
      const double off = length(tip - tipOf(branch, shown[b]));
      out = std::max(out, off * pixelsPerMetre(eye_.eye, distance));
    }
    return out;
  }

  Forest chosen_, exact_;
  Viewer eye_;
  TickGrid grid_{bench::FRAME_RATE};
  std::int64_t tick_{0};
  std::vector<Tree> trees_;
};

}  // namespace vegetation_sim::forest
