// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/serialization.h>
#include <ros/subscriber.h>
#include <ros/time.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ros/replicas/delay_buffer.h"
#include "ros/replicas/input_status.h"
#include "ros/services/request_checks.h"
#include "ros/services/rivals.h"
#include "ros/services/stamp_limits.h"
#include "ros/services/subscriptions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

struct ReplicaOptions {
  /// Messages in other frames are rejected; if it is empty, all frames are accepted.
  std::string frame_id;
  /// State messages wait for advance(); otherwise they are applied on arrival.
  bool delayed{false};
  /// Called with the name of the input and the reason for each rejected message.
  std::function<void(const std::string& input, const std::string& why)> on_rejected;
};

/// The common part of the replicas that are rebuilt from messages. A rejected message changes
/// nothing but the status of its input. Callbacks run in the queue of the node handle, in a nodelet
/// not in the thread that destroys it: destructors of derived classes end the subscriptions first.
template <class State>
class SubscribedReplica {
 public:
  explicit SubscribedReplica(ReplicaOptions options) : options_(std::move(options)) {}
  virtual ~SubscribedReplica() = default;
  SubscribedReplica(const SubscribedReplica&) = delete;
  SubscribedReplica& operator=(const SubscribedReplica&) = delete;

  virtual void apply(const State& message) = 0;
  /// Returns whether a message that is to be delayed is valid; an invalid one is rejected.
  virtual bool accepts(const State& message) = 0;
  /// Applies the delayed states with stamps up to `stamp`.
  void advance(Nanoseconds stamp) {
    delayed_.take(stamp, [this](Nanoseconds, const auto& message) { apply(*message); });
  }
  /// Number of delayed states, and of those that were dropped because too many waited.
  std::size_t waiting() const { return delayed_.size(); }
  /// Whether a delayed state with a stamp up to `last` waits.
  bool hasWaiting(Nanoseconds last) const { return delayed_.has(last); }
  std::uint64_t lost() const { return delayed_.lost(); }
  /// Frame of the newest layout, or of the newest state of an input without one.
  const std::string& frame() const { return frame_; }
  /// Whether each topic has no more than its one owner.
  InputStatus publishers() const {
    const std::string rivals = this->rivals();
    if (rivals.empty()) return {true, "One of each topic"};
    return {false, rivals + ": the last message wins"};
  }
  virtual std::string rivals() const { return describeRivals(subscribers_); }

 protected:
  /// Calls `take`, which returns the new status of the input; what it throws rejects the message.
  /// @return false if it was rejected.
  bool receive(const char* input, InputStatus& status, const std::function<InputStatus()>& take) {
    try {
      status = take();
      return true;
    } catch (const std::exception& error) {
      status = {false, std::string("Rejected a message: ") + error.what(), true};
      if (options_.on_rejected) options_.on_rejected(input, error.what());
      return false;
    }
  }
  /// @throws InvalidInput for another frame than the one required.
  void requireFrame(const std::string& frame) const {
    if (!options_.frame_id.empty()) checkFrame(frame, options_.frame_id);
  }
  /// @throws InvalidInput for a stamp of a message that is too far ahead of the clock to wait for
  /// it. Before there is a time, any may wait.
  static void requireSoon(const ros::Time& stamp) {
    if (ros::Time::isValid()) requireNear(fromMsg(stamp), fromMsg(ros::Time::now()));
  }
  void subscribeState(ros::NodeHandle& handle, const std::string& topic, std::uint32_t queue) {
    const boost::function<void(const boost::shared_ptr<const State>&)> callback =
        [this](const boost::shared_ptr<const State>& message) {
          if (!options_.delayed)
            apply(*message);
          else if (accepts(*message))
            delayed_.add(fromMsg(message->header.stamp),
                         ros::serialization::serializationLength(*message), message);
        };
    subscribers_.push_back(subscribeWithoutDelay<State>(handle, topic, queue, callback));
  }
  void forgetDelayed(Nanoseconds now) { delayed_.forgetLater(now); }

  ReplicaOptions options_;
  std::string frame_;
  std::vector<ros::Subscriber> subscribers_;

 private:
  DelayBuffer<boost::shared_ptr<const State>> delayed_;
};

}  // namespace vegetation_sim
