// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/wind/wind_properties.h"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>
#include <vegetation_sim/WindField.h>

namespace vegetation_sim::view {

WindProperties::WindProperties(rviz::Display& display) {
  topic_ =
      addTopic<WindField>("Topic", "wind", "vegetation_sim/WindField: the wind field.", display);
  arrows_ = addFlag("Arrows", true, "Draw the wind velocity on a grid around the viewer.", display);
  spacing_ = addNumber("Spacing", 3.f, "Distance of the arrows [m].", 0.1f, 1000.f, display);
  extent_ = addNumber("Extent", 60.f, "Edge of the square of arrows [m].", 1.f, 10000.f, display);
  height_ =
      addNumber("Height", 2.f, "Height of the arrows over the ground [m].", 0.f, 1000.f, display);
  scale_ =
      addNumber("Scale", 0.25f, "Length of an arrow over its speed [s].", 0.001f, 100.f, display);
  full_speed_ =
      addNumber("Full Speed", 12.f, "Speed of red arrows; arrows of slow wind are blue [m/s].",
                0.1f, 200.f, display);
  shapes_ = addFlag(
      "Shapes", true,
      "Draw each gust, disc, tornado, blast and wake on the ground, with its direction.", display);
  red_discs_ =
      addFlag("Red Discs", false,
              "Discs are red, as the branches that move in the trees' colours by state.", display);
  addRate(display, "Arrows move");
  addScenery(display, "Draw grass, unless another display has a ground.", false);
}

std::string WindProperties::topic() const {
  return topic_->getTopicStd();
}
bool WindProperties::arrows() const {
  return arrows_->getBool();
}
bool WindProperties::shapes() const {
  return shapes_->getBool();
}

WindStyle WindProperties::style() const {
  WindStyle out;
  out.spacing = static_cast<double>(spacing_->getFloat());
  out.extent = static_cast<double>(extent_->getFloat());
  out.height = static_cast<double>(height_->getFloat());
  out.scale = static_cast<double>(scale_->getFloat());
  out.full_speed = static_cast<double>(full_speed_->getFloat());
  out.red_discs = red_discs_->getBool();
  return out;
}

}  // namespace vegetation_sim::view
