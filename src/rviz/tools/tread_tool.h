// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/publisher.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/tool.h>

#include <memory>

#include "rviz/ground/ground_source.h"

namespace vegetation_sim {

/// Mouse tool: dragging across grass treads it.
class TreadTool : public rviz::Tool {
  Q_OBJECT
 public:
  TreadTool();
  ~TreadTool() override;

  void onInitialize() override;
  void activate() override;
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 private:
  void tread(const rviz::ViewportMouseEvent& event, bool first);
  void lift();

  std::unique_ptr<rviz::StringProperty> topic_;
  std::unique_ptr<rviz::FloatProperty> radius_, recovery_;
  std::unique_ptr<view::GroundSource> world_;
  ros::Publisher publisher_;
  Vec3 last_{Vec3::Zero()};
  bool down_{false};
};

}  // namespace vegetation_sim
