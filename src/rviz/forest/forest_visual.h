// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <array>
#include <memory>
#include <vector>

#include "rviz/forest/tree_batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// What was drawn last.
struct ForestReport {
  std::size_t trees{0}, wanted{0};  ///< drawn, asked for
  std::size_t triangles{0};         ///< of trees in the picture
  std::size_t moving{0};            ///< trees that were moved
  std::size_t waiting{0};           ///< trees whose geometry level is still to change
  std::size_t fading{0};            ///< trees that go from one level to another
  int tree_sets{0};                 ///< selections of trees so far
  std::array<std::size_t, forest::GEOMETRY_LEVELS> per_level{};
};

/// The trees of a layout as Ogre shows them; all of it goes with this object. Render thread only.
class ForestVisual {
 public:
  struct Options {
    TreeLook look;
    double target_triangles{80000.0};
    std::size_t most_trees{1000};
  };

  /// @param parent node in the frame of the layout.
  explicit ForestVisual(Ogre::SceneNode& parent);
  ~ForestVisual();

  /// Another layout, or other trees of it: grows them anew over the next updates.
  void restart(const forest::ForestReplica& replica, const View& view, const Options& options);
  /// Draws the forest of `stamp`. Work that cannot be done in time is left to later updates.
  /// @param wall [s], in which levels fade into one another.
  void update(const forest::ForestReplica& replica, Nanoseconds stamp, double wall,
              const View& view, const Daylight& daylight, const Options& options);
  /// The trees will be painted and built anew, as after a change of look.
  void repaint();
  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);

  /// The trees that are drawn; null until all of them stand.
  const TreeSet* tree_set() const { return tree_set_.get(); }
  /// Counts the stocks so far.
  int tree_sets() const { return tree_sets_; }
  const ForestReport& report() const { return report_; }

 private:
  void select(const forest::ForestReplica& replica, const View& view, const Options& options);
  bool prepare(const View& view, const Options& options);
  void applyDelta();
  void runFadeClock(double wall);
  void chooseLevels(const View& view, const Options& options);
  bool changeLevel(DrawnTree& tree, const View& view, const Options& options, bool in_time);
  void move(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
            const Options& options);
  void measure(const View& view, const Options& options);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture leaf_texture_, bark_texture_;
  Material leaf_material_, bark_material_, fading_leaf_material_, fading_bark_material_;
  std::unique_ptr<TreeSet> tree_set_, next_;  // drawn; growing
  std::size_t prepared_{0};                   // of the next trees: they have a mesh
  std::vector<std::unique_ptr<TreeBatch>> tree_batches_;
  Vec3 selected_at_{Vec3::Zero()};  // eye when the trees were selected
  bool selected_all_{true};
  forest::ComplexityFeedback feedback_;
  bool repaint_{false};
  bool settled_{false};  // no level has changed in an update
  double fade_clock_{1.0}, wall_{0.0};
  int tree_sets_{0};
  ForestReport report_;
};

}  // namespace vegetation_sim::view
