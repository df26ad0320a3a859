// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "canopy/layer_grid.h"
#include "scenes/canopy/canopy_scene.h"

// Pictures of layers against each leaf on its own; shared by tests and benches.

namespace vegetation_sim::canopy {

constexpr double PIXELS = 900.0;  ///< of the pictures [pixel/rad]

/// A bank of shrubs, seen from the west, and the pictures of its layers.
class ShrubBank {
 public:
  explicit ShrubBank(int layers) : canopy_(layoutOf(layers)) {
    canopy_.setViewer(CutView{eye(), Quat{}});
    frame_.eye = eye();
    frame_.axes = axesOf(Quat{});
    frame_.half_width = 0.6;
    frame_.half_height = 0.45;
    const Layout& layout = canopy_.layout();
    for (std::size_t plant = 0; plant < layout.plants.size(); ++plant)
      for (const Leaf& leaf : grow(layout.kinds[0], layout.plants[plant]).leaves)
        leaves_.push_back({leaf, plant});
  }

  static Vec3 eye() { return {-12.0, 0.0, 2.0}; }
  Canopy& canopy() { return canopy_; }
  void blow(const Vec3& wind, int ticks) {
    canopy_.setWind(breezeFrom(wind));
    run(canopy_, 0, ticks);
  }
  /// Makes the grids from the leaves at rest, and moves them.
  void makeGrids() {
    const Foliage& foliage = canopy_.foliage();
    grids_.assign(static_cast<std::size_t>(foliage.layers()), LayerGrid(frame_, 64, 48));
    eachLeaf([&](const Leaf& leaf, std::size_t plant) {
      LayerGrid& grid = grids_[static_cast<std::size_t>(foliage.layerAt(leaf.anchor))];
      for (const Vec3& at : {leaf.root, leaf.tip})
        grid.add({at, leaf.anchor, foliage.freedomOf(at, plant)});
    });
    for (LayerGrid& grid : grids_) {
      grid.finish();
      grid.move(foliage);
    }
  }
  void moveGrids() {
    for (LayerGrid& grid : grids_) grid.move(canopy_.foliage());
  }
  /// Moves every leaf.
  void moveLeaves() {
    const Foliage& foliage = canopy_.foliage();
    for (const Owned& owned : leaves_) moved_ = foliage.move(owned.leaf, owned.plant);
  }
  std::size_t leafCount() const { return leaves_.size(); }

  /// Errors of the tips of all leaves, seen from an eye [pixel], sorted.
  std::vector<double> errors(const Vec3& from) {
    std::vector<double> out;
    const Foliage& foliage = canopy_.foliage();
    eachLeaf([&](const Leaf& leaf, std::size_t plant) {
      const LayerGrid& grid = grids_[static_cast<std::size_t>(foliage.layerAt(leaf.anchor))];
      const Vec3 shown = grid.warped(leaf.tip), truth = foliage.move(leaf, plant).tip;
      out.push_back(PIXELS * length(Vec3(seen(shown, from) - seen(truth, from))));
    });
    std::sort(out.begin(), out.end());
    return out;
  }
  double rms(const Vec3& from) {
    double sum = 0.0;
    const std::vector<double> all = errors(from);
    for (const double error : all) sum += error * error;
    return std::sqrt(sum / static_cast<double>(all.size()));
  }
  /// Root mean square over the layers [pixel].
  double predicted(const Vec3& from) const {
    double sum = 0.0;
    for (const LayerGrid& grid : grids_) {
      const double error = PIXELS * grid.predictedError(from);
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(grids_.size()));
  }

  template <class Visit>
  void eachLeaf(const Visit& visit) const {
    for (const Owned& owned : leaves_) visit(owned.leaf, owned.plant);
  }

 private:
  static Layout layoutOf(int layers) {
    Layout out = shrubScene();
    out.motion.cuts.near_layers = layers;
    out.kinds[0].leaves = 600;
    out.plants.clear();
    for (int i = 0; i < 15; ++i) {
      Plant plant;
      plant.seed = static_cast<std::uint64_t>(i) + 1;
      plant.position = Vec3(1.6 * (i % 3), 1.7 * (i / 3) - 3.4, 0.0);
      out.plants.push_back(plant);
    }
    return out;
  }
  Vec3 seen(const Vec3& at, const Vec3& from) const {
    const Vec3 place = into(frame_.axes, at - from);
    return Vec3(place.x(), place.y(), 0.0) / -place.z();
  }

  struct Owned {
    Leaf leaf;
    std::size_t plant;
  };
  Canopy canopy_;
  std::vector<Owned> leaves_;
  MovedLeaf moved_;  // so that moving is not left out
  ImageFrame frame_;
  std::vector<LayerGrid> grids_;
};

}  // namespace vegetation_sim::canopy
