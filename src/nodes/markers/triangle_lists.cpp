// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/triangle_lists.h"

#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

using visualization_msgs::Marker;

void TriangleLists::addList(const std::string& ns, std::size_t size, Padding padding) {
  Marker marker;
  marker.ns = ns;
  marker.id = static_cast<std::int32_t>(lists_.size());
  marker.type = Marker::TRIANGLE_LIST;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = opaque(Vec3::Ones());
  marker.points.reserve(size);
  marker.colors.reserve(size);
  lists_.push_back({marker, size, padding});
}

void TriangleLists::clear(std::size_t list) {
  lists_[list].marker.points.clear();
  lists_[list].marker.colors.clear();
}

void TriangleLists::add(std::size_t list, const Vec3& point, const std_msgs::ColorRGBA& colour) {
  lists_[list].marker.points.push_back(toPoint(point));
  lists_[list].marker.colors.push_back(colour);
}

std::size_t TriangleLists::used() const {
  std::size_t out = 0;
  for (const List& list : lists_) out += list.marker.points.size();
  return out;
}

std::size_t TriangleLists::budget() const {
  std::size_t out = 0;
  for (const List& list : lists_) out += list.size;
  return out;
}

visualization_msgs::MarkerArray TriangleLists::message(const std::string& frame_id) const {
  visualization_msgs::MarkerArray out;
  for (const List& list : lists_) {
    if (list.size == 0) continue;
    out.markers.push_back(list.marker);
    Marker& marker = out.markers.back();
    marker.header.frame_id = frame_id;
    if (marker.points.empty()) {
      marker.action = Marker::DELETE;
    } else {
      const bool first = list.padding == Padding::FIRST_POINT;
      marker.points.resize(list.size, first ? marker.points.front() : geometry_msgs::Point());
      marker.colors.resize(list.size);
    }
  }
  return out;
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
