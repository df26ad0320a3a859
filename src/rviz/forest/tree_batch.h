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

/// Names of the materials of trees, of trees that fade and of leaves near the eye.
struct TreeMaterials {
  std::string bark, leaves, fading_bark, fading_leaves, near_leaves;
};

/// Trees that stand together and are drawn with two batches, bark and leaves. Render thread only.
class TreeBatch {
 public:
  /// @param node at the origin of the trees.
  TreeBatch(std::vector<DrawnTree*> trees, Ogre::SceneNode& node, const TreeMaterials& materials);

  const std::vector<DrawnTree*>& trees() const { return trees_; }
  /// Middle of the feet in the frame of the layout [m].
  const Vec3& middle() const { return middle_; }

  /// Copies the changed meshes of the trees.
  void rebuild();
  /// Copies the positions or the colours of the trees.
  void takePositions();
  void takePaint();
  bool takeSeen();
  void setRank(int rank);
  /// Draws leaves with the material that suits their distance from a viewer (frame of the layout).
  void setEye(const Vec3& eye);
  /// Sorts leaves front to back for a viewer (frame of the layout), so that hidden ones cost
  /// little. Returns false if they are sorted for about this direction already.
  bool sortFor(const Vec3& eye);

  /// Stamp of the positions of the trees.
  Nanoseconds moved_to{-1};

 private:
  void wear();

  std::vector<DrawnTree*> trees_;
  Vec3 middle_{Vec3::Zero()};
  TreeMaterials materials_;
  Batch bark_, leaves_;
  bool built_{false}, fading_{false}, near_{false};
  Vec3 sorted_for_{Vec3::Zero()};  // direction to the viewer
};

/// Splits trees into groups of at most `most` neighbours, by halving across the longer side.
std::vector<std::vector<DrawnTree*>> splitByPlace(std::vector<DrawnTree*> trees, std::size_t most);

}  // namespace vegetation_sim::view
