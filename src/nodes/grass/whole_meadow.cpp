// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/whole_meadow.h"

#include <utility>

#include "ros/services/subscriptions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {

WholeMeadow::WholeMeadow(const grass::Layout& layout,
                         std::shared_ptr<const terrain::HeightMap> terrain,
                         const grass::TreadSettings& treading)
    : tread_(layout.map->law(), treading), field_(layout, std::move(terrain), treading, tread_) {}

void WholeMeadow::follow(bool is_wanted, ros::NodeHandle& handle,
                         const boost::function<void(const GrassState&)>& guarded) {
  if (is_wanted == static_cast<bool>(states_)) return;
  states_.shutdown();
  replica_.reset();
  tread_.clear();
  states_ = ros::Subscriber();
  if (!is_wanted) return;
  states_ = subscribeWithoutDelay<GrassState>(handle, "grass/state", 1000, guarded);
}

void WholeMeadow::apply(const GrassState& message) {
  const grass::TreadUpdate update = fromMsg(message);
  if (update.layout_hash == field_.layout().hash()) replica_.apply(update, tread_);
}

void WholeMeadow::reset() {
  field_.reset();
  replica_.reset();
}

}  // namespace vegetation_sim
