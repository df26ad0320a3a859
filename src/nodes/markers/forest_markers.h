// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "forest/forest.h"
#include "forest/tree_cache.h"
#include "nodes/markers/marker_publisher.h"
#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim {

/// Builds the marker lists of a forest: bark (id 0) and leaves (id 1). A feedback lowers the
/// geometry levels of the trees until they fit into the budget; the farthest that do not fit are
/// left out.
class ForestMarkers : public MarkerBuilder {
 public:
  /// @param cache of grown trees. @param points most points of both lists together, at least 600.
  ForestMarkers(const forest::Forest& forest, forest::TreeCache& cache, int points);

  /// The trees next to the viewers are finest. Without viewers, it uses the middle of the forest.
  void build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) override;
  /// Forgets the meshes, because the layout has changed.
  void reset();

 private:
  struct Drawn {
    int level{-1};
    std::shared_ptr<const forest::TreeMesh> mesh;
    forest::BrokenBranches broken;  ///< what had come off the tree
  };
  void chooseTrees(std::vector<Viewpoint> viewers);
  void keepLargest(std::size_t count);
  void addTree(std::uint32_t id, Nanoseconds stamp);

  enum List : std::size_t { BARK, LEAVES };
  const forest::Forest& forest_;
  forest::TreeCache& cache_;
  std::size_t wanted_bark_{0}, wanted_leaves_{0};  // points
  forest::ComplexityFeedback feedback_;
  std::map<std::uint32_t, Drawn> drawn_;
  std::vector<std::pair<double, std::uint32_t>> order_;  // height [pixel], tree
  double least_{0.0};                                    // smaller trees are not drawn [pixel]
  forest::BatchPoses poses_;
  std::vector<float> scratch_;
};

}  // namespace vegetation_sim
