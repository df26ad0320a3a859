// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <string>
#include <vector>

#include "rviz/render/batch.h"
#include "rviz/trees/drawn_tree.h"

namespace vegetation_sim::view {

/// Names of the materials of trees, of those that fade too.
struct TreeMaterials {
  std::string bark, leaves, fading_bark, fading_leaves;
};

/// Trees that stand together and are drawn with two batches, bark and leaves. Render thread only.
class TreeBatch {
 public:
  /// @param node whose frame is the trees' origin.
  TreeBatch(std::vector<DrawnTree*> trees, Ogre::SceneNode& node, const TreeMaterials& materials);

  const std::vector<DrawnTree*>& trees() const { return trees_; }
  /// Middle of the feet, layout's frame [m].
  const Vec3& middle() const { return middle_; }

  /// Takes the meshes of its trees, which have changed.
  void rebuild();
  /// Takes the positions of its trees, and their paint.
  void takePositions();
  void takePaint();
  bool takeSeen();
  void setRank(int rank);
  /// Draws leaves front to back for this eye (layout's frame), as hidden ones cost little then.
  /// False if the order for an eye in about this direction is there already.
  bool sortFor(const Vec3& eye);

  /// Stamp that its trees were moved to.
  Nanoseconds moved_to{-1};

 private:
  std::vector<DrawnTree*> trees_;
  Vec3 middle_{Vec3::Zero()};
  TreeMaterials materials_;
  Batch bark_, leaves_;
  bool built_{false};
  Vec3 sorted_for_{Vec3::Zero()};  // direction to the eye
};

/// Splits trees into groups of at most `most` that stand together: half by half, across the longer
/// side each time.
std::vector<std::vector<DrawnTree*>> splitByPlace(std::vector<DrawnTree*> trees, std::size_t most);

}  // namespace vegetation_sim::view
