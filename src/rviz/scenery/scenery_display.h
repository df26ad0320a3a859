// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>

#include <memory>
#include <optional>
#include <string>

#include "rviz/ground/sky_visual.h"
#include "rviz/render/fog.h"
#include "rviz/scenery/budget_status_source.h"
#include "rviz/scenery/scene_claim.h"
#include "rviz/scenery/scenery_properties.h"
#include "rviz/scenery/status_board.h"
#include "rviz/scenery/viewer_publisher.h"

namespace vegetation_sim {

/// What the displays of a landscape have in common: they listen while enabled, draw at rviz's time,
/// say what they draw and why, and tell nodes where the view looks from. Ground, sky, haze and
/// viewer are given once in a scene, whoever else could (view::SceneOwnership). Everything runs in
/// rviz's render thread; while disabled a display holds no subscription and no Ogre object.
///
/// A kind of display overrides the functions below and calls stop() in its destructor.
class SceneryDisplay : public rviz::Display {
  Q_OBJECT
 public:
  void update(float wall_dt, float ros_dt) final;
  void reset() final;

 protected:
  /// @param ground_rank of its ground: the one that shows most of what is there wins.
  /// @param governor whose choice a status line tells; without a node's name there is none.
  explicit SceneryDisplay(int ground_rank, view::GovernorKeys governor = {});

  void onInitialize() final {}
  void onEnable() final;
  void onDisable() final;
  void stop();

  virtual const view::SceneryProperties& properties() const = 0;
  /// Subscribes. @throws ros::Exception
  virtual void open() = 0;
  /// Drops subscriptions and all that is drawn.
  virtual void close() = 0;
  /// Frame of what is to be drawn; none: nothing is yet.
  virtual std::optional<std::string> frame() const = 0;
  /// Called at the update rate once there is something to draw.
  virtual void draw(Nanoseconds stamp, const view::View& view) = 0;
  virtual void light(const view::Daylight& daylight, const view::Haze& haze) = 0;
  virtual void dropGround() = 0;
  /// Time went back to `now`.
  virtual void forgetState(Nanoseconds now) = 0;
  /// `now`: of the picture.
  virtual void showInputs(view::StatusBoard& board, Nanoseconds now) const = 0;
  /// What was drawn last, good if it is anything.
  virtual view::InputStatus describeDrawn() const = 0;

  /// Whether this display is the one to draw this ground. When that ends, dropGround() is called.
  bool givesGround(const terrain::HeightMap& terrain);
  /// From now on; a ground that is drawn is dropped.
  void setGroundRank(int rank);
  bool isOpen() const { return open_; }
  /// [s] runs while simulation time stands.
  double wall() const { return wall_; }

 protected Q_SLOTS:
  void updateTopics();
  /// Something is to be drawn in another way, or other things.
  virtual void updateLook() {}
  void updateGround();
  void updateSky();
  void updateSun();
  void updateHaze();
  void updateViewer();

 private:
  void start();
  void keepScenery();
  void watchTime(Nanoseconds stamp);
  void drawAt(Nanoseconds stamp);
  void publishViewer();
  void showStatus(Nanoseconds stamp);
  std::unique_ptr<view::SceneOwnership> ownership(view::Shared thing, std::uint64_t key = 0,
                                                  int rank = 0) const;

  int ground_rank_;
  view::GovernorKeys governor_keys_;
  bool open_{false}, gives_ground_{false};
  std::unique_ptr<view::SceneOwnership> ground_ownership_, sky_ownership_, fog_ownership_,
      viewer_ownership_;
  std::unique_ptr<view::SkyVisual> sky_;
  std::unique_ptr<view::Fog> air_;
  std::unique_ptr<view::ViewerPublisher> viewer_;
  std::unique_ptr<view::GovernorSource> governor_;
  view::StatusBoard board_;
  Nanoseconds last_stamp_{0};
  double since_update_{0.0}, since_status_{1e9}, wall_{1.0};  // [s]
};

}  // namespace vegetation_sim
