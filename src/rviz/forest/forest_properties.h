// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ros/replicas/subscribed_forest.h"
#include "rviz/forest/forest_visual.h"
#include "rviz/scenery/scenery_properties.h"

namespace rviz {
class BoolProperty;
class Display;
class EnumProperty;
class FloatProperty;
class IntProperty;
class RosTopicProperty;
}  // namespace rviz

namespace vegetation_sim::view {

/// The properties of ForestDisplay. They are children of the display, which owns them.
class ForestProperties : public SceneryProperties {
 public:
  /// @param display with the slots updateTopics(), updateTrees(), updateLook(), updateGround(),
  /// updateSky(), updateSun(), updateHaze() and updateViewer().
  explicit ForestProperties(rviz::Display& display);

  SubscribedForest::Topics topics() const;
  std::string grabsTopic() const;
  ForestVisual::Options options() const;
  bool movesShadows() const;
  bool hasContactShadows() const;

 private:
  void addTopics(rviz::Display& display);
  void addLook(rviz::Display& display);

  rviz::RosTopicProperty *layout_, *wind_, *state_, *grabs_;
  rviz::IntProperty *triangles_, *most_trees_;
  rviz::BoolProperty *leaves_, *flutter_, *moving_shadows_, *contact_shadows_, *by_bough_;
  rviz::EnumProperty* colours_;
};

}  // namespace vegetation_sim::view
