// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>

#include "rviz/view_rig.h"

namespace vegetation_sim {

/// What every display promises, for the tests of each kind.
using MakeDisplay = std::function<rviz::Display*()>;

/// Each property there and back, at its limits too, with help on each.
inline void expectEveryPropertyCanBeChanged(ViewRig& rig, rviz::Display& display) {
  for (auto* flag : propertiesOf<rviz::BoolProperty>(display)) {
    for (int i = 0; i < 2; ++i) {
      flag->setBool(!flag->getBool());
      rig.frames(2);
    }
    EXPECT_FALSE(flag->getDescription().isEmpty()) << flag->getName().toStdString();
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

/// Another display that loads what one has saved has the same settings.
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

/// How often displays come and go: VEGETATION_SIM_CYCLES for long runs.
inline int cycles() {
  const char* wanted = std::getenv("VEGETATION_SIM_CYCLES");
  return wanted != nullptr ? std::atoi(wanted) : 12;
}

/// Memory of this process [MB].
inline double residentMemory() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Displays that come and go, some of them after they have drawn, leave no Ogre object. Long runs
/// say what memory they have taken since a quarter of them.
inline void expectNothingLeftBehind(ViewRig& rig, const MakeDisplay& make,
                                    const std::function<bool(rviz::Display&)>& hasDrawn) {
  Ogre::SceneManager& scene = *rig.manager().getSceneManager();
  const std::size_t before = resources();
  const auto nodes = scene.getRootSceneNode()->numChildren();
  const int times = cycles();
  double memory = 0.0;
  for (int i = 0; i < times; ++i) {
    if (i == times / 4) memory = residentMemory();
    rviz::Display* another = make();
    ASSERT_NE(another, nullptr);
    if (i % 4 == 0)
      ASSERT_TRUE(rig.until([&] { return hasDrawn(*another); }));
    else
      rig.frames(1);
    if (i % 2 == 0) another->reset();
    if (i % 3 == 0) another->setEnabled(false);
    rig.remove(another);
  }
  if (times > 50)
    std::cout << times << " cycles: " << residentMemory() - memory
              << " MB more since a quarter of them\n";
  EXPECT_EQ(resources(), before);
  EXPECT_EQ(scene.getRootSceneNode()->numChildren(), nodes);
  EXPECT_EQ(scene.getFogMode(), Ogre::FOG_NONE);
}

/// A node that dies and returns with another of two scenes, again and again, and floods its topics:
/// what it told last is seen, and nothing stays of what it told before.
/// @param restart starts the node with scene 0 or 1. @param shows whether a scene is seen.
inline void expectReloadsAreFollowed(ViewRig& rig, const std::function<void(int)>& restart,
                                     const std::function<bool(int)>& shows) {
  // Within one process roscpp now and then leaves a publisher that comes at once without its
  // subscribers: such a node dies again.
  const auto see = [&](int scene) {
    for (int attempt = 0; attempt < 5; ++attempt) {
      restart(scene);
      if (rig.until([&] { return shows(scene); }, 6.0 * (attempt + 1))) return true;
    }
    return false;
  };
  ASSERT_TRUE(see(0));
  const std::size_t before = resources();
  for (int i = 1; i < cycles(); ++i) {
    if (i % 4 == 1) {
      ASSERT_TRUE(see(i % 2)) << "reload " << i;
    } else {
      restart(i % 2);
      rig.frames(1);
    }
  }
  ASSERT_TRUE(see(0));
  EXPECT_EQ(resources(), before);
}

/// What a status line of a display says.
inline std::string statusOf(rviz::Display& display, const char* name) {
  for (auto* property : propertiesOf<rviz::Property>(display))
    if (property->getName() == name) return property->getValue().toString().toStdString();
  return {};
}

/// Mean difference of two pictures, 0 to 255.
inline double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum / static_cast<double>(std::max<std::size_t>(1, a.size()));
}

}  // namespace vegetation_sim
