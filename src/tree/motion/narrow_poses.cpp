// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/motion/narrow_poses.h"

#include <algorithm>

namespace vegetation_sim::forest {

void narrow(const std::vector<Pose>& poses, BatchPoses& out) {
  out.count = static_cast<int>(poses.size());
  for (std::vector<float>* part : {&out.x, &out.y, &out.z, &out.qw, &out.qx, &out.qy, &out.qz})
    part->resize(std::max(part->size(), poses.size() + BatchPoser::PADDING));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3& at = poses[i].position;
    const Quat& turn = poses[i].orientation;
    out.x[i] = static_cast<float>(at.x());
    out.y[i] = static_cast<float>(at.y());
    out.z[i] = static_cast<float>(at.z());
    out.qw[i] = static_cast<float>(turn.w);
    out.qx[i] = static_cast<float>(turn.x);
    out.qy[i] = static_cast<float>(turn.y);
    out.qz[i] = static_cast<float>(turn.z);
  }
}

}  // namespace vegetation_sim::forest
