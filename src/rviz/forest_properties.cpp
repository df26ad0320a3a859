// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/forest_properties.h"

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

}  // namespace

ForestProperties::ForestProperties(rviz::Display& display) {
  addTopics(display);
  addLook(display);
  addScenery(display, "Draw the terrain with grass and forest floor.");
  addViewer(display, "Tell the forest where this view looks from, so that what is seen moves.");
}

void ForestProperties::addTopics(rviz::Display& display) {
  layout_ = topic<ForestLayout>("Layout Topic", "forest/layout",
                                "vegetation_sim/ForestLayout: seeds of all trees.", display);
  wind_ = topic<WindField>("Wind Topic", "wind", "vegetation_sim/WindField: the law of the wind.",
                           display);
  state_ = topic<ForestState>("State Topic", "forest/state",
                              "vegetation_sim/ForestState: which joints move.", display);
}

void ForestProperties::addLook(rviz::Display& display) {
  triangles_ = new rviz::IntProperty(
      "Triangles", 130000,
      "How many triangles of trees in the picture to aim for. Levels of detail follow.", &display,
      SLOT(updateLook()), &display);
  triangles_->setMin(1000);
  triangles_->setMax(20000000);
  most_trees_ = new rviz::IntProperty("Most Trees", 1000, "The nearest so many trees are drawn.",
                                      &display, SLOT(updateTrees()), &display);
  most_trees_->setMin(1);
  most_trees_->setMax(20000);
  leaves_ = new rviz::BoolProperty("Leaves", true, "Draw leaves.", &display, SLOT(updateTrees()),
                                   &display);
  flutter_ = new rviz::BoolProperty("Flutter", true, "Leaves flutter where wind blows.", &display,
                                    SLOT(updateLook()), &display);
  colour_by_level_ = new rviz::BoolProperty(
      "Colour by Level", false,
      "Paint branches by their joint: red moves, green is between moving and fixed, blue is "
      "physical, bark is fixed.",
      &display, SLOT(updateLook()), &display);
  rate_ =
      new rviz::FloatProperty("Update Rate", 30.f, "Trees move at most so often [Hz].", &display);
  rate_->setMin(1.f);
  rate_->setMax(120.f);
}

ForestTopics ForestProperties::topics() const {
  return {layout_->getTopicStd(), wind_->getTopicStd(), state_->getTopicStd()};
}

ForestVisual::Options ForestProperties::options() const {
  ForestVisual::Options out;
  out.look = {leaves_->getBool(), flutter_->getBool(), colour_by_level_->getBool()};
  out.target_triangles = triangles_->getInt();
  out.most_trees = static_cast<std::size_t>(most_trees_->getInt());
  return out;
}

double ForestProperties::updatePeriod() const {
  return 1.0 / static_cast<double>(rate_->getFloat());
}

}  // namespace vegetation_sim::view
