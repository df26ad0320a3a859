// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/time/tick_clock.h"

#include <cmath>
#include <utility>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr int LOOKS_PER_TICK = 4;            // the timer is not aligned with the grid
constexpr unsigned TICK_CLOCK_QUEUE = 1000;  // a fast clock is followed message by message
constexpr double NEWEST = 1.0 / 30.0;        // share of the newest tick in the mean cost

}  // namespace

std::int64_t periodOf(std::int64_t tick, double rate, int tick_rate) {
  if (rate >= tick_rate) return tick;
  return static_cast<std::int64_t>(std::floor(static_cast<double>(tick) * (rate / tick_rate)));
}

TickClock::TickClock(std::string name, int rate, double delay, TickCalls calls, LateTicks late)
    : name_(std::move(name)),
      grid_(rate),
      delay_(fromSeconds(delay)),
      calls_(std::move(calls)),
      late_(late) {}

void TickClock::listen(ros::NodeHandle handle) {
  if (ros::Time::isSimTime()) {
    const boost::function<void(const rosgraph_msgs::Clock&)> heard =
        [this](const rosgraph_msgs::Clock& message) { see(fromMsg(message.clock)); };
    const unsigned queue = late_ == LateTicks::EACH ? TICK_CLOCK_QUEUE : 1;
    clock_ = handle.subscribe<rosgraph_msgs::Clock>("/clock", queue, heard, ros::VoidConstPtr(),
                                                    ros::TransportHints().tcpNoDelay());
  } else {
    timer_ = handle.createTimer(ros::Duration(1.0 / (LOOKS_PER_TICK * grid_.rate())),
                                [this](const ros::TimerEvent&) { see(fromMsg(ros::Time::now())); });
  }
}

void TickClock::drop(std::int64_t due) {
  const std::int64_t between = due - last_ - 1;
  counts_.dropped += static_cast<std::uint64_t>(between);
  if (drop_warning_.hasPassed())
    ROS_WARN("%s: %lld ticks (%g s) are skipped: they could not be computed in time", name_.c_str(),
             static_cast<long long>(between), static_cast<double>(between) / grid_.rate());
  last_ = due - 1;
}

void TickClock::run(std::int64_t tick) {
  const ros::WallTime begin = ros::WallTime::now();
  last_ = tick;
  calls_.tick(tick);
  const double took = (ros::WallTime::now() - begin).toSec();
  cost_ += counts_.ticks == 0 ? took : NEWEST * (took - cost_);
  ++counts_.ticks;
}

void TickClock::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("Ticks", counts_.ticks);
  status.addf("Time of a tick [ms]", "%.3f", 1e3 * cost_);
  status.addf("Time between ticks [ms]", "%.3f", 1e3 / grid_.rate());
  status.add("Ticks dropped", counts_.dropped);
  status.add("Clock jumps back", counts_.jumps);
}

void TickClock::resume(std::int64_t tick) {
  last_ = tick;
  clock_times_.jumpsBackTo(grid_.timeOf(tick));
}

void TickClock::see(Nanoseconds clock) {
  const Nanoseconds now = clock - delay_;
  if (now <= 0) return;  // no clock yet
  const std::int64_t due = grid_.tickAt(now);
  if (clock_times_.jumpsBackTo(clock) && hasBegun()) {
    ROS_WARN("%s: time went back; starting anew", name_.c_str());
    ++counts_.jumps;
    last_ = NEVER;
    if (calls_.back) calls_.back(clock);
  }
  const auto longest = late_ == LateTicks::NEWEST
                           ? std::int64_t{1}
                           : static_cast<std::int64_t>(LONGEST_CATCH_UP * grid_.rate());
  if (hasBegun() && due - last_ > longest) drop(due);
  if (hasBegun() && due <= last_) return;
  if (calls_.before) calls_.before();
  for (std::int64_t tick = hasBegun() ? last_ + 1 : due; tick <= due; ++tick) run(tick);
  if (calls_.after) calls_.after();
}

}  // namespace vegetation_sim
