// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Vector3.h>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

Vec3 fromMsg(const geometry_msgs::Point& point);
Vec3 fromMsg(const geometry_msgs::Vector3& vector);
geometry_msgs::Point toPoint(const Vec3& point);
geometry_msgs::Vector3 toVector(const Vec3& vector);
Pose fromMsg(const geometry_msgs::Pose& pose);
geometry_msgs::Pose toMsg(const Pose& pose);
Pose fromMsg(const geometry_msgs::Transform& transform);

/// Pose `inner`, given in the frame `outer`, in the frame that `outer` is given in.
Pose compose(const Pose& outer, const Pose& inner);
Pose inverse(const Pose& pose);
Vec3 transformed(const Pose& frame, const Vec3& point);

}  // namespace vegetation_sim
