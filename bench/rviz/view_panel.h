// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#ifndef BENCH_RVIZ_VIEW_PANEL_H
#define BENCH_RVIZ_VIEW_PANEL_H

#include <OgrePixelFormat.h>
#include <OgrePrerequisites.h>
#include <OgreRenderWindow.h>
#include <ros/ros.h>
#include <rviz/display_group.h>
#include <rviz/render_panel.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <rviz/yaml_config_reader.h>

#include <QApplication>
#include <QEventLoop>
#include <QTimer>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim::bench {

/// Draws a configuration of rviz without rviz's window, so that pictures show the scene alone.
class ViewPanel {
 public:
  /// Width and height are in pixels.
  ViewPanel(int width, int height) : width_(width), height_(height) {
    panel_.resize(width, height);
    panel_.show();
    manager_ = new rviz::VisualizationManager(&panel_);  // lives until the process ends
    panel_.initialize(manager_->getSceneManager(), manager_);
    manager_->initialize();
    manager_->startUpdate();
  }

  /// @param view is the file whose view and fixed frame are used.
  bool load(const char* file, const char* view) {
    rviz::YamlConfigReader reader;
    rviz::Config config, looks;
    reader.readFile(config, file);
    if (reader.error()) return false;
    reader.readFile(looks, view);
    if (reader.error()) return false;
    manager_->load(config.mapGetChild("Visualization Manager"));
    looks = looks.mapGetChild("Visualization Manager");
    manager_->getViewManager()->load(looks.mapGetChild("Views"));
    QString frame;
    if (looks.mapGetChild("Global Options").mapGetString("Fixed Frame", &frame))
      manager_->setFixedFrame(frame);
    limitRate(1000);
    return true;
  }

  /// Draws at most `rate` frames per second.
  void limitRate(int rate) {
    manager_->getRootDisplayGroup()
        ->subProp("Global Options")
        ->subProp("Frame Rate")
        ->setValue(rate);
  }

  Ogre::RenderWindow& window() { return *panel_.getRenderWindow(); }
  rviz::VisualizationManager& manager() { return *manager_; }

  void run(double seconds) {
    QEventLoop loop;
    QTimer::singleShot(static_cast<int>(1e3 * seconds), &loop, &QEventLoop::quit);
    loop.exec();
  }

  /// Returns when `count` more frames have been drawn.
  void drawFrames(int count) {
    const std::uint64_t last = manager_->getFrameCount() + static_cast<std::uint64_t>(count);
    while (manager_->getFrameCount() < last) QApplication::processEvents(QEventLoop::AllEvents, 5);
  }

  /// Returns the last frame, row by row from the top, as red, green and blue bytes.
  std::vector<unsigned char> picture() {
    std::vector<unsigned char> out(static_cast<std::size_t>(3 * width_ * height_));
    const Ogre::PixelBox target(static_cast<std::uint32_t>(width_),
                                static_cast<std::uint32_t>(height_), 1, Ogre::PF_BYTE_RGB,
                                out.data());
#if OGRE_VERSION < ((1 << 16) | (12 << 8))
    window().copyContentsToMemory(target);
#else
    window().copyContentsToMemory(target, target);
#endif
    return out;
  }

 private:
  int width_, height_;
  rviz::RenderPanel panel_;
  rviz::VisualizationManager* manager_;
};

}  // namespace vegetation_sim::bench

#endif  // BENCH_RVIZ_VIEW_PANEL_H
