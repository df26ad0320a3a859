// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreRenderWindow.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rviz/display_group.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace vegetation_sim {

/// Shares of pixels with the colour of leaves or grass, of sky, and of the commonest colour; spread
/// is the standard deviation of the green channel.
struct ImageStatistics {
  double green{0.0}, blue{0.0}, commonest{0.0}, spread{0.0};
};

/// rviz without its window frame, and a clock that the test sets.
class ViewRig {
 public:
  ViewRig() {
    panel_.resize(480, 360);
    panel_.show();
    manager_ = std::make_unique<rviz::VisualizationManager>(&panel_);
    panel_.initialize(manager_->getSceneManager(), manager_.get());
    manager_->initialize();
    manager_->setFixedFrame("map");
    manager_->startUpdate();
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10, true);
    setTime(100.0);
  }
  ~ViewRig() {
    manager_->stopUpdate();
    manager_->removeAllDisplays();
  }

  rviz::VisualizationManager& manager() { return *manager_; }
  rviz::RenderPanel& panel() { return panel_; }
  Ogre::Camera& camera() { return *manager_->getViewManager()->getCurrent()->getCamera(); }
  ros::NodeHandle& nodeHandle() { return nh_; }

  /// Points the camera at a point above the origin, from the north-east.
  void lookAt(float height, double pitch, double distance) {
    rviz::ViewController& view = *manager_->getViewManager()->getCurrent();
    view.lookAt(0.f, 0.f, height);
    view.subProp("Pitch")->setValue(pitch);
    view.subProp("Yaw")->setValue(0.8);
    view.subProp("Distance")->setValue(distance);
  }

  /// Adds a display of the plugin `name`. Returns null if there is none or it has another class.
  template <class Display>
  Display* add(const char* name) {
    return dynamic_cast<Display*>(manager_->createDisplay(name, name, true));
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

  /// Runs rviz until `done` holds. Returns false after `deadline` seconds of wall time.
  bool until(const std::function<bool()>& done, double deadline = 60.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(deadline);
    while (!done()) {
      if (ros::WallTime::now() > end) return false;
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    }
    return true;
  }
  /// Returns the number of frames of rviz so far.
  double frameCount() const { return static_cast<double>(manager_->getFrameCount()); }
  /// Runs rviz for a number of frames.
  void frames(int count) {
    const std::uint64_t last = manager_->getFrameCount() + static_cast<std::uint64_t>(count);
    until([&] { return manager_->getFrameCount() >= last; });
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

  /// Returns the colour in the middle of an image, 0 to 255.
  std::array<int, 3> middleOf(const std::vector<std::uint8_t>& pixels) {
    const Ogre::RenderWindow& window = *panel_.getRenderWindow();
    const std::size_t at = 3 * (window.getHeight() / 2 * window.getWidth() + window.getWidth() / 2);
    return {pixels[at], pixels[at + 1], pixels[at + 2]};
  }

  /// Returns the largest mean difference of a block of 16 x 16 pixels between two images, 0 to 255.
  double largestChange(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    constexpr std::size_t BLOCK = 16;
    const std::size_t width = panel_.getRenderWindow()->getWidth();
    double largest = 0.0;
    for (std::size_t row = 0; 3 * (row + BLOCK) * width <= a.size(); row += BLOCK) {
      for (std::size_t column = 0; column + BLOCK <= width; column += BLOCK) {
        int sum = 0;
        for (std::size_t y = row; y < row + BLOCK; ++y)
          for (std::size_t i = 3 * (y * width + column); i < 3 * (y * width + column + BLOCK); ++i)
            sum += static_cast<int>(a[i]) - static_cast<int>(b[i]);
        largest = std::max(largest, std::abs(sum) / (3.0 * BLOCK * BLOCK));
      }
    }
    return largest;
  }

  ImageStatistics imageStatistics() {
    const std::vector<std::uint8_t> pixels = picture();
    const double count = static_cast<double>(pixels.size()) / 3.0;
    ImageStatistics out;
    double sum = 0.0, squares = 0.0;
    std::map<std::array<std::uint8_t, 3>, double> colours;
    for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
      const double r = pixels[i], g = pixels[i + 1], b = pixels[i + 2];
      out.green += g > r && g > 1.2 * b ? 1.0 / count : 0.0;
      out.blue += b > r && b > 100.0 ? 1.0 / count : 0.0;
      double& share = colours[{pixels[i], pixels[i + 1], pixels[i + 2]}];
      share += 1.0 / count;
      out.commonest = std::max(out.commonest, share);
      sum += g / count;
      squares += g * g / count;
    }
    out.spread = std::sqrt(std::max(0.0, squares - sum * sum));
    return out;
  }

 protected:
  ros::NodeHandle nh_;

 private:
  rviz::RenderPanel panel_;
  std::unique_ptr<rviz::VisualizationManager> manager_;
  ros::Publisher clock_;
  double now_{0.0};
};

/// Returns all properties of a type below a property.
template <class T>
std::vector<T*> propertiesOf(rviz::Property& parent) {
  std::vector<T*> out;
  for (int i = 0; i < parent.numChildren(); ++i) {
    rviz::Property* child = parent.childAt(i);
    if (auto* found = dynamic_cast<T*>(child)) out.push_back(found);
    for (T* deeper : propertiesOf<T>(*child)) out.push_back(deeper);
  }
  return out;
}

}  // namespace vegetation_sim
