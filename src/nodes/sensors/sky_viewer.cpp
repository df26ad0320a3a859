// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/sensors/sky_viewer.h"

#include <algorithm>

#include "ros/conversions/scan_conversions.h"
#include "sensors/sky_view.h"

namespace vegetation_sim {

std::vector<SkyViewer::Group> SkyViewer::groupsOf(const std::vector<Vec3>& places) const {
  std::vector<Group> out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto group = std::find_if(out.begin(), out.end(), [&](const Group& each) {
      return length(places[i] - each.centre) <= options_.sky_range;
    });
    if (group == out.end()) group = out.insert(out.end(), Group{places[i], 0.0, {}});
    group->radius = std::max(group->radius, length(places[i] - group->centre));
    group->places.push_back(i);
  }
  return out;
}

scan::Scene& SkyViewer::sceneOf(std::size_t group) {
  const std::size_t index = std::min(group, most_scenes_ - 1);
  while (scenes_.size() <= index) scenes_.push_back(makeScene(options_));
  return scenes_[index];
}

std::vector<SkyView> SkyViewer::view(const std::vector<Vec3>& places, Nanoseconds stamp) {
  std::vector<SkyView> out(places.size());
  left_out_ = 0;
  const std::vector<Group> groups = groupsOf(places);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    scan::Scene& scene = sceneOf(g);
    landscape_.update(groups[g].centre, groups[g].radius + options_.sky_range, stamp, scene,
                      threads_);
    for (const std::size_t i : groups[g].places)
      out[i] = toSkyView(scan::viewSky(scene, places[i], options_.sky_range, threads_), places[i],
                         scene);
    left_out_ += scene.trees.leftOut() + scene.plants.leftOut() + scene.crowns.leftOut();
  }
  return out;
}

}  // namespace vegetation_sim
