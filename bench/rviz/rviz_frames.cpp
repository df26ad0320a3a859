// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Loads a configuration of rviz beside running nodes, without rviz's window, and reports how many
// frames per second it draws, of how many triangles, in what time of all processors, and how much
// levels of detail change pictures as the camera moves away.
// usage: rviz_frames FILE.rviz [--view FILE.rviz] [--settle N] [--seconds N] [--picture FILE]
//        [--after FILE] [--dolly FACTOR]
// The picture is taken once the file of --after exists.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <OgreCamera.h>
#include <ros/ros.h>
#include <rviz/display_group.h>
#include <rviz/frame_manager.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <visualization_msgs/MarkerArray.h>

#include <QApplication>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "processor_time.h"
#include "rviz/view_panel.h"

namespace {

namespace bench = vegetation_sim::bench;

constexpr int WIDTH = 1280, HEIGHT = 900;  // [pixel]
constexpr double LISTENING = 5.0;          // [s] for each topic of markers
constexpr int BLOCK = 16;        // [pixel] edge of the blocks over which differences are averaged
constexpr int WAITING_RATE = 1;  // [frame/s]
constexpr int LAST_FRAMES = 6;   // with the last messages
constexpr int STEPS = 6;         // number of steps of the camera
constexpr int FRAMES_A_STEP = 20;
constexpr int STILL_FRAMES = 15;     // equal frames after which levels of detail count as settled
constexpr double STILL_TIME = 60.0;  // [s] that this may take

class Frames {
 public:
  bool load(const char* file, const char* view) { return view_.load(file, view); }
  void run(double seconds) { view_.run(seconds); }

  void measure(double seconds) {
    const std::uint64_t first = view_.manager().getFrameCount();
    const ros::WallTime start = ros::WallTime::now();
    const double before = bench::processorTime();
    run(seconds);
    const double used = bench::processorTime() - before;
    const auto count = static_cast<double>(view_.manager().getFrameCount() - first);
    const double rate = count / (ros::WallTime::now() - start).toSec();
    const double seen = trianglesInView();
    const auto triangles = static_cast<double>(view_.window().getStatistics().triangleCount);
    std::printf(
        "%.1f frames a second of %.0f triangles, %.0f in the picture; %.0f ms of processor time a "
        "frame\n",
        rate, triangles, seen, 1e3 * used / std::max(count, 1.0));
  }

  /// Draws slowly, which leaves the processor to other programs, until a file exists.
  void waitForFile(const char* file) {
    view_.limitRate(WAITING_RATE);
    while (!std::filesystem::exists(file)) run(0.5);
    view_.drawFrames(LAST_FRAMES);
  }

  void write(const char* file) { view_.window().writeContentsToFile(file); }

  /// Moves back until the distance is `factor` times as large, while time stands still. Prints how
  /// much pictures change after a step, when only levels of detail do: the largest change between
  /// two pictures, and the total. Returns false if pictures do not settle before.
  bool dolly(double factor) {
    view_.manager().getFrameManager()->setPause(true);
    if (!settle()) {
      std::printf("levels of detail: pictures did not rest within %.0f s, so no change of frames\n",
                  STILL_TIME);
      return false;
    }
    rviz::Property* distance = view_.manager().getViewManager()->getCurrent()->subProp("Distance");
    const double start = distance->getValue().toDouble();
    double step = 0.0, all = 0.0;
    for (int i = 1; i <= STEPS; ++i) {
      distance->setValue(start * std::pow(factor, static_cast<double>(i) / STEPS));
      view_.drawFrames(2);  // displays receive the camera one picture later
      const std::vector<unsigned char> first = view_.picture();
      std::vector<unsigned char> last = first;
      for (int frame = 0; frame < FRAMES_A_STEP; ++frame) {
        view_.drawFrames(1);
        const std::vector<unsigned char> next = view_.picture();
        step = std::max(step, largestChange(last, next));
        last = next;
      }
      all = std::max(all, largestChange(first, last));
    }
    std::printf(
        "levels of detail change a block of %d x %d pixels by %.1f of 255, %.1f between two "
        "frames\n",
        BLOCK, BLOCK, all, step);
    return true;
  }

