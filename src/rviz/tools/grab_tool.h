// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>
#include <rviz/tool.h>

#include <memory>

#include "rviz/ground/ground_source.h"
#include "rviz/tools/grab_client.h"
#include "rviz/tools/tool_line.h"

namespace vegetation_sim {

/// Mouse tool: a click grabs the branch under the cursor, dragging pulls it in the plane of the
/// view, and releasing the button releases it. A line shows the pull.
class GrabTool : public rviz::Tool {
  Q_OBJECT
 public:
  GrabTool();
  ~GrabTool() override;

  void onInitialize() override;
  void activate() override;
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;
  void update(float wall_dt, float ros_dt) override;

  /// Returns what is held, or nothing while the tool is inactive.
  view::Grip grip() const;

 private:
  int take(const rviz::ViewportMouseEvent& event);
  int pull(const rviz::ViewportMouseEvent& event);
  void drawPull(const view::Grip& grip);
  view::Spring spring() const;

  std::unique_ptr<rviz::StringProperty> node_;
  std::unique_ptr<rviz::FloatProperty> stiffness_, damping_, force_limit_, reach_;
  std::unique_ptr<view::GroundSource> world_;
  std::shared_ptr<view::GrabClient> hand_;
  view::ToolLine line_;
  double since_kept_{0.0};  // [s]
};

}  // namespace vegetation_sim
