// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/scenery/scenery_properties.h"
#include "rviz/wind/wind_mesh.h"

namespace vegetation_sim::view {

/// The properties of WindDisplay. They are children of the display, which owns them.
class WindProperties : public SceneryProperties {
 public:
  explicit WindProperties(rviz::Display& display);

  std::string topic() const;
  WindStyle style() const;
  bool arrows() const;
  bool shapes() const;

 private:
  rviz::RosTopicProperty* topic_;
  rviz::BoolProperty *arrows_, *shapes_, *red_discs_;
  rviz::FloatProperty *spacing_, *extent_, *height_, *scale_, *full_speed_;
};

}  // namespace vegetation_sim::view
