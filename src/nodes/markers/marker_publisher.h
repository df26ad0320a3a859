// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "core/shards/shard_split.h"
#include "nodes/markers/triangle_lists.h"
#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Builds the triangle lists of what a node animates. The sizes of the lists are its budget.
class MarkerBuilder {
 public:
  virtual ~MarkerBuilder() = default;
  /// Chooses levels of detail for the viewers and rebuilds the lists. A builder needs no viewers;
  /// it then takes a default one. @param stamp of the last tick.
  virtual void build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) = 0;
  const TriangleLists& lists() const { return lists_; }

 protected:
  TriangleLists lists_;
};

/// Publishes what a builder makes, while anyone subscribes.
class MarkerPublisher {
 public:
  MarkerPublisher(ros::NodeHandle handle, const std::string& topic, std::string frame_id,
                  MarkerBuilder& builder);

  bool isWanted() const { return publisher_.getNumSubscribers() > 0; }
  void publish(const std::vector<Viewpoint>& viewers, Nanoseconds stamp);
  /// Reports the points in use and their budget.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  ros::Publisher publisher_;
  std::string frame_id_;
  MarkerBuilder& builder_;
};

/// Returns the namespace of a list. Shards publish on one topic, each with namespaces of its own.
std::string namespaceOf(const std::string& list, const Shard& shard);

/// Returns the most pixels that a metre takes for any viewer, at a place or up to `reach` [m]
/// nearer.
double largestScale(const std::vector<Viewpoint>& viewers, const Vec3& place, double reach = 0.0);

}  // namespace vegetation_sim
