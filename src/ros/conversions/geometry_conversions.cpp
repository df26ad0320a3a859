// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {

Vec3 fromMsg(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}

Vec3 fromMsg(const geometry_msgs::Vector3& vector) {
  return {vector.x, vector.y, vector.z};
}

geometry_msgs::Point toPoint(const Vec3& point) {
  geometry_msgs::Point out;
  out.x = point.x();
  out.y = point.y();
  out.z = point.z();
  return out;
}

geometry_msgs::Vector3 toVector(const Vec3& vector) {
  geometry_msgs::Vector3 out;
  out.x = vector.x();
  out.y = vector.y();
  out.z = vector.z();
  return out;
}

Pose fromMsg(const geometry_msgs::Pose& pose) {
  const geometry_msgs::Quaternion& q = pose.orientation;
  return {fromMsg(pose.position), {q.w, q.x, q.y, q.z}};
}

geometry_msgs::Pose toMsg(const Pose& pose) {
  geometry_msgs::Pose out;
  out.position = toPoint(pose.position);
  out.orientation.w = pose.orientation.w;
  out.orientation.x = pose.orientation.x;
  out.orientation.y = pose.orientation.y;
  out.orientation.z = pose.orientation.z;
  return out;
}

Pose fromMsg(const geometry_msgs::Transform& transform) {
  const geometry_msgs::Quaternion& q = transform.rotation;
  return {fromMsg(transform.translation), {q.w, q.x, q.y, q.z}};
}

Pose compose(const Pose& outer, const Pose& inner) {
  return {transformed(outer, inner.position), outer.orientation * inner.orientation};
}

Pose inverse(const Pose& pose) {
  const Quat back = conjugate(pose.orientation);
  return {rotate(back, -pose.position), back};
}

Vec3 transformed(const Pose& frame, const Vec3& point) {
  return frame.position + rotate(frame.orientation, point);
}

}  // namespace vegetation_sim
