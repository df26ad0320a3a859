// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>

#include <memory>
#include <optional>
#include <string>

#include "ros/time/backward_step.h"
#include "rviz/render/fog.h"
#include "rviz/scenery/budget_status_source.h"
#include "rviz/scenery/robot_shadows.h"
#include "rviz/scenery/scene_ownership.h"
#include "rviz/scenery/scenery_properties.h"
#include "rviz/scenery/sky_visual.h"
#include "rviz/scenery/status_board.h"
#include "rviz/scenery/viewer_publisher.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim {

/// Base class of the displays. A display subscribes while it is enabled, draws at rviz's time,
/// reports its status, and publishes the viewer. Ground, sky, haze and viewer exist once in a scene
/// (view::SceneOwnership). Everything runs in rviz's render thread; a disabled display holds no
/// subscription and no Ogre object.
///
/// A derived class overrides the virtual functions and calls stop() in its destructor.
class SceneryDisplay : public rviz::Display {
  Q_OBJECT
 public:
  void update(float wall_dt, float ros_dt) final;
  void reset() final;

 protected:
  /// @param ground_rank priority of its ground: the most complete ground is drawn.
  /// @param governor node whose budget a status line reports; an empty name omits the line.
  explicit SceneryDisplay(int ground_rank, view::GovernorKeys governor = {});

  void onInitialize() final {}
  void onEnable() final;
  void onDisable() final;
  void stop();

  virtual const view::SceneryProperties& properties() const = 0;
  /// Subscribes. @throws ros::Exception
  virtual void open() = 0;
  /// Drops subscriptions and everything that is drawn.
  virtual void close() = 0;
  /// Returns the frame of what is drawn, or nothing before the first layout.
  virtual std::optional<std::string> frame() const = 0;
  /// Is called at the update rate once there is something to draw.
  virtual void draw(Nanoseconds stamp, const view::View& view) = 0;
  virtual void light(const view::Daylight& daylight, const view::Haze& haze) = 0;
  virtual void dropGround() = 0;
  /// Is called when time has gone back to `now`.
  virtual void forgetState(Nanoseconds now) = 0;
  /// `now` is the time of the picture.
  virtual void showInputs(view::StatusBoard& board, Nanoseconds now) const = 0;
  /// Reports what was drawn last; it is good if anything was drawn.
  virtual InputStatus describeDrawn() const = 0;

  /// Returns whether this display draws this ground. When that ends, dropGround() is called.
  bool givesGround(const terrain::HeightMap& terrain);
  /// Sets the rank from now on and drops a ground that is drawn.
  void setGroundRank(int rank);
  /// Wall time [s]; it advances while simulation time stands.
  double wall() const { return wall_; }
  /// Wall time between the last two frames of the picture [s].
  double frameTime() const { return frame_time_; }

 protected Q_SLOTS:
  void updateTopics();
  /// Is called when settings of the appearance have changed.
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
  void drawRobotShadows(const std::string& frame);
  void showStatus(Nanoseconds stamp);
  std::unique_ptr<view::SceneOwnership> ownership(view::Shared thing, std::uint64_t key = 0,
                                                  int rank = 0) const;

  int ground_rank_;
  view::GovernorKeys governor_keys_;
  bool open_{false}, gives_ground_{false};
  const terrain::HeightMap* terrain_{nullptr};  // of the ground, during an update
  std::unique_ptr<view::SceneOwnership> ground_ownership_, sky_ownership_, fog_ownership_,
      viewer_ownership_;
  std::unique_ptr<view::SkyVisual> sky_;
  std::unique_ptr<view::Fog> air_;
  std::unique_ptr<view::RobotShadows> robot_shadows_;
  std::unique_ptr<view::ViewerPublisher> viewer_;
  std::unique_ptr<view::GovernorSource> governor_;
  view::StatusBoard board_;
  BackwardStep clock_times_;
  std::string problem_;                                       // that ended the last update early
  double frame_time_{0.0};                                    // [s]
  double since_update_{0.0}, since_status_{1e9}, wall_{1.0};  // [s]
};

}  // namespace vegetation_sim
