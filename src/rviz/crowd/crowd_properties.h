// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/crowd/crowd_visual.h"
#include "rviz/scenery/scenery_properties.h"

namespace rviz {
class IntProperty;
}

namespace vegetation_sim::view {

/// The properties of CrowdDisplay. They are children of the display, which owns them.
class CrowdProperties : public SceneryProperties {
 public:
  explicit CrowdProperties(rviz::Display& display);

  std::string topic() const;
  CrowdVisual::Options options() const;

 private:
  rviz::RosTopicProperty* topic_;
  rviz::IntProperty* most_people_;
  rviz::FloatProperty* detail_;
  rviz::BoolProperty *shadows_, *contact_shadows_;
};

}  // namespace vegetation_sim::view
