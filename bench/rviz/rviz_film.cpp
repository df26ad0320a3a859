// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Takes pictures of a running scenario. The program publishes /clock itself and steps from picture
// to picture, so that a slow rasteriser takes longer but shows the same motion. It draws each
// picture at twice its size and averages four pixels into one. Nodes need use_sim_time.
// usage: rviz_film FILE.rviz OUT WIDTH HEIGHT START [FRAMES [RATE]] -- TOPIC ...
//   OUT      OUT.png is written, or OUT-001.png, OUT-002.png ... if there is more than one frame
//   START    time of the first picture [s]
//   RATE     pictures per second of ROS time
//   TOPIC    a topic whose messages have a header; a picture waits until each has reached its time
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <rviz/ogre_helpers/render_system.h>
#include <std_msgs/Header.h>

#include <QApplication>
#include <QImage>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <list>
#include <string>
#include <vector>

#include "rviz/view_panel.h"

namespace {
/// The beginning of any message that has a header.
struct Stamped {
  std_msgs::Header header;
};
}  // namespace

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<Stamped> {
  static const char* value() { return "*"; }
  static const char* value(const Stamped&) { return "*"; }
};
template <>
struct DataType<Stamped> {
  static const char* value() { return "*"; }
  static const char* value(const Stamped&) { return "*"; }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<Stamped> {
  template <class Stream>
  static void read(Stream& stream, Stamped& message) {
    stream.next(message.header);
  }
};
}  // namespace serialization
}  // namespace ros

namespace {

namespace bench = vegetation_sim::bench;

constexpr double BEGIN = 1.0;        // [s] of the clock at the start
constexpr double STEP = 1.0 / 60.0;  // [s] of the clock, at most
constexpr double STEP_TIME = 0.01;   // [s] of wall time, at least, in which robots move on
constexpr double TICK = 1.0 / 15.0;  // [s] that a topic may be behind the clock
constexpr double PATIENCE = 60.0;    // [s] of wall time for a message
constexpr int SETTLING = 60;         // updates in which displays finish their geometry
constexpr int FRAMES_A_PICTURE = 3;  // frames until new messages are drawn
constexpr int OVERSAMPLING = 2;

class StampedTopic {
 public:
  StampedTopic(ros::NodeHandle& handle, const std::string& name) : name_(name) {
    subscriber_ = handle.subscribe<Stamped>(
        name, 1000, [this](const boost::shared_ptr<const Stamped>& message) {
          stamp_ = std::max(stamp_, message->header.stamp.toSec());
        });
  }

  double stamp() const { return stamp_; }
  bool isConnected() const { return subscriber_.getNumPublishers() > 0; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  double stamp_ = 0.0;  // [s] of the newest message
  ros::Subscriber subscriber_;
};

class Film {
 public:
  Film(int width, int height, const std::vector<std::string>& topics)
      : width_(width), height_(height), view_(OVERSAMPLING * width, OVERSAMPLING * height) {
    clock_ = handle_.advertise<rosgraph_msgs::Clock>("/clock", 1);
    for (const std::string& topic : topics) topics_.emplace_back(handle_, topic);
  }

  bool load(const char* file) { return view_.load(file, file); }

  /// Returns false if a topic does not follow the clock.
  bool advanceTo(double time) {
    while (now_ < time) {
      now_ = std::min(time, now_ + STEP);
      publishClock();
      view_.run(STEP_TIME);
    }
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(PATIENCE);
    for (const StampedTopic& topic : topics_)
      while (topic.stamp() < now_ - TICK) {
        publishClock();  // again, for nodes that have subscribed since
        view_.run(STEP_TIME);
        if (ros::WallTime::now() < end) continue;
        std::fprintf(stderr, "rviz_film: %s is at %.3f s, the clock at %.3f s\n",
                     topic.name().c_str(), topic.stamp(), now_);
        return false;
      }
    return true;
  }

  /// Waits for the publishers of all topics, which publish a state at the first tick once.
  bool connect() {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(PATIENCE);
    for (const StampedTopic& topic : topics_)
      while (!topic.isConnected()) {
        view_.run(STEP_TIME);
        if (ros::WallTime::now() < end) continue;
        std::fprintf(stderr, "rviz_film: nobody publishes %s\n", topic.name().c_str());
        return false;
      }
    view_.run(1.0);  // the other ends of the connections
    return true;
  }

  /// Advances from the start to the first picture. Displays are updated, but nothing is drawn,
  /// which would take most of the time.
  bool approach(double time) {
    if (!connect()) return false;
    view_.window().setAutoUpdated(false);
    for (double at = BEGIN; at < time; at += 0.1)
      if (!advanceTo(at)) return false;
    if (!advanceTo(time)) return false;
    view_.drawFrames(SETTLING);
    view_.window().setAutoUpdated(true);
    return true;
  }

  bool take(const std::string& file) {
    view_.drawFrames(FRAMES_A_PICTURE);
    const std::vector<unsigned char> bytes = view_.picture();
    const int width = OVERSAMPLING * width_, height = OVERSAMPLING * height_;
    const QImage image(bytes.data(), width, height, 3 * width, QImage::Format_RGB888);
    return image.scaled(width_, height_, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
        .save(QString::fromStdString(file));
  }

 private:
  void publishClock() {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(now_);
    clock_.publish(message);
  }

  ros::NodeHandle handle_;
  ros::Publisher clock_;
  std::list<StampedTopic> topics_;
  int width_, height_;
  bench::ViewPanel view_;
  double now_ = 0.0;
};

std::string fileOf(const std::string& out, int frame, int frames) {
  char number[16] = "";
  if (frames > 1) std::snprintf(number, sizeof number, "-%03d", frame + 1);
  return out + number + ".png";
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "rviz_film", ros::init_options::AnonymousName);
  const QApplication application(argc, argv);
  char** const split = std::find_if(argv, argv + argc,
                                    [](const char* word) { return std::strcmp(word, "--") == 0; });
  const auto given = split - argv;
  if (given < 6 || given > 8 || split == argv + argc) {
    std::fprintf(
        stderr, "usage: rviz_film FILE.rviz OUT WIDTH HEIGHT START [FRAMES [RATE]] -- TOPIC ...\n");
    return 2;
  }
  const double start = std::atof(argv[5]), rate = given > 7 ? std::atof(argv[7]) : 12.0;
  const int frames = given > 6 ? std::atoi(argv[6]) : 1;
  rviz::RenderSystem::disableAntiAliasing();  // pictures are drawn larger instead
  Film film(std::atoi(argv[3]), std::atoi(argv[4]), {split + 1, argv + argc});
  bool good = film.load(argv[1]) && film.approach(start);
  for (int frame = 0; good && frame < frames; ++frame)
    good = film.advanceTo(start + frame / rate) && film.take(fileOf(argv[2], frame, frames));
  std::fflush(stderr);
  std::_Exit(good ? 0 : 1);  // rviz does not end cleanly without its window
}
