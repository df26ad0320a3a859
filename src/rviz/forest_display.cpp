// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/forest_display.h"

#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <unistd.h>

#include <pluginlib/class_list_macros.hpp>

#include "vegetation_sim/ros/stamps.h"
#include "vegetation_sim/rviz/view_of.h"

namespace vegetation_sim {
namespace {

constexpr double STATUS_PERIOD = 0.5;                           // [s]
constexpr int GROUND_EDGE = 1024;                               // [pixel] of the ground's picture
constexpr double GROUND_CELL = 3.0;                             // [m] of its mesh
constexpr Nanoseconds JUMP_BACK = NANOSECONDS_PER_SECOND / 10;  // less is jitter

}  // namespace

ForestDisplay::ForestDisplay()
    : properties_(std::make_unique<view::ForestProperties>(*this)), board_(*this) {}

ForestDisplay::~ForestDisplay() {
  stop();
}

void ForestDisplay::onInitialize() {}

void ForestDisplay::onEnable() {
  start();
}

void ForestDisplay::onDisable() {
  stop();
  clearStatuses();
  board_.forget();
}

void ForestDisplay::reset() {
  rviz::Display::reset();
  board_.forget();
  if (!isEnabled()) return;
  stop();
  start();
}

void ForestDisplay::start() {
  try {
    source_ = std::make_unique<view::ForestSource>(update_nh_, properties_->topics());
    deleteStatus("Topics");
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Topics", error.what());
    return;
  }
  forest_ = std::make_unique<view::ForestVisual>(*scene_node_);
  layouts_ = 0;
  last_stamp_ = 0;
  updateSun();
  updateViewer();
}

void ForestDisplay::stop() {
  viewer_.reset();
  air_.reset();
  ground_.reset();
  grounded_ = -1;
  sky_.reset();
  forest_.reset();
  source_.reset();
}

void ForestDisplay::updateTopics() {
  if (isEnabled() && initialized()) reset();
}

// Grown anew: other trees, or other light among them.
void ForestDisplay::updateTrees() {
  layouts_ = 0;
}

void ForestDisplay::updateLook() {
  if (forest_) forest_->repaint();
}

// Made anew at the next update.
void ForestDisplay::updateGround() {
  ground_.reset();
  grounded_ = -1;
}

void ForestDisplay::updateSky() {
  sky_.reset();
  if (forest_ && properties_->sky())
    sky_ = std::make_unique<view::SkyVisual>(*scene_node_, properties_->daylight());
}

void ForestDisplay::updateSun() {
  updateSky();
  updateHaze();
  updateTrees();
}

void ForestDisplay::updateHaze() {
  air_.reset();
  if (!forest_) return;
  const view::Daylight daylight = properties_->daylight();
  const view::Haze haze = properties_->hazeValues();
  if (properties_->haze())
    air_ = std::make_unique<view::Air>(
        *scene_manager_, context_->getViewManager()->getRenderPanel(), haze, daylight.horizon);
  forest_->light(daylight, daylight.to_sun, haze);
  if (ground_) ground_->light(daylight, daylight.to_sun, haze);
}

void ForestDisplay::updateViewer() {
  viewer_.reset();
  if (!forest_ || !properties_->publishesViewer()) return;
  const std::string id = "rviz_" + std::to_string(getpid()) + "_" + getNameStd();
  try {
    viewer_ = std::make_unique<view::ViewerPublisher>(update_nh_, properties_->viewerTopic(), id);
    deleteStatus("Viewer");
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Viewer", error.what());
  }
}

void ForestDisplay::update(float wall_dt, float /*ros_dt*/) {
  if (!source_ || !forest_) return;
  const double dt = static_cast<double>(wall_dt);
  wall_ += dt;
  since_update_ += dt;
  since_status_ += dt;
  publishViewer();
  if (since_update_ < 0.9 * properties_->updatePeriod()) return;
  since_update_ = 0.0;
  const auto stamp = static_cast<Nanoseconds>(context_->getFrameManager()->getTime().toNSec());
  watchTime(stamp);
  if (source_->replica().ready() && stamp > 0 &&
      view::placeInFixedFrame(*context_, source_->frame(), *scene_node_, board_))
    draw(stamp);
  if (since_status_ < STATUS_PERIOD) return;
  since_status_ = 0.0;
  showStatus(stamp);
}

void ForestDisplay::draw(Nanoseconds stamp) {
  const std::optional<view::View> found = view::viewOf(*context_, *scene_node_);
  if (!found) return;
  const view::View& view = *found;
  if (sky_) sky_->follow(view.eye.position);
  if (layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    forest_->restart(source_->replica(), view, properties_->options());
  }
  forest_->update(source_->replica(), stamp, view, properties_->daylight(), properties_->options());
  makeGround();
}

void ForestDisplay::watchTime(Nanoseconds stamp) {
  // Half: the state may be ahead of the picture's clock, by less than the jump.
  if (stamp + JUMP_BACK < last_stamp_) source_->forgetState(stamp + JUMP_BACK / 2);
  last_stamp_ = stamp;
}

void ForestDisplay::makeGround() {
  const view::TreeStock* stock = forest_->stock();
  if (stock == nullptr || !properties_->ground() || grounded_ == forest_->stocks()) return;
  ground_.reset();
  const view::Daylight daylight = properties_->daylight();
  const terrain::HeightMap& terrain = source_->replica().terrain();
  const view::Plot plot = view::plotAround(stock->extent());
  const view::Rgba tint = properties_->groundTint();
  const view::Picture picture =
      view::groundPicture(plot, GROUND_EDGE, *stock, terrain, daylight, tint);
  const view::Land land{plot, picture, terrain, stock->origin(), GROUND_CELL, tint};
  ground_ = std::make_unique<view::GroundVisual>(*scene_node_, land, daylight);
  ground_->light(daylight, daylight.to_sun, properties_->hazeValues());
  grounded_ = forest_->stocks();
}

void ForestDisplay::publishViewer() {
  rviz::ViewController* controller = context_->getViewManager()->getCurrent();
  if (!viewer_ || controller == nullptr || controller->getCamera() == nullptr) return;
  const rviz::RenderPanel* panel = context_->getViewManager()->getRenderPanel();
  const int height = panel != nullptr ? panel->height() : 900;
  viewer_->update(view::viewerOf(*controller->getCamera(), static_cast<unsigned>(height)),
                  fixed_frame_.toStdString(), wall_);
}

view::ForestReport ForestDisplay::drawn() const {
  return forest_ ? forest_->report() : view::ForestReport();
}

void ForestDisplay::showStatus(Nanoseconds stamp) {
  board_.show("Layout", source_->layoutStatus());
  board_.show("Wind", source_->windStatus());
  board_.show("State", source_->stateStatus());
  if (stamp == 0)
    board_.show(rviz::StatusProperty::Warn, "Time", "Waiting for /clock: nothing is drawn");
  else
    board_.show(rviz::StatusProperty::Ok, "Time", "OK");
  const view::ForestReport report = drawn();
  const std::string text = view::describe(report);
  ROS_DEBUG_STREAM(getNameStd() << ": " << text);
  board_.show(report.trees > 0 ? rviz::StatusProperty::Ok : rviz::StatusProperty::Warn, "Drawn",
              text);
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::ForestDisplay, rviz::Display)
