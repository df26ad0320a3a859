// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreRenderWindow.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rviz/display_group.h>
#include <rviz/render_panel.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <functional>
#include <memory>
#include <vector>

#include "forest/forest_fixture.h"
#include "vegetation_sim/ros/forest_conversions.h"
#include "vegetation_sim/ros/wind_conversions.h"
#include "vegetation_sim/rviz/forest_display.h"

namespace vegetation_sim {

/// Share of pixels that look like leaves or grass, like sky, and how much brightness varies.
struct Impression {
  double green{0.0}, blue{0.0}, spread{0.0};
};

/// rviz without its window frame, a clock that the test drives and a forest that it publishes.
class DisplayRig {
 public:
  DisplayRig() {
    panel_.resize(480, 360);
    panel_.show();
    manager_ = std::make_unique<rviz::VisualizationManager>(&panel_);
    panel_.initialize(manager_->getSceneManager(), manager_.get());
    manager_->initialize();
    manager_->setFixedFrame("map");
    manager_->startUpdate();
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10, true);
    layout_ = nh_.advertise<ForestLayout>("forest/layout", 1, true);
    wind_ = nh_.advertise<WindField>("wind", 1, true);
    state_ = nh_.advertise<ForestState>("forest/state", 10, true);
    setTime(100.0);
  }
  ~DisplayRig() {
    manager_->stopUpdate();
    manager_->removeAllDisplays();
  }

  rviz::VisualizationManager& manager() { return *manager_; }
  rviz::RenderPanel& panel() { return panel_; }
  Ogre::Camera& camera() { return *manager_->getViewManager()->getCurrent()->getCamera(); }
  ros::NodeHandle& nodeHandle() { return nh_; }

  ForestDisplay* addDisplay() {
    auto* out = dynamic_cast<ForestDisplay*>(
        manager_->createDisplay("vegetation_sim/ForestDisplay", "forest", true));
    return out;
  }
  void remove(rviz::Display* display) {
    manager_->getRootDisplayGroup()->takeDisplay(display);
    delete display;
  }

  void setTime(double seconds) {
    rosgraph_msgs::Clock clock;
    clock.clock.fromSec(seconds);
    now_ = seconds;
    clock_.publish(clock);
  }
  double now() const { return now_; }

  /// Runs rviz until `done` holds; false after `deadline` wall seconds.
  bool until(const std::function<bool()>& done, double deadline = 20.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(deadline);
    while (!done()) {
      if (ros::WallTime::now() > end) return false;
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    }
    return true;
  }
  /// Runs rviz for some of its frames.
  void frames(int count) {
    const std::uint64_t last = manager_->getFrameCount() + static_cast<std::uint64_t>(count);
    until([&] { return manager_->getFrameCount() >= last; });
  }

  void publishForest(const forest::Layout& layout) {
    hash_ = layout.hash();
    ForestLayout message = toMsg(layout);
    message.header.frame_id = "map";
    layout_.publish(message);
    wind_field_ = wind::Field({forest::makeBreeze(1, Vec3(6.0, 1.0, 0.0))});
    wind_.publish(toMsg(wind_field_, "map", 0));
    publishState();
  }
  void publish(const ForestLayout& message) { layout_.publish(message); }
  void publish(const WindField& message) { wind_.publish(message); }
  void publish(const ForestState& message) { state_.publish(message); }
  /// All trees at full level.
  void publishState() { publishState(now_); }
  void publishState(double stamp) {
    forest::StateUpdate update;
    update.stamp = fromSeconds(stamp);
    update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
    update.layout_hash = hash_;
    update.wind_hash = wind_field_.hash();
    ForestState message = toMsg(update);
    message.header.frame_id = "map";
    state_.publish(message);
  }

  std::vector<std::uint8_t> picture() {
    const auto width = static_cast<Ogre::uint32>(panel_.getRenderWindow()->getWidth());
    const auto height = static_cast<Ogre::uint32>(panel_.getRenderWindow()->getHeight());
    std::vector<std::uint8_t> out(3 * static_cast<std::size_t>(width) * height);
    const Ogre::PixelBox target(width, height, 1, Ogre::PF_BYTE_RGB, out.data());
#if OGRE_VERSION < ((1 << 16) | (12 << 8))
    panel_.getRenderWindow()->copyContentsToMemory(target);
#else
    panel_.getRenderWindow()->copyContentsToMemory(target, target);
#endif
    return out;
  }

  Impression look() {
    const std::vector<std::uint8_t> pixels = picture();
    const double count = static_cast<double>(pixels.size()) / 3.0;
    Impression out;
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
      const double r = pixels[i], g = pixels[i + 1], b = pixels[i + 2];
      out.green += g > r && g > 1.2 * b ? 1.0 / count : 0.0;
      out.blue += b > r && b > 100.0 ? 1.0 / count : 0.0;
      sum += g / count;
      squares += g * g / count;
    }
    out.spread = std::sqrt(std::max(0.0, squares - sum * sum));
    return out;
  }

 private:
  ros::NodeHandle nh_;
  rviz::RenderPanel panel_;
  std::unique_ptr<rviz::VisualizationManager> manager_;
  ros::Publisher clock_, layout_, wind_, state_;
  wind::Field wind_field_;
  std::uint64_t hash_{0};
  double now_{0.0};
};

}  // namespace vegetation_sim
