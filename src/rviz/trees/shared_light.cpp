// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/shared_light.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vegetation_sim::view {
namespace {

std::vector<const SharedLight*>& allLights() {
  static std::vector<const SharedLight*> lights;
  return lights;
}

int& countOfChanges() {
  static int count = 0;
  return count;
}

}  // namespace

SharedLight::SharedLight(const Ogre::SceneManager* scene, std::string frame,
                         std::shared_ptr<const forest::LightGrid> grid)
    : scene_(scene), frame_(std::move(frame)), grid_(std::move(grid)) {
  allLights().push_back(this);
  ++countOfChanges();
}

SharedLight::~SharedLight() {
  std::vector<const SharedLight*>& all = allLights();
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
  ++countOfChanges();
}

int SharedLight::changes() {
  return countOfChanges();
}

SharedLight::Shares SharedLight::at(const Ogre::SceneManager* scene, const std::string& frame,
                                    const Vec3& place) {
  Shares out;
  for (const SharedLight* light : allLights()) {
    if (light->scene_ != scene || light->frame_ != frame) continue;
    out.sun *= light->grid_->sun(place);
    out.sky *= light->grid_->sky(place);
  }
  return out;
}

}  // namespace vegetation_sim::view
