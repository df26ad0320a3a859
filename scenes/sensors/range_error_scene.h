// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "forest/forest.h"
#include "scenes/sensors/lidar_scene.h"
#include "scenes/shipped_scene.h"
#include "sensors/sweep.h"
#include "sensors/trees/tree_field.h"

namespace vegetation_sim::scan {

/// A lidar among trees.
struct RangeLidar {
  Vec3 place{Vec3::Zero()};
  double range{30.0};      ///< [m]
  double tolerance{0.01};  ///< [m]
  Beams beams;
};

/// A forest, and what a sensor rebuilds of it.
class SensedForest {
 public:
  SensedForest(const forest::Layout& layout, std::shared_ptr<const terrain::HeightMap> terrain,
               const wind::Field& wind)
      : forest_(layout, terrain, {}) {
    forest_.setWind(wind);
    replica_.setLayout(layout, terrain);
    replica_.setWind(wind);
  }
  forest::Forest& forest() { return forest_; }
  const Trees& trees() const { return trees_; }

  /// @throws std::logic_error if the replica refuses the state.
  void advance(Nanoseconds stamp, bool key_frame) {
    forest_.advance(stamp);
    if (!replica_.apply(forest_.update(key_frame))) throw std::logic_error(replica_.why());
  }
  void pose(const RangeLidar& lidar, Nanoseconds stamp) {
    trees_.update(replica_, lidar.place, lidar.range, stamp);
  }
  Hit cast(const RangeLidar& lidar, const Vec3& direction) const {
    Hit out;
    out.distance = lidar.range;
    trees_.meet(Ray(lidar.place, direction), out);
    return out;
  }
  const Rod& rodOf(const Hit& hit) const {
    for (const auto& tree : trees_.all())
      if (tree->id() == hit.plant) return tree->branches()[tree->partOf(hit.branch)].rod;
    throw std::out_of_range("a tree that is not sensed");
  }

 private:
  forest::Forest forest_;
  forest::ForestReplica replica_;
  Trees trees_;
};

/// Makes all joints of trees physical, under the wind alone: the full model.
inline void makeWhole(forest::Forest& forest, const std::vector<std::uint32_t>& trees) {
  forest::PhysicsSettings whole;
  whole.promotion = forest::Promotion::DEPTH;
  whole.most_branches = 1000000;
  forest.setPhysics(whole);
  for (const std::uint32_t id : trees) {
    const forest::Tree tree = growTree(forest.layout(), id, forest.terrain());
    forest::Push touch;
    touch.point = {id, static_cast<int>(tree.skeleton.branches.size()) - 1, 0.0};
    touch.until = START + fromSeconds(1e6);
    forest.push(touch);
  }
}

inline double quantileOf(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

inline bool isWood(const Hit& hit) {
  return hit.label == Label::TRUNK || hit.label == Label::BRANCH;
}

struct RangeErrors {
  std::vector<double> all;  ///< of rays that meet the same branch in both [m]
  /// Distances of the places of branches that rays meet in the full model from the same places of
  /// the same branches as they are sensed, for all rays to wood [m].
  std::vector<double> displaced;
  std::size_t wood{0};  ///< rays that meet wood in the full model
  double mean() const {
    double sum = 0.0;
    for (const double error : all) sum += error;
    return sum / static_cast<double>(all.size());
  }
  /// Returns the share of all rays to wood that are displaced by at most a distance [m].
  double shareWithin(double distance) const {
    const auto count =
        std::count_if(displaced.begin(), displaced.end(), [&](double d) { return d <= distance; });
    return static_cast<double>(count) / static_cast<double>(displaced.size());
  }
};

inline void addErrors(const RangeLidar& lidar, const SensedForest& full, const SensedForest& sensed,
                      RangeErrors& out) {
  for (int ring = 0; ring < lidar.beams.rings; ++ring)
    for (int column = 0; column < lidar.beams.columns; ++column) {
      const Vec3 direction = directionOf(lidar.beams, ring, column);
      const Hit right = full.cast(lidar, direction), hit = sensed.cast(lidar, direction);
      if (!isWood(right)) continue;
      ++out.wood;
      const Rod& rod = full.rodOf(right);
      const Rod& other = sensed.rodOf(right);
      const double along = dot(Vec3(lidar.place + right.distance * direction - rod.base), rod.axis);
      out.displaced.push_back(
          length(Vec3(rod.base + along * rod.axis - other.base - along * other.axis)));
      if (isWood(hit) && hit.plant == right.plant && hit.branch == right.branch)
        out.all.push_back(std::fabs(hit.distance - right.distance));
    }
}

/// How displays look at a lidar.
enum Watch { UNWATCHED, AWAY, TOWARDS, WATCHES };

inline void watch(forest::Forest& forest, const RangeLidar& lidar, Watch how) {
  if (how == UNWATCHED) return;
  Viewpoint eye;
  eye.position = lidar.place + Vec3(0.0, -12.0, 2.0);
  eye.forward = how == TOWARDS ? Vec3(0.0, 1.0, 0.0) : Vec3(0.0, -1.0, 0.0);
  eye.cone_cosine = 0.8;
  eye.pixels_per_radian = 900.0;
  forest.setViewers({eye});
}

inline std::size_t countDifferent(const RangeLidar& lidar, const SensedForest& a,
                                  const SensedForest& b) {
  std::size_t out = 0;
  for (int ring = 0; ring < lidar.beams.rings; ++ring)
    for (int column = 0; column < lidar.beams.columns; ++column) {
      const Vec3 direction = directionOf(lidar.beams, ring, column);
      out += !same(a.cast(lidar, direction), b.cast(lidar, direction));
    }
  return out;
}

/// A lidar in the shipped scenario `forest`, in its clearing.
inline RangeLidar lidarInForest(const scenes::ShippedScene& scene, double range) {
  RangeLidar out;
  out.place = Vec3(0.0, -18.0, scene.terrain->height(0.0, -18.0) + 1.5);
  out.range = range;
  out.beams.rings = 32;
  out.beams.columns = 720;
  out.beams.elevation_low = -0.1;
  out.beams.elevation_high = 0.7;
  return out;
}

/// What a lidar in a scenario measures with each way of watching.
struct WatchedErrors {
  std::array<RangeErrors, WATCHES> errors;
  std::size_t trees{0}, joints{0};  ///< of the full model
  std::size_t modal{0};             ///< trees in modes at the end
  std::size_t broken{0};            ///< trees of the full model that the wind has broken
  std::size_t hashes{0}, hits{0};   ///< that differ from those without a viewer
};

inline std::vector<std::uint32_t> treesNear(const scenes::ShippedScene& scene,
                                            const RangeLidar& lidar) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t id = 0; id < scene.forest->treeCount(); ++id) {
    const forest::Tree tree = growTree(*scene.forest, id, *scene.terrain);
    if (length(Vec3(tree.foot - lidar.place)) < lidar.range + tree.skeleton.height)
      out.push_back(id);
  }
  return out;
}

