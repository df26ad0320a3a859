// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>

#include <memory>

#include "vegetation_sim/rviz/air.h"
#include "vegetation_sim/rviz/grass_properties.h"
#include "vegetation_sim/rviz/meadow_ground.h"
#include "vegetation_sim/rviz/sky_visual.h"
#include "vegetation_sim/rviz/status_board.h"

namespace vegetation_sim {

/// Rebuilds a meadow from its layout, its wind and its state, and draws it as it stands at rviz's
/// time: blades near the eye, strips farther away, a picture of the ground under and beyond them
/// (paper 2). Everything runs in rviz's render thread; while disabled it holds no subscription and
/// no Ogre object.
class GrassDisplay : public rviz::Display {
  Q_OBJECT
 public:
  GrassDisplay();
  ~GrassDisplay() override;

  void update(float wall_dt, float ros_dt) override;
  void reset() override;

  /// What was drawn last.
  view::GrassReport drawn() const;
  /// Tiles of the ground's picture that have tracks in them.
  std::size_t paintedTracks() const { return ground_ ? ground_->paintedTracks() : 0; }

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;

 private Q_SLOTS:
  void updateTopics();
  void updateLook();
  void updateGround();
  void updateSky();
  void updateSun();
  void updateHaze();

 private:
  void start();
  void stop();
  void draw(Nanoseconds stamp);
  void watchTime(Nanoseconds stamp);
  void makeGround();
  void showStatus(Nanoseconds stamp);

  std::unique_ptr<view::GrassProperties> properties_;
  std::unique_ptr<view::GrassSource> source_;
  std::unique_ptr<view::GrassVisual> grass_;
  std::unique_ptr<view::MeadowGround> ground_;
  std::unique_ptr<view::SkyVisual> sky_;
  std::unique_ptr<view::Air> air_;
  view::StatusBoard board_;
  int layouts_{0};
  Nanoseconds last_stamp_{0};
  double since_update_{0.0}, since_status_{1e9}, wall_{1.0};  // [s]
};

}  // namespace vegetation_sim
