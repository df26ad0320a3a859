// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "rviz/canopy/canopy_display.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/display_rig.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

namespace vegetation_sim {

/// rviz and shrubs that the rig moves, or a forest with canopy leaves.
class CanopyRig : public DisplayRig {
 public:
  CanopyRig() { startNode(); }

  /// Starts a node that publishes the leaves. A node that already runs is stopped.
  void startNode() {
    for (ros::Publisher* publisher : {&layout_, &state_}) publisher->shutdown();
    layout_ = nh_.advertise<CanopyLayout>("canopy/layout", 1, true);
    state_ = nh_.advertise<CanopyState>("canopy/state", 100);
  }

  CanopyDisplay* addDisplay() { return add<CanopyDisplay>("vegetation_sim/CanopyDisplay"); }

  static canopy::Layout shrubs(int count) {
    canopy::Layout out;
    out.motion.fluid.cells = 32;
    out.kinds.resize(2);
    out.kinds[0].leaves = 600;
    out.kinds[1].name = "reed";
    out.kinds[1].shape = canopy::PlantShape::REED;
    out.kinds[1].leaves = 40;
    for (int i = 0; i < count; ++i) {
      canopy::Plant plant;
      plant.seed = static_cast<std::uint64_t>(i) + 1;
      plant.kind = static_cast<std::uint16_t>(i % 2);
      plant.position = Vec3(2.0 * (i / 2) - 2.0, 1.5 * (i % 2) - 0.75, 0.0);
      out.plants.push_back(plant);
    }
    return out;
  }

  void plant(int count) { plant(shrubs(count)); }
  void plant(const canopy::Layout& layout) {
    canopy_ = std::make_unique<canopy::Canopy>(layout);
    canopy_->setWind(wind::Field({forest::makeBreeze(1, Vec3(1.0, 8.0, 0.0))}));
    CanopyLayout message = toMsg(canopy_->layout());
    message.header.frame_id = "map";
    publish(message);
  }
  /// Moves the leaves for some ticks and publishes the state of each tick.
  void blow(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      setTime(now() + 0.05);
      canopy_->advance(fromSeconds(now()));
      publish(message());
    }
  }
  CanopyState message() const {
    CanopyState out = toMsg(canopy_->update(false));
    out.header.frame_id = "map";
    return out;
  }
  void cut(const std::vector<std::uint32_t>& plants, double height) {
    canopy_->cut(plants, height);
    publish(message());
  }
  void reset() {
    canopy_->reset();
    blow(1);
  }
  /// Publishes a state in which bodies have pushed all plants to the left and to the right.
  void pushApart() {
    CanopyState state = message();
    for (const canopy::Plant& plant : canopy_->layout().plants) {
      const auto id = static_cast<std::uint32_t>(&plant - canopy_->layout().plants.data());
      const auto lean = static_cast<std::int16_t>(id % 2 == 0 ? -20000 : 20000);
      const canopy::Fibres fibres = canopy::fibresOf(canopy_->layout().kinds[plant.kind], plant);
      for (std::size_t cell = 0; cell < fibres.cells(); ++cell) {
        state.bent_plants.push_back(id);
        state.bent_cells.push_back(static_cast<std::uint16_t>(cell));
        state.lean_x.push_back(0);
        state.lean_y.push_back(lean);
      }
    }
    publish(state);
  }
  void publish(const CanopyLayout& message) { layout_.publish(message); }
  void publish(const CanopyState& message) { state_.publish(message); }

 private:
  ros::Publisher layout_, state_;
  std::unique_ptr<canopy::Canopy> canopy_;
};

// rviz can be started only once in a process, so all tests share one rig. Each test has its own
// display.
inline std::unique_ptr<CanopyRig> shared_rig;

class CanopyDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<CanopyRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override {
    rig.setTime(rig.now() + 10.0);
    rig.plant(4);
    display = rig.addDisplay();
    ASSERT_NE(display, nullptr) << "the plugin is not found or is another class";
    rig.lookAt(0.8f, 0.25, 6.0);
    ASSERT_TRUE(
        rig.until([&] { return display->drawn().plants == 4 && display->drawn().drawn > 0; }));
  }
  void TearDown() override {
    if (display != nullptr) rig.remove(display);
  }

  void setTolerance(double pixels) { display->subProp("Picture Tolerance")->setValue(pixels); }

  CanopyRig& rig{*shared_rig};
  CanopyDisplay* display{nullptr};
};

}  // namespace vegetation_sim
