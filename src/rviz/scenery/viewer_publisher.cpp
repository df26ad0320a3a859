// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/viewer_publisher.h"

#include <rviz/validate_floats.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

constexpr double SHORTEST = 0.1, LONGEST = 0.8;  // [s] between messages
constexpr double MOVED = 0.01;                   // [m]
constexpr double TURNED = 0.0087;                // [rad]
constexpr double ZOOMED = 0.002;                 // [rad]

}  // namespace

Viewer viewerOf(const Ogre::Camera& camera, unsigned int height) {
  Viewer out;
  const Ogre::Vector3 position = camera.getDerivedPosition();
  // Ogre's camera looks along -z, with x to the right.
  const Ogre::Vector3 right = camera.getDerivedRight(), up = camera.getDerivedUp();
  const Ogre::Quaternion orientation(camera.getDerivedDirection(), -right, up);
  out.pose.position.x = static_cast<double>(position.x);
  out.pose.position.y = static_cast<double>(position.y);
  out.pose.position.z = static_cast<double>(position.z);
  Ogre::Quaternion unit = orientation;
  unit.normalise();
  out.pose.orientation.w = static_cast<double>(unit.w);
  out.pose.orientation.x = static_cast<double>(unit.x);
  out.pose.orientation.y = static_cast<double>(unit.y);
  out.pose.orientation.z = static_cast<double>(unit.z);
  out.field_of_view = static_cast<double>(camera.getFOVy().valueRadians());
  out.height = std::max(1u, height);
  return out;
}

bool differs(const Viewer& a, const Viewer& b) {
  const auto& p = a.pose.position;
  const auto& q = b.pose.position;
  if (std::hypot(std::hypot(p.x - q.x, p.y - q.y), p.z - q.z) > MOVED) return true;
  const auto& r = a.pose.orientation;
  const auto& s = b.pose.orientation;
  const double cosine = std::fabs(r.w * s.w + r.x * s.x + r.y * s.y + r.z * s.z);
  if (2.0 * std::acos(std::min(1.0, cosine)) > TURNED) return true;
  return std::fabs(a.field_of_view - b.field_of_view) > ZOOMED || a.height != b.height;
}

ViewerPublisher::ViewerPublisher(ros::NodeHandle nh, const std::string& topic,
                                 const std::string& id)
    : publisher_(nh.advertise<Viewer>(topic, 10)), id_(id) {}

void ViewerPublisher::update(Viewer viewer, const std::string& frame, double wall) {
  const double since = wall - sent_;
  if (since < SHORTEST) return;
  if (since < LONGEST && !differs(viewer, last_) && frame == last_.header.frame_id) return;
  if (!rviz::validateFloats(viewer.pose)) return;
  viewer.header.frame_id = frame;
  viewer.header.stamp = ros::Time::now();
  viewer.id = id_;
  publisher_.publish(viewer);
  last_ = viewer;
  sent_ = wall;
}

}  // namespace vegetation_sim::view
