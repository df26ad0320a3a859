// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/orientation.h"

#include <cmath>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim {

Quat orientationOf(const geometry_msgs::Quaternion& q, const std::string& name, Faults& faults) {
  const double norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const std::string fault = rangeFault(name + ", its norm,", norm, "", {0.99, 1.01});
  if (!fault.empty()) {
    faults.add(fault);
    return {};
  }
  const double scale = std::fabs(norm - 1.0) < 1e-12 ? 1.0 : 1.0 / norm;
  return {scale * q.w, scale * q.x, scale * q.y, scale * q.z};
}

}  // namespace vegetation_sim
