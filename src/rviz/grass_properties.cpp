// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/grass_properties.h"

#include <ros/message_traits.h>
#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>

namespace vegetation_sim::view {
namespace {

template <class Message>
rviz::RosTopicProperty* topic(const char* name, const char* value, const char* help,
                              rviz::Display& display) {
  return new rviz::RosTopicProperty(
      name, value, QString::fromStdString(ros::message_traits::datatype<Message>()), help, &display,
      SLOT(updateTopics()), &display);
}

rviz::FloatProperty* number(const char* name, float value, const char* help, float low, float high,
                            rviz::Display& display) {
  auto* out = new rviz::FloatProperty(name, value, help, &display, SLOT(updateLook()), &display);
  out->setMin(low);
  out->setMax(high);
  return out;
}

}  // namespace

GrassProperties::GrassProperties(rviz::Display& display) {
  addTopics(display);
  addLook(display);
  addLevels(display);
  addScenery(display, "Draw the terrain with the colours of the meadow and the tracks in it.");
}

void GrassProperties::addTopics(rviz::Display& display) {
  layout_ = topic<GrassLayout>("Layout Topic", "grass/layout",
                               "vegetation_sim/GrassLayout: the map of the meadow.", display);
  wind_ = topic<WindField>("Wind Topic", "wind", "vegetation_sim/WindField: the law of the wind.",
                           display);
  state_ = topic<GrassState>("State Topic", "grass/state",
                             "vegetation_sim/GrassState: what is trodden.", display);
}

void GrassProperties::addLook(rviz::Display& display) {
  const auto flag = [&](const char* name, bool value, const char* help) {
    return new rviz::BoolProperty(name, value, help, &display, SLOT(updateLook()), &display);
  };
  most_blades_ = new rviz::IntProperty(
      "Blades", 25000,
      "How many single blades to draw in the picture at most. Farther blades become fewer and "
      "wider, then strips.",
      &display, SLOT(updateLook()), &display);
  most_blades_->setMin(1000);
  most_blades_->setMax(2000000);
  blades_ = flag("Single Blades", true, "Draw blades near the eye.");
  strips_ = flag("Strips", true, "Draw strips and layers farther away.");
  variety_ =
      number("Variety", 1.f, "How much colours differ from blade to blade.", 0.f, 2.f, display);
  colour_by_level_ =
      flag("Colour by Level", false, "Paint blades red, strips blue and layers violet.");
  rate_ = number("Update Rate", 30.f, "Grass moves at most so often [Hz].", 1.f, 120.f, display);
}

void GrassProperties::addLevels(rviz::Display& display) {
  tolerance_ = number("Tolerance", 2.f, "What a level of detail may leave out [pixel].", 0.1f,
                      100.f, display);
  farthest_ = number("Farthest", 160.f, "Beyond, grass is only a picture on the ground [m].", 1.f,
                     10000.f, display);
  transition_ =
      number("Transition", 0.5f, "Time from one level to the next [s].", 0.f, 60.f, display);
}

GrassTopics GrassProperties::topics() const {
  return {layout_->getTopicStd(), wind_->getTopicStd(), state_->getTopicStd()};
}

GrassVisual::Options GrassProperties::options() const {
  GrassVisual::Options out;
  out.levels.tolerance = static_cast<double>(tolerance_->getFloat());
  out.levels.transition = static_cast<double>(transition_->getFloat());
  out.levels.farthest = static_cast<double>(farthest_->getFloat());
  out.levels.most_blades = most_blades_->getInt();
  out.variety = variety_->getFloat();
  out.blades = blades_->getBool();
  out.strips = strips_->getBool();
  out.colour_by_level = colour_by_level_->getBool();
  return out;
}

double GrassProperties::updatePeriod() const {
  return 1.0 / static_cast<double>(rate_->getFloat());
}

}  // namespace vegetation_sim::view
