// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <cstdint>
#include <functional>
#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// What a node does as time goes on; each may be empty but `tick`.
struct TickCalls {
  /// Once before the ticks that are due, if any.
  std::function<void()> before{};
  /// Tick number `tick` of the grid, in order; TickClock::stamp() is its stamp.
  std::function<void(std::int64_t tick)> tick;
  /// Time went back to `clock`: become what a fresh start would be. The tick due then follows.
  std::function<void(Nanoseconds clock)> back{};
};

/// Which ticks a late node does: each one, or without state only the newest.
enum class LateTicks { EACH, NEWEST };

/// The one rule by which nodes follow ROS time: ticks of an integer grid, none before the clock has
/// begun, late ones caught up one by one for up to a second; where the clock leaps farther, those
/// between are dropped and counted; back by a tick or more is a fresh start. In simulation it goes
/// by every message of /clock, in the order and in the queue of the node's other inputs. With
/// LateTicks::NEWEST it catches up with nothing: what is not done when the next is due is dropped
/// and counted, and of /clock it takes the newest message.
class TickClock {
 public:
  /// @param name of the node, in its warnings. @param rate ticks per second [Hz].
  /// @param delay how far ticks stay behind the clock [s].
  TickClock(std::string name, int rate, double delay, TickCalls calls,
            LateTicks late = LateTicks::EACH);

  /// Begins to follow the clock. The last thing that a node's constructor does: a nodelet's first
  /// ticks may come while it is still being built.
  void listen(ros::NodeHandle handle);
  /// Stops following the clock.
  void stop() {
    clock_.shutdown();
    timer_.stop();
  }
  /// The clock shows this: runs what is due.
  void see(Nanoseconds clock);

  /// A tick has been begun, since the last jump back.
  bool hasBegun() const { return last_ != NEVER; }
  /// The tick that was begun last. Requires hasBegun().
  std::int64_t tick() const { return last_; }
  Nanoseconds stamp() const { return grid_.timeOf(last_); }
  const TickGrid& grid() const { return grid_; }

  struct Counts {
    std::uint64_t ticks{0};    ///< done
    std::uint64_t dropped{0};  ///< left out, the node was late or the clock leapt
    std::uint64_t jumps{0};    ///< of the clock back
  };
  const Counts& counts() const { return counts_; }
  /// Adds the counts and the wall time of a tick to a node's diagnostics.
  void report(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  static constexpr double LONGEST_CATCH_UP = 1.0;  ///< [s]

 private:
  static constexpr std::int64_t NEVER = INT64_MIN;

  void drop(std::int64_t due);
  void run(std::int64_t tick);

  std::string name_;
  TickGrid grid_;
  Nanoseconds delay_;
  TickCalls calls_;
  LateTicks late_;
  std::int64_t last_{NEVER};
  Counts counts_;
  double cost_{0.0};
  ros::Subscriber clock_;
  ros::Timer timer_;
};

}  // namespace vegetation_sim
