// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/scenery_display.h"

#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <unistd.h>

#include <functional>
#include <utility>

#include "rviz/scenery/frame_transform.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double STATUS_PERIOD = 0.5;  // [s]

}  // namespace

SceneryDisplay::SceneryDisplay(int ground_rank, view::GovernorKeys governor)
    : ground_rank_(ground_rank), governor_keys_(std::move(governor)), board_(*this) {}

void SceneryDisplay::onEnable() {
  start();
}

void SceneryDisplay::onDisable() {
  stop();
  clearStatuses();
  board_.forget();
}

void SceneryDisplay::reset() {
  rviz::Display::reset();
  board_.forget();
  if (!isEnabled()) return;
  stop();
  start();
}

void SceneryDisplay::start() {
  try {
    open();
    if (!governor_keys_.node.empty())
      governor_ = std::make_unique<view::GovernorSource>(update_nh_, governor_keys_);
    deleteStatus("Topics");
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Topics", error.what());
    close();
    return;
  }
  open_ = true;
  clock_times_ = BackwardStep();
  updateSun();
  updateViewer();
}

void SceneryDisplay::stop() {
  open_ = gives_ground_ = false;
  governor_.reset();
  viewer_.reset();
  air_.reset();
  sky_.reset();
  robot_shadows_.reset();
  close();
  for (auto* ownership : {&ground_ownership_, &sky_ownership_, &fog_ownership_, &viewer_ownership_})
    ownership->reset();
}

void SceneryDisplay::updateTopics() {
  if (isEnabled() && initialized()) reset();
}

std::unique_ptr<view::SceneOwnership> SceneryDisplay::ownership(view::Shared thing,
                                                                std::uint64_t key, int rank) const {
  return std::make_unique<view::SceneOwnership>(*scene_manager_, thing, key, rank, *this);
}

// The next update builds it again.
void SceneryDisplay::updateGround() {
  ground_ownership_.reset();
  gives_ground_ = false;
  dropGround();
}

void SceneryDisplay::setGroundRank(int rank) {
  ground_rank_ = rank;
  updateGround();
}

bool SceneryDisplay::givesGround(const terrain::HeightMap& terrain) {
  if (!properties().ground()) return false;
  if (!ground_ownership_ || ground_ownership_->key() != terrain.hash()) {
    updateGround();  // the terrain may have changed
    ground_ownership_ = ownership(view::Shared::GROUND, terrain.hash(), ground_rank_);
  }
  gives_ground_ = ground_ownership_->holds();
  if (gives_ground_) terrain_ = &terrain;
  return gives_ground_;
}

void SceneryDisplay::updateSky() {
  sky_.reset();
  sky_ownership_.reset();
  if (open_ && properties().sky()) sky_ownership_ = ownership(view::Shared::SKY);
  keepScenery();
}

void SceneryDisplay::updateSun() {
  updateSky();
  updateGround();
  updateHaze();
}

void SceneryDisplay::updateHaze() {
  air_.reset();
  fog_ownership_.reset();
  if (!open_) return;
  if (properties().haze()) fog_ownership_ = ownership(view::Shared::AIR);
  keepScenery();
  light(properties().daylight(), properties().hazeValues());
}

void SceneryDisplay::updateViewer() {
  viewer_.reset();
  viewer_ownership_.reset();
  if (!open_ || !properties().publishesViewer()) return;
  const std::string topic = properties().viewerTopic();
  viewer_ownership_ = ownership(view::Shared::VIEWER, std::hash<std::string>()(topic));
}

// This display may take over what another one has provided until now.
void SceneryDisplay::keepScenery() {
  if (!sky_ && sky_ownership_ && sky_ownership_->holds())
    sky_ = std::make_unique<view::SkyVisual>(*scene_node_, properties().daylight());
  if (!air_ && fog_ownership_ && fog_ownership_->holds())
    air_ =
        std::make_unique<view::Fog>(*scene_manager_, context_->getViewManager()->getRenderPanel(),
                                    properties().hazeValues(), properties().daylight().horizon);
  if (gives_ground_ && !ground_ownership_->holds()) {
    gives_ground_ = false;
    dropGround();
  }
}

