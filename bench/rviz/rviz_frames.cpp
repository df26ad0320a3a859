// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Loads a configuration of rviz beside nodes that run, without rviz's window, and says how many
// frames a second it draws and how much pictures change from frame to frame as the camera goes
// away:
//   rviz_frames FILE.rviz [--seconds N] [--dolly FACTOR]
#include <OgreRenderWindow.h>
#include <ros/ros.h>
#include <rviz/display_group.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <rviz/yaml_config_reader.h>

#include <QApplication>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

namespace {

constexpr int WIDTH = 1280, HEIGHT = 900;  // [pixel]
constexpr double SETTLING = 20.0;          // [s] until all has been drawn
constexpr int BLOCK = 16;                  // [pixel] edge of what differences are meant over
constexpr int STEPS = 60;                  // of the camera's way

class Frames {
 public:
  Frames() {
    panel_.resize(WIDTH, HEIGHT);
    panel_.show();
    manager_ = new rviz::VisualizationManager(&panel_);  // lives until the process ends
    panel_.initialize(manager_->getSceneManager(), manager_);
    manager_->initialize();
    manager_->startUpdate();
  }

  bool load(const char* file) {
    rviz::YamlConfigReader reader;
    rviz::Config config;
    reader.readFile(config, file);
    if (reader.error()) return false;
    manager_->load(config.mapGetChild("Visualization Manager"));
    manager_->getRootDisplayGroup()
        ->subProp("Global Options")
        ->subProp("Frame Rate")
        ->setValue(1000);
    return true;
  }

  void run(double seconds) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    while (ros::WallTime::now() < end) QApplication::processEvents(QEventLoop::AllEvents, 5);
  }
  void frames(int count) {
    const std::uint64_t last = manager_->getFrameCount() + static_cast<std::uint64_t>(count);
    while (manager_->getFrameCount() < last) QApplication::processEvents(QEventLoop::AllEvents, 5);
  }

  double rate(double seconds) {
    const std::uint64_t first = manager_->getFrameCount();
    const ros::WallTime start = ros::WallTime::now();
    run(seconds);
    return static_cast<double>(manager_->getFrameCount() - first) /
           (ros::WallTime::now() - start).toSec();
  }

  /// Steps back until the distance is `factor` times what it was; prints the largest mean
  /// difference of a block between frames of one step, and of two frames without a step.
  void dolly(double factor) {
    rviz::Property* distance = manager_->getViewManager()->getCurrent()->subProp("Distance");
    const double start = distance->getValue().toDouble();
    double step = 0.0, still = 0.0;
    for (int i = 1; i <= STEPS; ++i) {
      frames(2);
      const std::vector<unsigned char> a = picture();
      frames(1);
      const std::vector<unsigned char> b = picture();
      still = std::max(still, largestChange(a, b));
      distance->setValue(start * std::pow(factor, static_cast<double>(i) / STEPS));
      frames(1);
      step = std::max(step, largestChange(b, picture()));
    }
    std::printf(
        "largest change of a block of %d x %d pixels: %.1f of 255 in a step, %.1f without one\n",
        BLOCK, BLOCK, step, still);
  }

 private:
  std::vector<unsigned char> picture() {
    std::vector<unsigned char> out(static_cast<std::size_t>(3 * WIDTH * HEIGHT));
    const Ogre::PixelBox target(WIDTH, HEIGHT, 1, Ogre::PF_BYTE_RGB, out.data());
#if OGRE_VERSION < ((1 << 16) | (12 << 8))
    panel_.getRenderWindow()->copyContentsToMemory(target);
#else
    panel_.getRenderWindow()->copyContentsToMemory(target, target);
#endif
    return out;
  }

  static double largestChange(const std::vector<unsigned char>& a,
                              const std::vector<unsigned char>& b) {
    double largest = 0.0;
    for (int row = 0; row + BLOCK <= HEIGHT; row += BLOCK) {
      for (int column = 0; column + BLOCK <= WIDTH; column += BLOCK) {
        int sum = 0;
        for (int y = row; y < row + BLOCK; ++y)
          for (int i = 3 * (y * WIDTH + column); i < 3 * (y * WIDTH + column + BLOCK); ++i)
            sum += static_cast<int>(a[static_cast<std::size_t>(i)]) -
                   static_cast<int>(b[static_cast<std::size_t>(i)]);
        largest = std::max(largest, std::abs(sum) / (3.0 * BLOCK * BLOCK));
      }
    }
    return largest;
  }

  rviz::RenderPanel panel_;
  rviz::VisualizationManager* manager_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "rviz_frames", ros::init_options::AnonymousName);
  const QApplication application(argc, argv);
  double seconds = 10.0, factor = 0.0;
  for (int i = 2; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--dolly") == 0) factor = std::atof(argv[i + 1]);
  }
  if (argc < 2) {
    std::fprintf(stderr, "usage: rviz_frames FILE.rviz [--seconds N] [--dolly FACTOR]\n");
    return 2;
  }
  rviz::RenderSystem::disableAntiAliasing();  // without a graphics card it halves the rate
  Frames frames;
  if (!frames.load(argv[1])) return 1;
  frames.run(SETTLING);
  std::printf("%.1f frames a second\n", frames.rate(seconds));
  if (factor > 0.0) frames.dolly(factor);
  std::fflush(stdout);
  std::_Exit(0);
}
