// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "rviz/forest/tree_batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// Figures of the last update.
struct ForestReport {
  std::size_t trees{0}, wanted{0};  ///< drawn, selected
  std::size_t triangles{0};         ///< of trees in the picture
  std::size_t moving{0};            ///< trees with new positions
  std::size_t waiting{0};           ///< trees whose level changes later
  std::size_t fading{0};            ///< trees between two levels
  std::size_t pieces{0};            ///< that have come off them
  int tree_sets{0};                 ///< number of selections of trees
  bool shadows_late{false};         ///< moving shadows are of an earlier stamp than the trees
  std::array<std::size_t, forest::GEOMETRY_LEVELS> per_level{};
};

/// The OGRE objects of the trees of a layout, which it owns. Render thread only.
class ForestVisual {
 public:
  struct Options {
    TreeLook look;
    std::map<std::uint32_t, std::vector<int>> held;  ///< branches by tree, sorted
    double target_triangles{80000.0};
    std::size_t most_trees{1000};
    bool by_bough{true};  ///< boughs of near trees have levels of detail of their own
  };

  /// @param parent node in the frame of the layout.
  explicit ForestVisual(Ogre::SceneNode& parent);
  ~ForestVisual();

  /// Grows the trees of a layout during the next updates.
  void restart(const forest::ForestReplica& replica, const View& view, const Options& options);
  /// Draws the forest at `stamp`. Work beyond a time limit is left to later updates.
  /// @param wall [s] clock of the fades between levels.
  void update(const forest::ForestReplica& replica, Nanoseconds stamp, double wall,
              const View& view, const Daylight& daylight, const Options& options);
  /// Builds and paints all trees again, as after a change of options.
  void repaint();
  void light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze);

  /// Returns the trees that are drawn; null until all are grown.
  const TreeSet* treeSet() const { return tree_set_.get(); }
  /// Number of tree sets that have been drawn.
  int treeSets() const { return tree_sets_; }
  const ForestReport& report() const { return report_; }

 private:
  struct Piece {
    std::unique_ptr<DrawnTree> tree;
    std::unique_ptr<TreeBatch> batch;
  };
  void select(const forest::ForestReplica& replica, const View& view, const Options& options);
  bool prepare(const View& view, const Options& options);
  void applyDelta();
  void runFadeClock(double wall);
  void chooseLevels(const forest::ForestReplica& replica, const View& view, const Options& options);
  bool regrow(const forest::ForestReplica& replica, DrawnTree& tree, const Options& options);
  bool changeLevel(DrawnTree& tree, const View& view, const Options& options, bool in_time);
  void move(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
            const Options& options);
  void updatePieces(const forest::ForestReplica& replica);
  TreeMaterials treeMaterials() const;
  Piece growPiece(const forest::ForestReplica& replica, std::uint32_t tree, std::size_t number);
  void movePieces(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
                  const Options& options);
  void measure(const View& view, const Options& options);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture leaf_texture_, bark_texture_;
  Material leaf_material_, bark_material_, fading_leaf_material_, fading_bark_material_,
      near_leaf_material_;
  std::unique_ptr<TreeSet> tree_set_, next_;  // drawn; growing
  std::size_t prepared_{0};                   // number of the next trees with a mesh
  std::vector<std::unique_ptr<TreeBatch>> tree_batches_;
  using Pieces = std::map<std::pair<std::uint32_t, std::size_t>, Piece>;  // by tree and number
  Pieces pieces_;                   // what has come off the drawn trees
  Vec3 selected_at_{Vec3::Zero()};  // viewer at the selection
  bool selected_all_{true};
  forest::ComplexityFeedback feedback_;
  double last_factor_{0.0};  // of the last update
  bool repaint_{false};
  bool settled_{false};  // an update has changed no level
  double fade_clock_{1.0}, wall_{0.0};
  int tree_sets_{0};
  ForestReport report_;
};

}  // namespace vegetation_sim::view
