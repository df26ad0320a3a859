// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/forest_properties.h"

#include <ros/message_traits.h>
#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include "vegetation_sim/common/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double DEGREE = PI / 180.0;
const QColor GRASS(150, 160,
                   90);  // shown as the ground's colour; its lightness is the ground's own

template <class Message>
rviz::RosTopicProperty* topic(const char* name, const char* value, const char* help,
                              rviz::Display& display) {
  return new rviz::RosTopicProperty(
      name, value, QString::fromStdString(ros::message_traits::datatype<Message>()), help, &display,
      SLOT(updateTopics()), &display);
}

rviz::FloatProperty* number(const char* name, float value, const char* help, float low, float high,
                            rviz::Property* parent, const char* slot, rviz::Display& display) {
  auto* out = new rviz::FloatProperty(name, value, help, parent, slot, &display);
  out->setMin(low);
  out->setMax(high);
  return out;
}

}  // namespace

ForestProperties::ForestProperties(rviz::Display& display) {
  addTopics(display);
  addLook(display);
  addScenery(display);
  addViewer(display);
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

void ForestProperties::addScenery(rviz::Display& display) {
  const auto flag = [&](const char* name, const char* help, const char* slot) {
    return new rviz::BoolProperty(name, true, help, &display, slot, &display);
  };
  ground_ = flag("Ground", "Draw the terrain with grass and forest floor.", SLOT(updateGround()));
  ground_colour_ = new rviz::ColorProperty("Colour", GRASS, "Colour of grass.", ground_,
                                           SLOT(updateGround()), &display);
  sky_ = flag("Sky", "Draw a sky with clouds.", SLOT(updateSky()));
  azimuth_ = number("Sun Azimuth", 215.f, "Where the sun stands: 0 is east, 90 north [deg].",
                    -360.f, 360.f, sky_, SLOT(updateSun()), display);
  elevation_ = number("Sun Elevation", 38.f, "Height of the sun over the horizon [deg].", 8.f, 90.f,
                      sky_, SLOT(updateSun()), display);
  haze_ = flag("Haze", "Let far things fade into the air.", SLOT(updateHaze()));
  haze_start_ = number("Start", 40.f, "Nearer things are clear [m].", 0.f, 10000.f, haze_,
                       SLOT(updateHaze()), display);
  haze_end_ = number("End", 450.f, "Farther things have all of the haze [m].", 1.f, 100000.f, haze_,
                     SLOT(updateHaze()), display);
  haze_most_ = number("Strength", 0.9f, "All of the haze: 1 hides what is behind.", 0.f, 1.f, haze_,
                      SLOT(updateHaze()), display);
}

void ForestProperties::addViewer(rviz::Display& display) {
  publish_viewer_ = new rviz::BoolProperty(
      "Publish Viewer", true,
      "Tell the forest where this view looks from, so that what is seen moves.", &display,
      SLOT(updateViewer()), &display);
  viewer_topic_ = new rviz::StringProperty("Topic", "viewer", "vegetation_sim/Viewer.",
                                           publish_viewer_, SLOT(updateViewer()), &display);
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

bool ForestProperties::ground() const {
  return ground_->getBool();
}
bool ForestProperties::sky() const {
  return sky_->getBool();
}
bool ForestProperties::haze() const {
  return haze_->getBool();
}
bool ForestProperties::publishesViewer() const {
  return publish_viewer_->getBool();
}
std::string ForestProperties::viewerTopic() const {
  return viewer_topic_->getStdString();
}

Haze ForestProperties::hazeValues() const {
  Haze out;
  out.start = haze_start_->getFloat();
  out.end = std::max(haze_end_->getFloat(), out.start + 1.f);
  out.most = haze() ? haze_most_->getFloat() : 0.f;
  return out;
}

Daylight ForestProperties::daylight() const {
  return daylightOf(DEGREE * static_cast<double>(azimuth_->getFloat()),
                    DEGREE * static_cast<double>(elevation_->getFloat()));
}

Rgba ForestProperties::groundTint() const {
  const QColor c = ground_colour_->getColor();
  const auto over = [](double wanted, double own) {
    return static_cast<float>(wanted / std::max(own, 1e-3));
  };
  return {over(c.redF(), GRASS.redF()), over(c.greenF(), GRASS.greenF()),
          over(c.blueF(), GRASS.blueF()), 1.f};
}

double ForestProperties::updatePeriod() const {
  return 1.0 / static_cast<double>(rate_->getFloat());
}

}  // namespace vegetation_sim::view
