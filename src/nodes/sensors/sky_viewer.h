// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/SkyView.h>

#include <vector>

#include "nodes/sensors/scanner_options.h"
#include "ros/landscape/landscape_replica.h"

namespace vegetation_sim {

/// Views of the sky from any places of the landscape. Places within the range of the first one of a
/// group share its scene, so that each object near them is posed once.
class SkyViewer {
 public:
  /// @param most_scenes number of groups that keep their trees from call to call; further groups
  /// use the last scene in turn and generate trees again.
  SkyViewer(const ScanOptions& options, LandscapeReplica& landscape, ThreadPool& threads,
            std::size_t most_scenes)
      : options_(options), landscape_(landscape), threads_(threads), most_scenes_(most_scenes) {}

  /// Returns a view per place, without the name of a frame.
  /// @param stamp that of the landscape's last advance().
  std::vector<SkyView> view(const std::vector<Vec3>& places, Nanoseconds stamp);
  /// Forgets all trees.
  void clear() { scenes_.clear(); }
  /// Returns the number of trees and plants that exceeded a budget in the last call, over all
  /// places.
  std::size_t leftOut() const { return left_out_; }

 private:
  struct Group {
    Vec3 centre{Vec3::Zero()};
    double radius{0.0};                 ///< of a ball that contains the places [m]
    std::vector<std::size_t> places{};  ///< indices
  };
  std::vector<Group> groupsOf(const std::vector<Vec3>& places) const;
  scan::Scene& sceneOf(std::size_t group);

  const ScanOptions& options_;
  LandscapeReplica& landscape_;
  ThreadPool& threads_;
  std::size_t most_scenes_, left_out_{0};
  std::vector<scan::Scene> scenes_;
};

}  // namespace vegetation_sim
