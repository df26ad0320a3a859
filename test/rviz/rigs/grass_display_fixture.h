// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <rviz/view_controller.h>

#include <memory>
#include <string>
#include <vector>

#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/grass_display_rig.h"

namespace vegetation_sim {

constexpr int TILES = 20;  // number of tiles along an edge

// rviz can be started only once in a process, so all tests share one rig. Each test has its own
// display.
inline std::unique_ptr<GrassRig> shared_rig;

class GrassDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<GrassRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override {
    rig.setTime(rig.now() + 10.0);
    rig.publishMeadow(GrassRig::meadow(TILES));
    display = rig.addDisplay();
    ASSERT_NE(display, nullptr) << "the plugin is not found or is another class";
    setCamera(0.5, 9.0);
  }
  void TearDown() override {
    if (display != nullptr) rig.remove(display);
  }

  void setCamera(double pitch, double distance) {
    rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
    view.lookAt(0.f, 0.f, 0.3f);
    view.subProp("Pitch")->setValue(pitch);
    view.subProp("Yaw")->setValue(0.8);
    view.subProp("Distance")->setValue(distance);
  }
  bool drawn() {
    return rig.until([&] { return display->drawn().blades > 0; });
  }
  /// Returns whether all is drawn and nothing more will change while the clock stops.
  bool settled() {
    int before = -1;
    return drawn() && rig.until([&] {
      const bool same = display->drawn().rebuilds == before;
      before = display->drawn().rebuilds;
      rig.frames(10);
      return same;
    });
  }
  std::string status(const char* name) { return statusOf(*display, name); }
  /// Returns the mean difference from another image.
  double changed(const std::vector<std::uint8_t>& before) {
    return difference(before, rig.picture());
  }

  GrassRig& rig{*shared_rig};
  GrassDisplay* display{nullptr};
};

}  // namespace vegetation_sim
