// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/marker_publisher.h"

#include <algorithm>
#include <utility>

namespace vegetation_sim {

MarkerPublisher::MarkerPublisher(ros::NodeHandle handle, const std::string& topic,
                                 std::string frame_id, MarkerBuilder& builder)
    : publisher_(handle.advertise<visualization_msgs::MarkerArray>(topic, 1)),
      frame_id_(std::move(frame_id)),
      builder_(builder) {}

void MarkerPublisher::publish(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) {
  builder_.build(viewers, stamp);
  publisher_.publish(builder_.lists().message(frame_id_));
}

void MarkerPublisher::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("Marker points", builder_.lists().used());
  status.add("Marker budget [points]", builder_.lists().budget());
}

std::string namespaceOf(const std::string& list, const Shard& shard) {
  return shard.count == 1 ? list : list + "_" + std::to_string(shard.index);
}

double largestScale(const std::vector<Viewpoint>& viewers, const Vec3& place, double reach) {
  double out = 0.0;
  for (const Viewpoint& viewer : viewers)
    out = std::max(out, pixelsPerMetre(viewer, length(viewer.position - place) - reach));
  return out;
}

}  // namespace vegetation_sim
