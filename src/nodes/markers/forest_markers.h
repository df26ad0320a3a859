// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "forest/forest.h"
#include "forest/tree_cache.h"
#include "nodes/markers/triangle_lists.h"
#include "tree/mesh/mesh.h"

namespace vegetation_sim {

/// Builds the marker lists of a forest: bark (id 0) and leaves (id 1). A feedback lowers the
/// geometry levels of the trees until they fit into the budget; the farthest that do not fit are
/// left out.
class ForestMarkers {
 public:
  /// @param points most points of both lists together, at least 600.
  explicit ForestMarkers(int points);

  /// Builds the array at `stamp`, with the trees next to the viewers finest. Without viewers, it
  /// uses the middle of the forest.
  visualization_msgs::MarkerArray build(const forest::Forest& forest, forest::TreeCache& cache,
                                        const std::string& frame_id, Nanoseconds stamp);
  /// Points in use at the last build.
  std::size_t points() const { return lists_.used(); }
  std::size_t budget() const { return lists_.size(BARK) + lists_.size(LEAVES); }
  void reset();

 private:
  struct Drawn {
    int level{-1};
    std::shared_ptr<const forest::TreeMesh> mesh;
  };
  void chooseTrees(const forest::Forest& forest);
  void keepLargest(std::size_t count);
  void addTree(const forest::Forest& forest, forest::TreeCache& cache, std::uint32_t id,
               Nanoseconds stamp);

  enum List : std::size_t { BARK, LEAVES };
  TriangleLists lists_;
  std::size_t wanted_bark_{0}, wanted_leaves_{0};  // points
  forest::ComplexityFeedback feedback_;
  std::map<std::uint32_t, Drawn> drawn_;
  std::vector<std::pair<double, std::uint32_t>> order_;  // height [pixel], tree
  double least_{0.0};                                    // smaller trees are not drawn [pixel]
  forest::BatchPoses poses_;
  std::vector<float> scratch_;
};

}  // namespace vegetation_sim