 private:
  /// Returns the triangles of a frame that are not wholly outside: those that clipping passes on to
  /// the rasteriser, without those that fill up lists of markers.
  double trianglesInView() {
    GLuint query = 0, passed = 0;
    glGenQueries(1, &query);
    const std::uint64_t first = view_.manager().getFrameCount();
    glBeginQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB, query);
    view_.drawFrames(1);  // or more
    glEndQuery(GL_CLIPPING_OUTPUT_PRIMITIVES_ARB);
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &passed);
    glDeleteQueries(1, &query);
    const auto count = static_cast<double>(view_.manager().getFrameCount() - first);
    return passed / count - emptyOnesInView();
  }

  /// Returns the triangles without area in the newest markers of each display.
  double emptyOnesInView() {
    const rviz::DisplayGroup& displays = *view_.manager().getRootDisplayGroup();
    std::map<std::string, visualization_msgs::MarkerArray::ConstPtr> heard;
    std::vector<ros::Subscriber> subscribers;
    for (int i = 0; i < displays.numDisplays(); ++i) {
      rviz::Display& display = *displays.getDisplayAt(i);
      if (display.getClassId() != "rviz/MarkerArray") continue;
      const std::string topic =
          display.subProp("Marker Topic")->getValue().toString().toStdString();
      subscribers.push_back(nh_.subscribe<visualization_msgs::MarkerArray>(
          topic, 1, [&heard, topic](const visualization_msgs::MarkerArray::ConstPtr& message) {
            heard[topic] = message;
          }));
    }
    if (!subscribers.empty()) run(LISTENING);
    const Ogre::Camera& camera = *view_.manager().getViewManager()->getCurrent()->getCamera();
    double out = 0.0;
    for (const auto& [topic, message] : heard)
      for (const visualization_msgs::Marker& marker : message->markers)
        for (std::size_t i = 0; i + 2 < marker.points.size(); i += 3) {
          const auto& p = marker.points[i];
          if (p != marker.points[i + 1] || p != marker.points[i + 2]) continue;
          const Ogre::Vector3 at(static_cast<float>(p.x), static_cast<float>(p.y),
                                 static_cast<float>(p.z));
          if (camera.isVisible(at)) out += 1.0;
        }
    return out;
  }

  // Waits until pictures stay the same while time stands still; returns false if they do not.
  bool settle() {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(STILL_TIME);
    std::vector<unsigned char> before;
    for (int alike = 0; alike < STILL_FRAMES;) {
      if (ros::WallTime::now() > end) return false;
      view_.drawFrames(1);
      std::vector<unsigned char> now = view_.picture();
      alike = now == before ? alike + 1 : 0;
      before = std::move(now);
    }
    return true;
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

  ros::NodeHandle nh_;
  bench::ViewPanel view_{WIDTH, HEIGHT};
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "rviz_frames", ros::init_options::AnonymousName);
  const QApplication application(argc, argv);
  double settling = 20.0, seconds = 10.0, factor = 0.0;  // settling: [s] until everything is drawn
  const char *view = argc > 1 ? argv[1] : "", *picture = nullptr, *awaited = nullptr;
  for (int i = 2; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--view") == 0) view = argv[i + 1];
    if (std::strcmp(argv[i], "--picture") == 0) picture = argv[i + 1];
    if (std::strcmp(argv[i], "--after") == 0) awaited = argv[i + 1];
    if (std::strcmp(argv[i], "--settle") == 0) settling = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--dolly") == 0) factor = std::atof(argv[i + 1]);
  }
  if (argc < 2) {
    std::fprintf(stderr,
                 "usage: rviz_frames FILE.rviz [--view FILE.rviz] [--settle N] [--seconds N] "
                 "[--picture FILE] [--after FILE] [--dolly FACTOR]\n");
    return 2;
  }
  // without a graphics card anti-aliasing halves the rate
  rviz::RenderSystem::disableAntiAliasing();
  Frames frames;
  if (!frames.load(argv[1], view)) return 1;
  frames.run(settling);
  frames.measure(seconds);
  if (awaited != nullptr) frames.waitForFile(awaited);
  if (picture != nullptr) frames.write(picture);
  const bool rested = factor <= 0.0 || frames.dolly(factor);
  std::fflush(stdout);
  std::_Exit(rested ? 0 : 1);
}
