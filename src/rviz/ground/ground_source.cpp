// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/ground_source.h"

#include <exception>

#include "ros/params/resources.h"

namespace vegetation_sim::view {

GroundSource::GroundSource(ros::NodeHandle nh)
    : ground_(std::make_shared<const terrain::HeightMap>()),
      forest_(nh.subscribe("forest/layout", 1, &GroundSource::takeForest, this)),
      grass_(nh.subscribe("grass/layout", 1, &GroundSource::takeGrass, this)) {}

void GroundSource::takeForest(const ForestLayout& message) {
  take(message.header.frame_id, message.terrain);
}

void GroundSource::takeGrass(const GrassLayout& message) {
  take(message.header.frame_id, message.terrain);
}

void GroundSource::take(const std::string& frame, const std::string& terrain) {
  frame_ = frame;
  if (terrain == terrain_) return;
  try {
    ground_ = loadPublishedTerrain(terrain);
    terrain_ = terrain;
  } catch (const std::exception& error) {
    ROS_WARN("The mouse meets the ground as it was before: %s", error.what());
  }
}

}  // namespace vegetation_sim::view
