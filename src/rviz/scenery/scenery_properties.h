// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <rviz/display.h>
#include <rviz/properties/ros_topic_property.h>

#include <string>

#include "rviz/render/material.h"

namespace rviz {
class BoolProperty;
class ColorProperty;
class FloatProperty;
class StringProperty;
}  // namespace rviz

namespace vegetation_sim::view {

/// User settings of a SceneryDisplay: ground, sky, haze, update rate and published viewer. The
/// display owns the properties, which are its children.
class SceneryProperties {
 public:
  bool ground() const;
  bool hasRobotShadows() const;
  bool sky() const;
  bool haze() const;
  bool publishesViewer() const;
  std::string viewerTopic() const;
  Haze hazeValues() const;
  Daylight daylight() const;
  /// Returns the factor of the ground's colours.
  Rgba groundTint() const;
  double updatePeriod() const;  ///< [s]
  /// Returns the target of the time between two frames [s]; 0: none.
  double frameTime() const;

 protected:
  /// @param display must be a SceneryDisplay. @param on default of the switches.
  void addScenery(rviz::Display& display, const char* ground_help, bool on = true);
  /// @param who name of what moves, for the help texts.
  void addRate(rviz::Display& display, const std::string& who);
  /// @param what name of what becomes fewer while frames take too long.
  void addFrameTime(rviz::Display& display, const std::string& what);

  template <class Message>
  static rviz::RosTopicProperty* addTopic(const char* name, const char* value, const char* help,
                                          rviz::Display& display) {
    return new rviz::RosTopicProperty(
        name, value, QString::fromStdString(ros::message_traits::datatype<Message>()), help,
        &display, SLOT(updateTopics()), &display);
  }
  /// A change of these properties calls updateLook().
  static rviz::BoolProperty* addFlag(const char* name, bool value, const char* help,
                                     rviz::Display& display);
  static rviz::FloatProperty* addNumber(const char* name, float value, const char* help, float low,
                                        float high, rviz::Display& display);

 private:
  void addViewer(rviz::Display& display, bool on);

  rviz::BoolProperty *ground_, *robot_shadows_, *sky_, *haze_, *publish_viewer_;
  rviz::ColorProperty *ground_colour_, *haze_colour_;
  rviz::FloatProperty *azimuth_, *elevation_, *haze_start_, *haze_end_, *haze_most_, *rate_;
  rviz::FloatProperty* frame_time_{nullptr};  // null without addFrameTime()
  rviz::StringProperty* viewer_topic_;
};

}  // namespace vegetation_sim::view
