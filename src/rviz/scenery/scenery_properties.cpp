// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/scenery_properties.h"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double DEGREE = PI / 180.0;
// Representative colours of ground and haze; a user's choice tints the detailed ones.
const QColor GRASS(150, 160, 90), AIR(196, 214, 224);

Rgba tintOf(const QColor& wanted, const QColor& own) {
  const auto over = [](double a, double b) { return static_cast<float>(a / std::max(b, 1e-3)); };
  return {over(wanted.redF(), own.redF()), over(wanted.greenF(), own.greenF()),
          over(wanted.blueF(), own.blueF()), 1.f};
}

rviz::FloatProperty* number(const char* name, float value, const char* help, float low, float high,
                            rviz::Property* parent, const char* slot, rviz::Display& display) {
  auto* out = new rviz::FloatProperty(name, value, help, parent, slot, &display);
  out->setMin(low);
  out->setMax(high);
  return out;
}

}  // namespace

rviz::BoolProperty* SceneryProperties::addFlag(const char* name, bool value, const char* help,
                                               rviz::Display& display) {
  return new rviz::BoolProperty(name, value, help, &display, SLOT(updateLook()), &display);
}

rviz::FloatProperty* SceneryProperties::addNumber(const char* name, float value, const char* help,
                                                  float low, float high, rviz::Display& display) {
  return number(name, value, help, low, high, &display, SLOT(updateLook()), display);
}

void SceneryProperties::addScenery(rviz::Display& display, const char* ground_help, bool on) {
  const auto flag = [&](const char* name, const char* help, const char* slot) {
    return new rviz::BoolProperty(name, on, help, &display, slot, &display);
  };
  ground_ = flag("Ground", ground_help, SLOT(updateGround()));
  ground_colour_ = new rviz::ColorProperty("Colour", GRASS, "Colour of grass.", ground_,
                                           SLOT(updateGround()), &display);
  robot_shadows_ = new rviz::BoolProperty("Robot Shadows", on,
                                          "Draw the shadows of robot models and markers on it.",
                                          ground_, SLOT(updateGround()), &display);
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
  haze_colour_ = new rviz::ColorProperty("Colour", AIR, "Colour of the haze: water's in a reef.",
                                         haze_, SLOT(updateSun()), &display);
  addViewer(display, on);
}

void SceneryProperties::addViewer(rviz::Display& display, bool on) {
  publish_viewer_ = new rviz::BoolProperty(
      "Publish Viewer", on,
      "Publishes the camera of this view, so that nodes animate what is visible.", &display,
      SLOT(updateViewer()), &display);
  viewer_topic_ = new rviz::StringProperty("Topic", "viewer", "vegetation_sim/Viewer.",
                                           publish_viewer_, SLOT(updateViewer()), &display);
}

void SceneryProperties::addRate(rviz::Display& display, const std::string& who) {
  rate_ = new rviz::FloatProperty(
      "Update Rate", 30.f, QString::fromStdString(who + " at most so often [Hz]."), &display);
  rate_->setMin(1.f);
  rate_->setMax(120.f);
}

void SceneryProperties::addFrameTime(rviz::Display& display, const std::string& what) {
  const std::string help =
      "Draw fewer " + what + " while frames take longer than this [ms]; 0: never.";
  frame_time_ = addNumber("Frame Time", 0.f, help.c_str(), 0.f, 1000.f, display);
}

bool SceneryProperties::ground() const {
  return ground_->getBool();
}
bool SceneryProperties::hasRobotShadows() const {
  return robot_shadows_->getBool();
}
bool SceneryProperties::sky() const {
  return sky_->getBool();
}
bool SceneryProperties::haze() const {
  return haze_->getBool();
}
bool SceneryProperties::publishesViewer() const {
  return publish_viewer_->getBool();
}
double SceneryProperties::updatePeriod() const {
  return 1.0 / static_cast<double>(rate_->getFloat());
}
double SceneryProperties::frameTime() const {
  return frame_time_ != nullptr ? 1e-3 * static_cast<double>(frame_time_->getFloat()) : 0.0;
}
std::string SceneryProperties::viewerTopic() const {
  return viewer_topic_->getStdString();
}

Haze SceneryProperties::hazeValues() const {
  Haze out;
  out.start = haze_start_->getFloat();
  out.end = std::max(haze_end_->getFloat(), out.start + 1.f);
  out.most = haze() ? haze_most_->getFloat() : 0.f;
  return out;
}

Daylight SceneryProperties::daylight() const {
  Daylight out = daylightOf(DEGREE * static_cast<double>(azimuth_->getFloat()),
                            DEGREE * static_cast<double>(elevation_->getFloat()));
  const Rgba tint = tintOf(haze_colour_->getColor(), AIR);
  for (std::size_t i = 0; i < 3; ++i) out.horizon[i] = std::min(1.f, out.horizon[i] * tint[i]);
  return out;
}

Rgba SceneryProperties::groundTint() const {
  return tintOf(ground_colour_->getColor(), GRASS);
}

}  // namespace vegetation_sim::view
