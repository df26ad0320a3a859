// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include <cstdint>
#include <functional>
#include <string>

#include "ros/time/backward_step.h"
#include "ros/time/warning_interval.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Callbacks of a TickClock; all but `tick` may be empty.
struct TickCalls {
  /// Called once before the ticks that are due, if any.
  std::function<void()> before{};
  /// Runs tick number `tick` of the grid; TickClock::stamp() is its stamp.
  std::function<void(std::int64_t tick)> tick;
  /// Called when time jumps back to `clock`, before the tick that is due then.
  std::function<void(Nanoseconds clock)> back{};
  /// Called once after the ticks that were due, if any.
  std::function<void()> after{};
};

/// Returns the number of the period of 1 / rate to which a tick belongs, of `tick_rate` ticks per
/// second. A higher rate is that of the ticks.
std::int64_t periodOf(std::int64_t tick, double rate, int tick_rate);

/// Ticks that a late node runs: each one, or only the newest if it has no state.
enum class LateTicks { EACH, NEWEST };

/// Runs a node's ticks on an integer grid of ROS time. Late ticks are caught up one by one for up
/// to LONGEST_CATCH_UP; after a larger leap the ticks between are dropped and counted. A jump back
/// (BackwardStep) is a restart; no tick runs during a smaller step back. With simulated time it
/// follows every message of /clock in the queue of the node's other inputs. With LateTicks::NEWEST
/// all late ticks but the newest are dropped and counted, and only the newest message of /clock is
/// used.
class TickClock {
 public:
  /// @param name of the node, in its warnings. @param rate ticks per second [Hz].
  /// @param delay how far ticks stay behind the clock [s].
  TickClock(std::string name, int rate, double delay, TickCalls calls,
            LateTicks late = LateTicks::EACH);

  /// Starts to follow the clock. To be called at the end of a node's constructor: the first ticks
  /// of a nodelet may come from another thread.
  void listen(ros::NodeHandle handle);
  /// Stops following the clock.
  void stop() {
    clock_.shutdown();
    timer_.stop();
  }
  /// Runs the ticks that are due at this time.
  void see(Nanoseconds clock);
  /// Takes a tick as the last one, which another process has run. An earlier clock is a jump back.
  void resume(std::int64_t tick);

  /// Whether a tick was begun since the last jump back.
  bool hasBegun() const { return last_ != NEVER; }
  /// Returns the last tick that was begun. Requires hasBegun().
  std::int64_t tick() const { return last_; }
  Nanoseconds stamp() const { return grid_.timeOf(last_); }
  const TickGrid& grid() const { return grid_; }

  struct Counts {
    std::uint64_t ticks{0};    ///< done
    std::uint64_t dropped{0};  ///< because the node was late or the clock leapt
    std::uint64_t jumps{0};    ///< back, of the clock
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
  BackwardStep clock_times_;
  std::int64_t last_{NEVER};
  Counts counts_;
  double cost_{0.0};
  WarningInterval drop_warning_;
  ros::Subscriber clock_;
  ros::Timer timer_;
};

}  // namespace vegetation_sim