void SceneryDisplay::update(float wall_dt, float /*ros_dt*/) {
  if (!open_) return;
  const double dt = static_cast<double>(wall_dt);
  wall_ += dt;
  frame_time_ = dt;
  since_update_ += dt;
  since_status_ += dt;
  publishViewer();
  if (since_update_ < 0.9 * properties().updatePeriod()) return;
  since_update_ = 0.0;
  const auto stamp = static_cast<Nanoseconds>(context_->getFrameManager()->getTime().toNSec());
  watchTime(stamp);
  try {
    keepScenery();
    if (stamp > 0) drawAt(stamp);
    problem_.clear();
  } catch (const std::exception& error) {  // it must not end rviz
    problem_ = error.what();
  }
  if (since_status_ < STATUS_PERIOD) return;
  since_status_ = 0.0;
  showStatus(stamp);
}

void SceneryDisplay::drawAt(Nanoseconds stamp) {
  const std::optional<std::string> frame = this->frame();
  if (!frame || !view::placeInFixedFrame(*context_, *frame, *scene_node_, board_)) return;
  const std::optional<view::View> view = view::viewOf(*context_, *scene_node_);
  if (!view) return;
  if (sky_) sky_->follow(view->eye.position);
  terrain_ = nullptr;
  draw(stamp, *view);
  drawRobotShadows(*frame);
}

// They lie on the ground of this display.
void SceneryDisplay::drawRobotShadows(const std::string& frame) {
  if (terrain_ == nullptr || !gives_ground_ || !properties().hasRobotShadows())
    return robot_shadows_.reset();
  if (!robot_shadows_) robot_shadows_ = std::make_unique<view::RobotShadows>(*scene_node_);
  robot_shadows_->update(*context_, frame, *terrain_, properties().daylight(),
                         properties().hazeValues());
}

void SceneryDisplay::watchTime(Nanoseconds stamp) {
  // The state may be ahead of the picture's clock by less than the jump, hence half of it.
  if (clock_times_.jumpsBackTo(stamp)) forgetState(stamp + BackwardStep::LARGEST_STEP / 2);
}

void SceneryDisplay::publishViewer() {
  if (!viewer_ownership_ || !viewer_ownership_->holds()) return;
  try {
    const std::string id = "rviz_" + std::to_string(getpid()) + "_" + getNameStd();
    if (!viewer_)
      viewer_ = std::make_unique<view::ViewerPublisher>(update_nh_, properties().viewerTopic(), id);
    deleteStatus("Viewer");
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Viewer", error.what());
    viewer_ownership_.reset();
    return;
  }
  rviz::ViewController* controller = context_->getViewManager()->getCurrent();
  if (controller == nullptr || controller->getCamera() == nullptr) return;
  const rviz::RenderPanel* panel = context_->getViewManager()->getRenderPanel();
  const int height = panel != nullptr ? panel->height() : 900;
  viewer_->update(view::viewerOf(*controller->getCamera(), static_cast<unsigned>(height)),
                  fixed_frame_.toStdString(), wall_);
}

void SceneryDisplay::showStatus(Nanoseconds stamp) {
  showInputs(board_, stamp);
  if (governor_)
    if (const auto status = governor_->status(wall_)) board_.show("Governor", *status);
  if (stamp == 0)
    board_.show(rviz::StatusProperty::Warn, "Time", "Waiting for /clock: nothing is drawn");
  else
    board_.show(rviz::StatusProperty::Ok, "Time", "OK");
  std::string others;
  const std::pair<const char*, const view::SceneOwnership*> things[] = {
      {"ground", ground_ownership_.get()},
      {"sky", sky_ownership_.get()},
      {"haze", fog_ownership_.get()}};
  for (const auto& [name, ownership] : things)
    if (ownership != nullptr && !ownership->holds())
      others += (others.empty() ? "" : ", ") + std::string(name) + " by " +
                ownership->giver().getNameStd();
  board_.show(rviz::StatusProperty::Ok, "Scenery", others.empty() ? "As set here" : others);
  const InputStatus drawn =
      problem_.empty() ? describeDrawn() : InputStatus{false, "Not drawn: " + problem_};
  ROS_DEBUG_STREAM(getNameStd() << ": " << drawn.text);
  board_.show("Drawn", drawn);
}

}  // namespace vegetation_sim
