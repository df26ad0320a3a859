// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/canopy/canopy_visual.h"
#include "rviz/scenery/scenery_properties.h"

namespace rviz {
class IntProperty;
}

namespace vegetation_sim::view {

/// The properties of CanopyDisplay. They are children of the display, which owns them.
class CanopyProperties : public SceneryProperties {
 public:
  explicit CanopyProperties(rviz::Display& display);

  SubscribedCanopy::Topics topics() const;
  CanopyVisual::Options options() const;

 private:
  rviz::RosTopicProperty *layout_, *state_, *forest_layout_, *forest_state_, *wind_;
  rviz::IntProperty* most_leaves_;
  rviz::FloatProperty *tolerance_, *pictures_;
};

}  // namespace vegetation_sim::view
