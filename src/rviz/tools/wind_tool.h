// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/service_client.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/tool.h>

#include <memory>
#include <string>

#include "rviz/ground/ground_source.h"
#include "rviz/tools/async_tasks.h"
#include "rviz/tools/tool_line.h"
#include "rviz/tools/wind_stroke.h"

namespace vegetation_sim {

/// Mouse tool: a stroke on the ground starts a gust or a tornado along it.
class WindTool : public rviz::Tool {
  Q_OBJECT
 public:
  enum Kind { GUST = 0, TORNADO = 1 };

  WindTool();
  ~WindTool() override;

  void onInitialize() override;
  void activate() override {}
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;
  void update(float wall_dt, float ros_dt) override;

  void setKind(Kind kind);

 private:
  bool place(const rviz::ViewportMouseEvent& event, Vec3& out);
  void drawStroke();
  void blow();

  std::unique_ptr<rviz::StringProperty> node_;
  std::unique_ptr<rviz::EnumProperty> kind_;
  std::unique_ptr<rviz::FloatProperty> speed_, radius_, duration_;
  std::unique_ptr<view::GroundSource> world_;
  view::ToolLine line_;
  view::WindStroke stroke_;
  bool drawing_{false};
  std::shared_ptr<view::Answer> answer_{std::make_shared<view::Answer>()};  // of the service call
  view::AsyncTasks tasks_;
};

}  // namespace vegetation_sim
