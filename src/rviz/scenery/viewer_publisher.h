// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreCamera.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <vegetation_sim/Viewer.h>

#include <string>

namespace vegetation_sim::view {

/// A camera as a Viewer message: x forward, y left, z up (REP 103). Header and id are left empty.
/// @param height of the picture [pixel].
Viewer viewerOf(const Ogre::Camera& camera, unsigned int height);

/// True if an eye has moved by 1 cm, turned by 0.5 degrees or zoomed.
bool differs(const Viewer& a, const Viewer& b);

/// Tells who computes levels of detail where the user looks from: on change, at most ten times a
/// second, and at least once each second.
class ViewerPublisher {
 public:
  ViewerPublisher(ros::NodeHandle nh, const std::string& topic, const std::string& id);

  /// @param wall [s] any clock that runs while simulation time stands.
  void update(Viewer viewer, const std::string& frame, double wall);

 private:
  ros::Publisher publisher_;
  std::string id_;
  Viewer last_;
  double sent_{-1e9};
};

}  // namespace vegetation_sim::view
