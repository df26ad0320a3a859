// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>

#include <memory>
#include <string>

#include "vegetation_sim/rviz/air.h"
#include "vegetation_sim/rviz/forest_properties.h"
#include "vegetation_sim/rviz/forest_source.h"
#include "vegetation_sim/rviz/forest_visual.h"
#include "vegetation_sim/rviz/ground_visual.h"
#include "vegetation_sim/rviz/sky_visual.h"
#include "vegetation_sim/rviz/status_board.h"
#include "vegetation_sim/rviz/viewer_publisher.h"

namespace vegetation_sim {

/// Rebuilds a forest from its layout, its wind and its state, and draws it as it stands at rviz's
/// time. Tells the forest where the view looks from. Everything runs in rviz's render thread; while
/// disabled it holds no subscription and no Ogre object.
class ForestDisplay : public rviz::Display {
  Q_OBJECT
 public:
  ForestDisplay();
  ~ForestDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;

  /// What was drawn last.
  view::ForestReport drawn() const;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void updateTopics();
  void updateTrees();
  void updateLook();
  void updateGround();
  void updateSky();
  void updateSun();
  void updateHaze();
  void updateViewer();

 private:
  void start();
  void stop();
  void draw(Nanoseconds stamp);
  void watchTime(Nanoseconds stamp);
  void makeGround();
  void publishViewer();
  void showStatus(Nanoseconds stamp);

  std::unique_ptr<view::ForestProperties> properties_;
  std::unique_ptr<view::ForestSource> source_;
  std::unique_ptr<view::ForestVisual> forest_;
  std::unique_ptr<view::GroundVisual> ground_;
  std::unique_ptr<view::SkyVisual> sky_;
  std::unique_ptr<view::Air> air_;
  std::unique_ptr<view::ViewerPublisher> viewer_;
  view::StatusBoard board_;
  int layouts_{0};
  int grounded_{-1};  // stock of trees that the ground was made for
  Nanoseconds last_stamp_{0};
  double since_update_{0.0}, since_status_{1e9}, wall_{0.0};  // [s]
};

}  // namespace vegetation_sim
