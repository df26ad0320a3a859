// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/grass_display.h"

#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/view_manager.h>

#include <pluginlib/class_list_macros.hpp>

#include "vegetation_sim/ros/stamps.h"
#include "vegetation_sim/rviz/view_of.h"

namespace vegetation_sim {
namespace {

constexpr double STATUS_PERIOD = 0.5;                           // [s]
constexpr Nanoseconds JUMP_BACK = NANOSECONDS_PER_SECOND / 10;  // less is jitter

}  // namespace

GrassDisplay::GrassDisplay()
    : properties_(std::make_unique<view::GrassProperties>(*this)), board_(*this) {}

GrassDisplay::~GrassDisplay() {
  stop();
}

void GrassDisplay::onInitialize() {}

void GrassDisplay::onEnable() {
  start();
}

void GrassDisplay::onDisable() {
  stop();
  clearStatuses();
  board_.forget();
}

void GrassDisplay::reset() {
  rviz::Display::reset();
  board_.forget();
  if (!isEnabled()) return;
  stop();
  start();
}

void GrassDisplay::start() {
  try {
    source_ = std::make_unique<view::GrassSource>(update_nh_, properties_->topics());
    deleteStatus("Topics");
  } catch (const ros::Exception& error) {
    setStatusStd(rviz::StatusProperty::Error, "Topics", error.what());
    return;
  }
  layouts_ = 0;
  last_stamp_ = 0;
  updateSun();
}

void GrassDisplay::stop() {
  air_.reset();
  ground_.reset();
  sky_.reset();
  grass_.reset();
  source_.reset();
}

void GrassDisplay::updateTopics() {
  if (isEnabled() && initialized()) reset();
}

void GrassDisplay::updateLook() {
  if (grass_) grass_->repaint();
}

// Made anew at the next update.
void GrassDisplay::updateGround() {
  ground_.reset();
}

void GrassDisplay::updateSky() {
  sky_.reset();
  if (source_ && properties_->sky())
    sky_ = std::make_unique<view::SkyVisual>(*scene_node_, properties_->daylight());
}

void GrassDisplay::updateSun() {
  updateSky();
  updateGround();
  updateHaze();
}

void GrassDisplay::updateHaze() {
  air_.reset();
  if (!source_) return;
  const view::Daylight daylight = properties_->daylight();
  const view::Haze haze = properties_->hazeValues();
  if (properties_->haze())
    air_ = std::make_unique<view::Air>(
        *scene_manager_, context_->getViewManager()->getRenderPanel(), haze, daylight.horizon);
  if (grass_) grass_->light(daylight, haze);
  if (ground_) ground_->light(daylight, haze);
}

void GrassDisplay::update(float wall_dt, float /*ros_dt*/) {
  if (!source_) return;
  const double dt = static_cast<double>(wall_dt);
  wall_ += dt;
  since_update_ += dt;
  since_status_ += dt;
  if (since_update_ < 0.9 * properties_->updatePeriod()) return;
  since_update_ = 0.0;
  const auto stamp = static_cast<Nanoseconds>(context_->getFrameManager()->getTime().toNSec());
  watchTime(stamp);
  if (source_->ready() && stamp > 0 &&
      view::placeInFixedFrame(*context_, source_->frame(), *scene_node_, board_))
    draw(stamp);
  if (since_status_ < STATUS_PERIOD) return;
  since_status_ = 0.0;
  source_->prune(stamp);
  showStatus(stamp);
}

void GrassDisplay::draw(Nanoseconds stamp) {
  const std::optional<view::View> view = view::viewOf(*context_, *scene_node_);
  if (!view) return;
  if (sky_) sky_->follow(view->eye.position);
  if (!grass_ || layouts_ != source_->layouts()) {
    layouts_ = source_->layouts();
    grass_.reset();
    ground_.reset();
    grass_ = std::make_unique<view::GrassVisual>(*scene_node_, *source_);
    grass_->light(properties_->daylight(), properties_->hazeValues());
  }
  grass_->update(*source_, stamp, wall_, *view, properties_->options());
  makeGround();
  if (!ground_) return;
  ground_->update(*source_, source_->takePressed(), stamp);
  ground_->darken(grass_->bladesReach());
}

void GrassDisplay::watchTime(Nanoseconds stamp) {
  // Half: the state may be ahead of the picture's clock, by less than the jump.
  if (stamp + JUMP_BACK < last_stamp_) source_->forgetState(stamp + JUMP_BACK / 2);
  last_stamp_ = stamp;
}

void GrassDisplay::makeGround() {
  if (ground_ || !properties_->ground()) return;
  const view::Daylight daylight = properties_->daylight();
  ground_ = std::make_unique<view::MeadowGround>(*scene_node_, *source_, daylight,
                                                 properties_->groundTint());
  ground_->light(daylight, properties_->hazeValues());
}

view::GrassReport GrassDisplay::drawn() const {
  return grass_ ? grass_->report() : view::GrassReport();
}

void GrassDisplay::showStatus(Nanoseconds stamp) {
  board_.show("Layout", source_->layoutStatus());
  board_.show("Wind", source_->windStatus());
  board_.show("State", source_->stateStatus());
  if (stamp == 0)
    board_.show(rviz::StatusProperty::Warn, "Time", "Waiting for /clock: nothing is drawn");
  else
    board_.show(rviz::StatusProperty::Ok, "Time", "OK");
  const view::GrassReport report = drawn();
  const std::string text = view::describe(report);
  ROS_DEBUG_STREAM(getNameStd() << ": " << text);
  board_.show(report.tiles > 0 ? rviz::StatusProperty::Ok : rviz::StatusProperty::Warn, "Drawn",
              text);
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrassDisplay, rviz::Display)
