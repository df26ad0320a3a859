// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreCamera.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <vegetation_sim/Viewer.h>

#include <string>

namespace vegetation_sim::view {

/// Converts a camera to a Viewer message: x forward, y left, z up (REP 103). Header and id stay
/// empty.
/// @param height of the picture [pixel].
Viewer viewerOf(const Ogre::Camera& camera, unsigned int height);

/// Returns whether a viewer has moved by 1 cm, turned by 0.5 degrees or zoomed.
bool differs(const Viewer& a, const Viewer& b);

/// Publishes the camera for the nodes that choose levels of detail: on change, at most ten times a
/// second, and at least once a second.
class ViewerPublisher {
 public:
  ViewerPublisher(ros::NodeHandle nh, const std::string& topic, const std::string& id);

  /// @param wall wall time [s].
  void update(Viewer viewer, const std::string& frame, double wall);

 private:
  ros::Publisher publisher_;
  std::string id_;
  Viewer last_;
  double sent_{-1e9};
};

}  // namespace vegetation_sim::view
