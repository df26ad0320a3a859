// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/grab_tool.h"

#include <rviz/display_context.h>

#include <algorithm>
#include <cstdio>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "rviz/tools/mouse.h"

namespace vegetation_sim {
namespace {

constexpr double KEEP = 0.05;             // [s] between renewals of the lease
constexpr float GRAB_LINE_WIDTH = 0.02f;  // [m]
const Ogre::ColourValue SLACK(1.0f, 0.85f, 0.1f), TAUT(0.9f, 0.05f, 0.05f);

QString describe(const view::Grip& grip) {
  if (!grip.holding) return QString::fromStdString(grip.message);
  char text[120];
  std::snprintf(text, sizeof(text), "tree_%u/branch_%u, %.0f N", grip.tree, grip.branch,
                grip.force.norm());
  return text;
}

}  // namespace

GrabTool::GrabTool() : line_(GRAB_LINE_WIDTH) {
  shortcut_key_ = 'b';
  rviz::Property* to = getPropertyContainer();
  node_ = std::make_unique<rviz::StringProperty>(
      "Node", "/forest_animator", "Name of the forest_animator whose services are called", to);
  stiffness_ = std::make_unique<rviz::FloatProperty>(
      "Stiffness", 2000.0f, "Of the spring between mouse and branch [N/m]", to);
  damping_ = std::make_unique<rviz::FloatProperty>("Damping", 40.0f, "Of that spring [N s/m]", to);
  force_limit_ = std::make_unique<rviz::FloatProperty>("Force Limit", 200.0f,
                                                       "It pulls at most so hard [N]", to);
  reach_ = std::make_unique<rviz::FloatProperty>(
      "Reach", 0.1f, "A branch is met within this distance of its bark [m]", to);
  stiffness_->setMin(1.0f);
  stiffness_->setMax(1e6f);
  damping_->setMin(0.0f);
  damping_->setMax(1e5f);
  force_limit_->setMin(0.01f);
  force_limit_->setMax(1e5f);
  reach_->setMin(0.0f);
  reach_->setMax(1.0f);
}

GrabTool::~GrabTool() {
  if (hand_) hand_->release();
}

void GrabTool::onInitialize() {
  setName("Grab Branch");
  world_ = std::make_unique<view::GroundSource>(ros::NodeHandle());
}

void GrabTool::activate() {
  try {
    hand_ = std::make_shared<view::GrabClient>(ros::NodeHandle(), node_->getStdString());
  } catch (const ros::InvalidNameException& error) {
    setStatus(error.what());
  }
}

void GrabTool::deactivate() {
  line_.clear();
  if (hand_) hand_->release();
  hand_.reset();
}

view::Grip GrabTool::grip() const {
  return hand_ ? hand_->grip() : view::Grip();
}

view::Spring GrabTool::spring() const {
  return {static_cast<double>(stiffness_->getFloat()), static_cast<double>(damping_->getFloat()),
          static_cast<double>(force_limit_->getFloat())};
}

int GrabTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (!hand_) return 0;
  try {
    if (event.leftDown()) return take(event);
    if (event.left()) return pull(event);
  } catch (const std::runtime_error& error) {
    setStatus(error.what());
    return 0;
  }
  if (event.leftUp())
    hand_->release();
  else
    view::passToView(event);
  return Render;
}

int GrabTool::take(const rviz::ViewportMouseEvent& event) {
  hand_->take(view::rayOf(event, *context_, world_->frame()),
              static_cast<double>(reach_->getFloat()), spring());
  return Render;
}

// The plane faces the view and contains the point where the branch was grabbed.
int GrabTool::pull(const rviz::ViewportMouseEvent& event) {
  const view::Ray ray = view::rayOf(event, *context_, world_->frame());
  const Vec3 sight = view::sightOf(event, *context_, world_->frame());
  Vec3 target;
  if (view::meetPlane(ray, hand_->grip().start, sight, target)) hand_->follow(target);
  return Render;
}

void GrabTool::update(float wall_dt, float) {
  if (!hand_) return;
  since_kept_ += static_cast<double>(wall_dt);
  if (since_kept_ > KEEP) {
    since_kept_ = 0.0;
    hand_->keep();
  }
  const view::Grip grip = hand_->grip();
  drawPull(grip);
  setStatus(describe(grip));
}

void GrabTool::drawPull(const view::Grip& grip) {
  if (!grip.holding) {
    line_.clear();
    return;
  }
  const auto share = static_cast<float>(
      std::min(1.0, grip.force.norm() / static_cast<double>(force_limit_->getFloat())));
  line_.draw(*context_, world_->frame(), grip.point, grip.target, SLACK + share * (TAUT - SLACK));
}

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrabTool, rviz::Tool)
