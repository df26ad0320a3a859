// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ros/replicas/subscribed_meadow.h"
#include "rviz/grass/grass_visual.h"
#include "rviz/scenery/scenery_properties.h"

namespace rviz {
class IntProperty;
class RosTopicProperty;
}  // namespace rviz

namespace vegetation_sim::view {

/// The properties of GrassDisplay. They are children of the display, which owns them.
class GrassProperties : public SceneryProperties {
 public:
  /// @param display with the slots updateTopics(), updateLook(), updateGround(), updateSky(),
  /// updateSun() and updateHaze().
  explicit GrassProperties(rviz::Display& display);

  SubscribedMeadow::Topics topics() const;
  GrassVisual::Options options() const;

 private:
  void addTopics(rviz::Display& display);
  void addLook(rviz::Display& display);
  void addLevels(rviz::Display& display);

  rviz::RosTopicProperty *layout_, *wind_, *state_, *colours_;
  rviz::IntProperty* most_blades_;
  rviz::BoolProperty *blades_, *strips_, *edge_strips_, *colour_by_level_;
  rviz::FloatProperty *tolerance_, *farthest_, *transition_, *variety_;
};

}  // namespace vegetation_sim::view
