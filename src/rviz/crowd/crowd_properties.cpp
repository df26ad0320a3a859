// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/crowd_properties.h"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

namespace vegetation_sim::view {

CrowdProperties::CrowdProperties(rviz::Display& display) {
  topic_ = addTopic<AgentStates>("Topic", "agents",
                                 "vegetation_sim/AgentStates: all walkers. If Topic/view has a "
                                 "publisher, the display reads the smaller CrowdView from there.",
                                 display);
  most_people_ =
      new rviz::IntProperty("Most People", 500, "Number of people that are drawn, nearest first.",
                            &display, SLOT(updateLook()), &display);
  most_people_->setMin(1);
  most_people_->setMax(100000);
  detail_ = addNumber("Detail", 1.f, "Factor of the size from which the detail of a body follows.",
                      0.01f, 100.f, display);
  shadows_ = addFlag("Shadows", true, "Draw shadows on the ground.", display);
  contact_shadows_ = addFlag("Contact Shadows", true,
                             "Darken ground and grass under feet and where shadows fall.", display);
  addRate(display, "People move");
  addScenery(display, "Draw grass under them, unless another display has a ground.");
}

std::string CrowdProperties::topic() const {
  return topic_->getTopicStd();
}

CrowdVisual::Options CrowdProperties::options() const {
  CrowdVisual::Options out;
  out.most_people = static_cast<std::size_t>(most_people_->getInt());
  out.detail = detail_->getFloat();
  out.shadows = shadows_->getBool();
  out.contact_shadows = contact_shadows_->getBool();
  return out;
}

}  // namespace vegetation_sim::view
