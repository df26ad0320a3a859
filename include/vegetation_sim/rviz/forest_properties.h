// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/rviz/forest_source.h"
#include "vegetation_sim/rviz/forest_visual.h"

namespace rviz {
class BoolProperty;
class ColorProperty;
class Display;
class FloatProperty;
class IntProperty;
class RosTopicProperty;
class StringProperty;
}  // namespace rviz

namespace vegetation_sim::view {

/// What the user of ForestDisplay sets, and its values in our terms. The properties are children of
/// the display, which owns them.
class ForestProperties {
 public:
  /// @param display with the slots updateTopics(), updateTrees(), updateLook(), updateGround(),
  /// updateSky(), updateSun(), updateHaze() and updateViewer().
  explicit ForestProperties(rviz::Display& display);

  ForestTopics topics() const;
  ForestVisual::Options options() const;
  bool ground() const;
  bool sky() const;
  bool haze() const;
  bool publishesViewer() const;
  std::string viewerTopic() const;
  Haze hazeValues() const;
  Daylight daylight() const;
  /// Multiplies the ground's colours.
  Rgba groundTint() const;
  double updatePeriod() const;  ///< [s]

 private:
  void addTopics(rviz::Display& display);
  void addLook(rviz::Display& display);
  void addScenery(rviz::Display& display);
  void addViewer(rviz::Display& display);

  rviz::RosTopicProperty *layout_, *wind_, *state_;
  rviz::IntProperty *triangles_, *most_trees_;
  rviz::BoolProperty *leaves_, *flutter_, *colour_by_level_;
  rviz::BoolProperty *ground_, *sky_, *haze_, *publish_viewer_;
  rviz::ColorProperty* ground_colour_;
  rviz::FloatProperty *azimuth_, *elevation_, *haze_start_, *haze_end_, *haze_most_, *rate_;
  rviz::StringProperty* viewer_topic_;
};

}  // namespace vegetation_sim::view
