// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/triangle_list.h"

namespace vegetation_sim {

visualization_msgs::Marker triangleList(const std::string& ns, int id, std::size_t points) {
  visualization_msgs::Marker out;
  out.ns = ns;
  out.id = id;
  out.type = visualization_msgs::Marker::TRIANGLE_LIST;
  out.action = visualization_msgs::Marker::ADD;
  out.pose.orientation.w = 1.0;
  out.scale.x = out.scale.y = out.scale.z = 1.0;
  out.color.r = out.color.g = out.color.b = out.color.a = 1.f;
  out.points.resize(points);
  out.colors.resize(points);
  return out;
}

void takeAwayIfUnused(visualization_msgs::Marker& list, std::size_t used) {
  if (used > 0) return;
  list.action = visualization_msgs::Marker::DELETE;
  list.points.clear();
  list.colors.clear();
}

std_msgs::ColorRGBA opaque(const Vec3& rgb) {
  std_msgs::ColorRGBA out;
  out.r = static_cast<float>(rgb.x());
  out.g = static_cast<float>(rgb.y());
  out.b = static_cast<float>(rgb.z());
  out.a = 1.f;
  return out;
}

}  // namespace vegetation_sim
