// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/tread_tool.h"

#include <ros/names.h>
#include <ros/node_handle.h>
#include <vegetation_sim/TreadEvent.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "rviz/tools/mouse.h"
#include "terrain/ground_ray.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double FARTHEST_GROUND = 300.0;  // [m] the tool ignores ground beyond
constexpr double STEP = 0.02;              // [m] between events

}  // namespace

TreadTool::TreadTool() {
  shortcut_key_ = 't';
  rviz::Property* to = getPropertyContainer();
  topic_ = std::make_unique<rviz::StringProperty>("Topic", "tread", "TreadEvents go there", to);
  radius_ =
      std::make_unique<rviz::FloatProperty>("Radius", 0.25f, "Half width of the track [m]", to);
  recovery_ = std::make_unique<rviz::FloatProperty>(
      "Recovery", 0.0f, "Until the grass stands again; 0: as the meadow has it [s]", to);
  radius_->setMin(0.005f);
  radius_->setMax(5.0f);
  recovery_->setMin(0.0f);
}

TreadTool::~TreadTool() = default;

void TreadTool::onInitialize() {
  setName("Tread Grass");
  world_ = std::make_unique<view::GroundSource>(ros::NodeHandle());
}

void TreadTool::activate() {
  try {
    publisher_ = ros::NodeHandle().advertise<TreadEvent>(topic_->getStdString(), 100);
  } catch (const ros::InvalidNameException& error) {
    setStatus(error.what());
  }
}

void TreadTool::deactivate() {
  lift();
  publisher_.shutdown();
}

int TreadTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (event.leftUp())
    lift();
  else if (event.left())
    tread(event, event.leftDown());
  else
    view::passToView(event);
  return Render;
}

void TreadTool::tread(const rviz::ViewportMouseEvent& event, bool first) {
  if (!publisher_) return;
  Vec3 place;
  try {
    const view::Ray ray = view::rayOf(event, *context_, world_->frame());
    if (!terrain::meetGround(world_->ground(), ray.origin, ray.direction, FARTHEST_GROUND, place))
      return;
  } catch (const std::runtime_error& error) {
    setStatus(error.what());
    return;
  }
  if (!first && down_ && (place - last_).norm() < STEP) return;
  TreadEvent message;
  message.header.frame_id = world_->frame();
  message.source = ros::this_node::getName() + "/mouse";
  message.action = first || !down_ ? TreadEvent::PLACE : TreadEvent::MOVE;
  message.position = toPoint(place);
  message.law.radius = static_cast<double>(radius_->getFloat());
  message.law.has_radius = true;
  message.law.recovery = static_cast<double>(recovery_->getFloat());
  message.law.has_recovery = message.law.recovery > 0.0;
  publisher_.publish(message);
  last_ = place;
  down_ = true;
}

void TreadTool::lift() {
  if (!down_ || !publisher_) return;
  TreadEvent message;
  message.header.frame_id = world_->frame();
  message.source = ros::this_node::getName() + "/mouse";
  message.action = TreadEvent::LIFT;
  message.position = toPoint(last_);
  publisher_.publish(message);
  down_ = false;
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::TreadTool, rviz::Tool)
