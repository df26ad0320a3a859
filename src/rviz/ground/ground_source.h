// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/GrassLayout.h>

#include <memory>
#include <string>

#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::view {

/// The ground of forest and meadow and its frame, from the layout that arrived last.
class GroundSource {
 public:
  explicit GroundSource(ros::NodeHandle nh);

  const terrain::HeightMap& ground() const { return *ground_; }
  /// Returns `map` before the first layout.
  const std::string& frame() const { return frame_; }

 private:
  void takeForest(const ForestLayout& message);
  void takeGrass(const GrassLayout& message);
  void take(const std::string& frame, const std::string& terrain);

  std::shared_ptr<const terrain::HeightMap> ground_;
  std::string frame_{"map"}, terrain_;
  ros::Subscriber forest_, grass_;
};

}  // namespace vegetation_sim::view
