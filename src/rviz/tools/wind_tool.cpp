// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/wind_tool.h"

#include <rviz/display_context.h>
#include <vegetation_sim/SetWindPrimitive.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "rviz/tools/mouse.h"
#include "terrain/ground_ray.h"
#include "vegetation_sim/ros/conversions/stamps.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double FARTHEST_WIND = 500.0;   // [m] the tool draws nothing beyond
constexpr double LIFTED = 0.3;            // [m] height of the line above the ground
constexpr float WIND_LINE_WIDTH = 0.15f;  // [m]

std::unique_ptr<rviz::FloatProperty> metres(const char* name, float value, float low, float high,
                                            const char* help, rviz::Property* to) {
  auto out = std::make_unique<rviz::FloatProperty>(name, value, help, to);
  out->setMin(low);
  out->setMax(high);
  return out;
}

}  // namespace

WindTool::WindTool() : line_(WIND_LINE_WIDTH) {
  shortcut_key_ = 'w';
  rviz::Property* to = getPropertyContainer();
  node_ = std::make_unique<rviz::StringProperty>(
      "Node", "/wind_broadcaster", "Name of the wind_broadcaster whose services are called", to);
  kind_ = std::make_unique<rviz::EnumProperty>("Kind", "Gust", "What a stroke makes", to);
  kind_->addOption("Gust", GUST);
  kind_->addOption("Tornado", TORNADO);
  speed_ = metres("Speed", 12.0f, 0.1f, 60.0f,
                  "Of the air; a stroke of some length gives that of a gust [m/s]", to);
  radius_ =
      metres("Radius", 15.0f, 1.0f, 200.0f, "Half width of a gust, reach of a tornado [m]", to);
  duration_ = metres("Duration", 20.0f, 1.0f, 3600.0f, "Of a tornado [s]", to);
}

WindTool::~WindTool() = default;

void WindTool::onInitialize() {
  setName("Make Wind");
  world_ = std::make_unique<view::GroundSource>(ros::NodeHandle());
}

void WindTool::deactivate() {
  line_.clear();
  drawing_ = false;
}

void WindTool::setKind(Kind kind) {
  kind_->setString(kind == GUST ? "Gust" : "Tornado");
}

bool WindTool::place(const rviz::ViewportMouseEvent& event, Vec3& out) {
  try {
    const view::Ray ray = view::rayOf(event, *context_, world_->frame());
    return terrain::meetGround(world_->ground(), ray.origin, ray.direction, FARTHEST_WIND, out);
  } catch (const std::runtime_error& error) {
    setStatus(error.what());
    return false;
  }
}

int WindTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (event.leftDown()) {
    drawing_ = place(event, stroke_.from);
    stroke_.to = stroke_.from;
  } else if (event.left() && drawing_) {
    place(event, stroke_.to);
    drawStroke();
  } else if (event.leftUp() && drawing_) {
    place(event, stroke_.to);
    blow();
    deactivate();
  } else {
    view::passToView(event);
  }
  return Render;
}

void WindTool::blow() {
  stroke_.speed = static_cast<double>(speed_->getFloat());
  stroke_.radius = static_cast<double>(radius_->getFloat());
  stroke_.duration = static_cast<double>(duration_->getFloat());
  const Nanoseconds now = fromMsg(ros::Time::now());
  SetWindPrimitive service;
  service.request.primitive = toMsg(kind_->getOptionInt() == GUST ? view::gustOf(stroke_, now)
                                                                  : view::tornadoOf(stroke_, now));
  for (geometry_msgs::PointStamped& point : service.request.primitive.trajectory)
    point.header.frame_id = world_->frame();
  const std::string name = node_->getStdString() + "/set_primitive";
  std::string why;
  if (!ros::names::validate(name, why)) return answer_->give(why);
  tasks_.add([answer = answer_, service, name]() mutable {
    const bool answered = ros::service::call(name, service);
    answer->give(answered ? service.response.message : "no answer from " + name);
  });
}

void WindTool::update(float, float) {
  if (const auto answer = answer_->take()) setStatus(QString::fromStdString(*answer));
}

void WindTool::drawStroke() {
  const Vec3 lift(0.0, 0.0, LIFTED);
  line_.draw(*context_, world_->frame(), stroke_.from + lift, stroke_.to + lift,
             Ogre::ColourValue(0.4f, 0.8f, 1.0f));
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::WindTool, rviz::Tool)
