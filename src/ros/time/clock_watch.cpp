// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/time/clock_watch.h"

#include <algorithm>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr unsigned WATCHED_CLOCK_QUEUE =
    1000;                             // a jump back must not be lost between two later messages
constexpr double POLL_PERIOD = 0.05;  // [s] of wall time

}  // namespace

ClockWatch::ClockWatch(ros::NodeHandle nh, std::function<void(Nanoseconds)> begin)
    : begin_(std::move(begin)) {
  if (ros::Time::isSimTime()) {
    const boost::function<void(const rosgraph_msgs::Clock&)> heard =
        [this](const rosgraph_msgs::Clock& message) { see(fromMsg(message.clock)); };
    clock_ =
        nh.subscribe<rosgraph_msgs::Clock>("/clock", WATCHED_CLOCK_QUEUE, heard,
                                           ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
    return;
  }
  poll_ = nh.createWallTimer(ros::WallDuration(POLL_PERIOD), [this](const ros::WallTimerEvent&) {
    see(fromMsg(ros::Time::now()));
  });
  see(fromMsg(ros::Time::now()));
}

Nanoseconds ClockWatch::now() const {
  const Nanoseconds newest = clock_times_.newest();
  return ros::Time::isSimTime() ? newest : std::max(newest, fromMsg(ros::Time::now()));
}

void ClockWatch::see(Nanoseconds now) {
  const bool begins = !running() && now > 0, back = clock_times_.jumpsBackTo(now);
  if (back) ++jumps_;
  if ((begins || back) && now > 0) begin_(now);
}

}  // namespace vegetation_sim