/// Compares each way of watching with the full model of the trees in the lidar's range. @param
/// warm_up and @param measured durations [s].
inline WatchedErrors compareWatched(const scenes::ShippedScene& scene, const RangeLidar& lidar,
                                    int warm_up, int measured, int modal_trees) {
  constexpr int RATE_OF_TICKS = 30, PAUSE = 12;
  WatchedErrors out;
  const std::vector<std::uint32_t> near = treesNear(scene, lidar);
  SensedForest full(*scene.forest, scene.terrain, scene.wind);
  makeWhole(full.forest(), near);
  std::vector<std::unique_ptr<SensedForest>> sensed;
  for (std::size_t w = 0; w < WATCHES; ++w) {
    sensed.push_back(std::make_unique<SensedForest>(*scene.forest, scene.terrain, scene.wind));
    forest::Settings settings;
    settings.budget.modal_trees = modal_trees;
    sensed[w]->forest().setSettings(settings);
  }
  const TickGrid grid(RATE_OF_TICKS);
  const std::int64_t first = grid.tickAt(START);
  for (int i = 0; i < (warm_up + measured) * RATE_OF_TICKS; ++i) {
    const Nanoseconds stamp = grid.timeOf(first + i);
    const bool key_frame = i % RATE_OF_TICKS == 0;
    full.advance(stamp, key_frame);
    for (std::size_t w = 0; w < WATCHES; ++w) {
      forest::Forest& forest = sensed[w]->forest();
      forest.setSensor({"lidar", lidar.place, lidar.range, lidar.tolerance, stamp});
      watch(forest, lidar, static_cast<Watch>(w));
      sensed[w]->advance(stamp, key_frame);
      out.hashes += forest.hash() != sensed[0]->forest().hash();
    }
    if (i < warm_up * RATE_OF_TICKS || i % PAUSE != 0) continue;
    full.pose(lidar, stamp);
    for (std::size_t w = 0; w < WATCHES; ++w) {
      sensed[w]->pose(lidar, stamp);
      addErrors(lidar, full, *sensed[w], out.errors[w]);
      if (w > 0) out.hits += countDifferent(lidar, *sensed[0], *sensed[w]);
    }
  }
  out.trees = near.size();
  out.joints = full.forest().physicsFigures().branches;
  out.broken = full.forest().broken().size();
  out.modal = sensed[0]->forest().sensed().modes.modalStates().size();
  return out;
}

inline void printWatched(const RangeLidar& lidar, int modal_trees, const WatchedErrors& found) {
  const char* const names[] = {"no viewer", "looks away", "looks at it"};
  std::printf(
      "range %.0f m, %zu trees with %zu joints in reach, modal_trees %d: %zu in modes\n"
      "hashes that differ between viewers: %zu; hits that differ: %zu; trees broken by wind: %zu\n",
      lidar.range, found.trees, found.joints, modal_trees, found.modal, found.hashes, found.hits,
      found.broken);
  for (std::size_t w = 0; w < WATCHES; ++w) {
    const RangeErrors& e = found.errors[w];
    std::printf(
        "| %-11s | %7zu rays to wood | 99 %% displaced by up to %6.1f mm | %6.2f %% within %.0f mm "
        "| same branch %5.1f %% | ranges: mean %.1f mm, 99 %% %.1f mm |\n",
        names[w], e.wood, 1e3 * quantileOf(e.displaced, 0.99),
        100.0 * e.shareWithin(lidar.tolerance), 1e3 * lidar.tolerance,
        100.0 * static_cast<double>(e.all.size()) / static_cast<double>(e.wood), 1e3 * e.mean(),
        1e3 * quantileOf(e.all, 0.99));
  }
}

}  // namespace vegetation_sim::scan
