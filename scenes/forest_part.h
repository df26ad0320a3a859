// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "scenes/hashing.h"
#include "scenes/scenario.h"
#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/forest/forest_replica.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::scenes {

/// The trees of a scene, and two replicas that follow them by their updates: one as sensors do, one
/// as displays do.
class ForestPart {
 public:
  ForestPart(const Scenario& scenario, int threads);

  void setWind(const wind::Field& wind);
  void setEye(const Viewpoint& eye) { forest_.setViewers({eye}); }
  void advance(Nanoseconds stamp, bool key_frame);
  void addTo(Hashes& hashes);

  forest::Forest& forest() { return forest_; }
  /// What sensors perceive.
  const forest::ForestReplica& replica() const { return replica_; }
  const forest::Tree& tree(std::uint32_t id) const { return trees_[id]; }
  /// The last branch of a recursion depth, at most the deepest one.
  int lastBranch(std::uint32_t tree, int depth) const;
  forest::BranchPoint tipPoint(std::uint32_t tree, int branch) const;
  /// Returns the world position of a point of a branch [m].
  Vec3 place(const forest::BranchPoint& point) const;
  /// Height of the highest tip of a tree above its foot [m].
  double height(std::uint32_t tree) const;

 private:
  void poseAsDrawn(std::uint32_t id, const wind::Instant& wind, Nanoseconds stamp,
                   forest::BatchPoses& out) const;
  void addMesh(const forest::BatchPoses& poses, Hash& hash) const;

  forest::Forest forest_;
  forest::ForestReplica replica_, shown_;
  std::vector<forest::Tree> trees_;
  std::vector<forest::BatchPoser> posers_;
  forest::TreeMesh mesh_;  ///< of tree 0
  Nanoseconds stamp_{START};
};

}  // namespace vegetation_sim::scenes
