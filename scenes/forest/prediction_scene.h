// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {

/// Predicted errors of the chosen tiers of a forest against measured ones, relative to the full
/// chain, with one or several settings.
class Prediction {
 public:
  static constexpr int RATE = 30;    ///< ticks [Hz]
  static constexpr int WARM_UP = 5;  ///< until modes are computed and the transition is over [s]
  static constexpr double LEAST = 0.05;     ///< trees that move less are not measured [pixel]
  static constexpr std::size_t MOST = 256;  ///< trees that are measured; more pushes are refused

  Prediction(const Layout& layout, std::shared_ptr<const terrain::HeightMap> terrain,
             const wind::Field& wind, const Viewpoint& eye, Nanoseconds start, double settle = 0.5,
             const std::vector<Settings>& settings = {Settings()})
      : exact_(layout, terrain, settings.at(0)) {
    for (const Settings& each : settings)
      chosen_.push_back(std::make_unique<Forest>(layout, terrain, each));
    eye_ = eye;
    PhysicsSettings whole;
    whole.promotion = Promotion::DEPTH;
    whole.most_branches = 1000000;
    exact_.setPhysics(whole);
    exact_.setWind(wind);
    for (const auto& forest : chosen_) forest->setWind(wind);
    tick_ = grid_.tickAt(start);
    run(static_cast<int>(settle * RATE));  // trees that move by then are measured
    for (const Plant& plant : chosen_[0]->viewChoice().plants())
      if (plant.error[0] > LEAST && trees_.size() < MOST) makeWhole(plant.id);
    run(WARM_UP * RATE);
  }

  /// Errors of one tree at one tick [pixel].
  struct Look {
    double predicted, measured;
    int tier;
  };
  using Looks = std::map<std::uint32_t, std::vector<Look>>;  // by moving tree

  /// Measures at every tick for some seconds, with the first of the settings, the trees whose tier
  /// is chosen then.
  Looks look(int seconds) {
    Looks out;
    for (int i = 0; i < RATE * seconds; ++i) {
      run(1);
      addLooks(*chosen_[0], poseExact(), out);
    }
    return out;
  }
  /// Measures all moving trees with each of the settings. Those whose tier is not chosen, since no
  /// error is predicted for them, are on tier 0.
  std::vector<Looks> lookWithAll(int seconds) {
    std::vector<Looks> out(chosen_.size());
    for (int i = 0; i < RATE * seconds; ++i) {
      run(1);
      const PosesById right = poseExact();
      for (std::size_t k = 0; k < chosen_.size(); ++k) {
        const Forest& forest = *chosen_[k];
        addLooks(forest, right, out[k]);
        for (const auto& [id, poses] : right) {
          std::vector<Look>& looks = out[k][id];
          if (looks.size() <= static_cast<std::size_t>(i))
            looks.push_back({0.0, measured(forest, id, poses), 0});
        }
      }
    }
    return out;
  }

  /// Returns the ratio of the largest predicted and measured errors of a tree.
  static double ratioOf(const std::vector<Look>& looks) {
    double predicted = 0.0, measured = 0.0;
    for (const Look& look : looks) {
      predicted = std::max(predicted, look.predicted);
      measured = std::max(measured, look.measured);
    }
    return predicted / measured;
  }

 private:
  using PosesById = std::map<std::uint32_t, std::vector<Pose>>;

  // Makes all joints physical, under the wind alone.
  void makeWhole(std::uint32_t id) {
    const Tree& tree =
        trees_.emplace(id, growTree(exact_.layout(), id, exact_.terrain())).first->second;
    Push touch;
    touch.point = {id, static_cast<int>(tree.skeleton.branches.size()) - 1, 0.0};
    touch.until = exact_.snapshot().stamp + fromSeconds(1e6);
    exact_.push(touch);
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i, ++tick_) {
      exact_.advance(grid_.timeOf(tick_));
      for (const auto& forest : chosen_) {
        forest->setViewers({eye_});
        forest->advance(grid_.timeOf(tick_));
      }
    }
  }
  void addLooks(const Forest& forest, const PosesById& right, Looks& out) const {
    for (const Plant& plant : forest.viewChoice().plants())
      if (trees_.count(plant.id))
        out[plant.id].push_back({plant.error[static_cast<std::size_t>(plant.chosen)],
                                 measured(forest, plant.id, right.at(plant.id)), plant.chosen});
  }
  PosesById poseExact() const {
    PosesById out;
    for (const auto& [id, tree] : trees_) out[id] = exact_.pose(tree, id, exact_.snapshot().stamp);
    return out;
  }
  // Returns the largest distance of any tip of a tree from the full chain.
  double measured(const Forest& chosen, std::uint32_t id, const std::vector<Pose>& right) const {
    const Tree& tree = trees_.at(id);
    const auto shown = chosen.poseInView(tree, id, chosen.snapshot().stamp);
    double out = 0.0;
    for (std::size_t b = 0; b < right.size(); ++b) {
      const Branch& branch = tree.skeleton.branches[b];
      const Vec3 tip = tipOf(branch, right[b]);
      const double distance = length(tree.foot + tip - eye_.position);
      const double off = length(tip - tipOf(branch, shown[b]));
      out = std::max(out, off * pixelsPerMetre(eye_, distance));
    }
    return out;
  }

  std::vector<std::unique_ptr<Forest>> chosen_;  // by settings
  Forest exact_;
  Viewpoint eye_;
  TickGrid grid_{RATE};
  std::int64_t tick_{0};
  std::map<std::uint32_t, Tree> trees_;  // fully physical trees
};

}  // namespace vegetation_sim::forest
