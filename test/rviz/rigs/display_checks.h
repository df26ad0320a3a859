// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/string_property.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <functional>

#include "rviz/rigs/soak.h"
#include "rviz/rigs/view_rig.h"

namespace vegetation_sim {

// Checks of properties that every display has, for the tests of each kind.

/// Changes each property and back again, at its limits and with invalid names, and checks that each
/// has a description.
inline void expectEveryPropertyCanBeChanged(ViewRig& rig, rviz::Display& display) {
  for (auto* flag : propertiesOf<rviz::BoolProperty>(display)) {
    for (int i = 0; i < 2; ++i) {
      flag->setBool(!flag->getBool());
      rig.frames(2);
    }
    EXPECT_FALSE(flag->getDescription().isEmpty()) << flag->getName().toStdString();
  }
  for (auto* text : propertiesOf<rviz::StringProperty>(display)) {
    const QString value = text->getString();
    for (const QString& other : {QString("elsewhere"), QString("no name!"), value}) {
      text->setValue(other);
      rig.frames(2);
    }
    EXPECT_FALSE(text->getDescription().isEmpty()) << text->getName().toStdString();
  }
  for (auto* colour : propertiesOf<rviz::ColorProperty>(display)) {
    const QColor value = colour->getColor();
    for (const QColor& other : {QColor(Qt::black), QColor(Qt::red), value}) {
      colour->setColor(other);
      rig.frames(1);
    }
    EXPECT_FALSE(colour->getDescription().isEmpty()) << colour->getName().toStdString();
  }
  for (auto* number : propertiesOf<rviz::FloatProperty>(display)) {
    const float value = number->getFloat();
    for (const float other : {number->getMin(), number->getMax(), value}) {
      number->setFloat(other);
      rig.frames(1);
    }
    EXPECT_FALSE(number->getDescription().isEmpty()) << number->getName().toStdString();
  }
  for (auto* number : propertiesOf<rviz::IntProperty>(display)) {
    const int value = number->getInt();
    for (const int other : {number->getMin(), value}) {
      number->setInt(other);
      rig.frames(1);
    }
    EXPECT_FALSE(number->getDescription().isEmpty()) << number->getName().toStdString();
  }
}

/// A display that loads the saved settings of another display has the same settings.
inline void expectSettingsSurvive(ViewRig& rig, rviz::Display& display, const MakeDisplay& make) {
  display.subProp("Update Rate")->setValue(17.f);
  display.subProp("Haze")->subProp("End")->setValue(777.f);
  rviz::Config saved, again;
  display.save(saved);
  rviz::Display* other = make();
  other->load(saved);
  other->save(again);
  for (auto it = saved.mapIterator(); it.isValid(); it.advance())
    EXPECT_EQ(it.currentChild().getValue(), again.mapGetChild(it.currentKey()).getValue())
        << it.currentKey().toStdString();
  EXPECT_EQ(other->subProp("Haze")->subProp("End")->getValue().toFloat(), 777.f);
  EXPECT_EQ(other->subProp("Update Rate")->getValue().toFloat(), 17.f);
  rig.remove(other);
}

/// Returns the text of a status line of a display.
inline std::string statusOf(rviz::Display& display, const char* name) {
  for (auto* property : propertiesOf<rviz::Property>(display))
    if (property->getName() == name) return property->getValue().toString().toStdString();
  return {};
}

/// The display reports a node that publishes no state until it publishes again.
inline void expectSilenceIsReported(ViewRig& rig, rviz::Display& display,
                                    const std::function<void()>& report) {
  const auto says = [&](const char* text) {
    return rig.until([&] { return statusOf(display, "State") == text; });
  };
  report();
  EXPECT_TRUE(says("In step")) << statusOf(display, "State");
  rig.setTime(rig.now() + 4.0);
  EXPECT_TRUE(says("No message for 3 s: drawn as it was then")) << statusOf(display, "State");
  report();
  EXPECT_TRUE(says("In step")) << statusOf(display, "State");
}

/// The display shows the allocation of the node's governor. @param cost and budget are keys of its
/// diagnostics. @param unit is the unit of both. @return the text that is shown.
inline std::string expectAllocationIsReported(ViewRig& rig, rviz::Display& display,
                                              const std::string& node, const char* cost,
                                              const char* budget, const std::string& unit) {
  EXPECT_EQ(statusOf(display, "Governor"), "");
  diagnostic_msgs::DiagnosticArray message;
  message.status.resize(2);
  message.status[0].name = "/field/" + node + ": governor";
  message.status[0].message = "it binds";
  message.status[1].name = "another: governor";
  const std::pair<const char*, const char*> values[] = {{cost, "120"},
                                                        {budget, "90"},
                                                        {"Largest predicted error [pixel]", "3"},
                                                        {"Tolerance [pixel]", "2"}};
  for (const auto& [key, value] : values) {
    message.status[0].values.emplace_back();
    message.status[0].values.back().key = key;
    message.status[0].values.back().value = value;
  }
  const ros::Publisher diagnostics =
      rig.nodeHandle().advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 1, true);
  const std::string published = "it binds: 120 of 90 " + unit + ", errors up to 3 pixel of 2";
  EXPECT_TRUE(rig.until([&] {
    diagnostics.publish(message);
    rig.frames(1);
    return statusOf(display, "Governor") == published;
  })) << statusOf(display, "Governor");
  return published;
}

/// Returns the mean difference of two images, 0 to 255.
inline double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum / static_cast<double>(std::max<std::size_t>(1, a.size()));
}

/// The image once all that was published has been drawn, so that it does not change any more.
inline std::vector<std::uint8_t> steadyPicture(ViewRig& rig) {
  std::vector<std::uint8_t> picture = rig.picture();
  EXPECT_TRUE(rig.until([&] {
    rig.frames(10);
    const std::vector<std::uint8_t> last = std::move(picture);
    picture = rig.picture();
    return difference(last, picture) < 0.05;
  }));
  return picture;
}

/// The image is the same in any fixed frame, also a rotated and moved one. While tf does not know a
/// frame, the status names it and nothing is drawn in a wrong place.
inline void expectStandsInAnyFixedFrame(ViewRig& rig, rviz::Display& display) {
  constexpr double TURN = 2.0;  // [rad] about z
  rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
  const QVariant former = view.subProp("Target Frame")->getValue();
  view.subProp("Target Frame")->setValue("map");
  rig.lookAt(1.5f, 0.4, 18.0);
  const std::vector<std::uint8_t> before = steadyPicture(rig);
  rig.manager().setFixedFrame("elsewhere");
  EXPECT_TRUE(rig.until([&] {
    return statusOf(display, "Transform") == "No transform from map to elsewhere";
  })) << statusOf(display, "Transform");
  geometry_msgs::TransformStamped place;
  place.header.frame_id = "elsewhere";
  place.child_frame_id = "map";
  place.transform.translation.x = 30.0;
  place.transform.translation.y = -20.0;
  place.transform.translation.z = 2.0;
  place.transform.rotation.w = std::cos(0.5 * TURN);
  place.transform.rotation.z = std::sin(0.5 * TURN);
  tf2_msgs::TFMessage message;
  message.transforms = {place};
  const ros::Publisher tf = rig.nodeHandle().advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
  tf.publish(message);
  // The view follows the position of its target frame, but not its rotation.
  view.subProp("Yaw")->setValue(view.subProp("Yaw")->getValue().toDouble() + TURN);
  EXPECT_TRUE(rig.until([&] { return statusOf(display, "Transform") == "OK"; }));
  EXPECT_TRUE(rig.until([&] {
    rig.frames(1);
    return difference(before, rig.picture()) < 1.0;
  })) << difference(before, rig.picture());
  rig.manager().setFixedFrame("map");
  view.subProp("Target Frame")->setValue(former);
}

}  // namespace vegetation_sim
