// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdMotions.h>
#include <vegetation_sim/CrowdView.h>

#include <functional>
#include <string>
#include <vector>

#include "ros/conversions/crowd_conversions.h"
#include "ros/replicas/subscribed_replica.h"

namespace vegetation_sim {

/// Returns a walker some seconds after the stamp of its message. It goes on as it went, at most for
/// 0.25 s.
crowd::Walker walkOn(crowd::Walker walker, double seconds);

/// The people of another node.
class SubscribedCrowd : public SubscribedReplica<AgentStates> {
 public:
  using Person = WalkerView;

  explicit SubscribedCrowd(const ReplicaOptions& options = {}) : SubscribedReplica(options) {}
  ~SubscribedCrowd() override {
    subscribers_.clear();
    motions_subscriber_.shutdown();
  }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  /// For displays: subscribes to the rounded people on `topic`/view and to `topic` itself.
  /// selectTopic() leaves the latter while the former has a publisher, unlike a recording without.
  /// @throws ros::InvalidNameException
  void subscribeView(ros::NodeHandle handle, const std::string& topic);
  void selectTopic();
  /// Begins or ends to receive what subscribe() has subscribed to, but for the styles of motion.
  void listen(bool is_wanted);
  void apply(const AgentStates& message) override;
  bool accepts(const AgentStates& message) override;
  void apply(const CrowdView& message);
  /// Time jumped back to `now`: people of a later stamp are removed.
  void forgetLater(Nanoseconds now);
  /// Removes all people if the newest message is older than SILENCE.
  void forgetSilent(Nanoseconds now);
  /// Removes all people if nothing has changed for longer than SILENCE in the time of the calls.
  /// Stamps have no effect: the clock of the picture may differ from them.
  void forgetUnchanged(Nanoseconds now);

  /// Whether a publisher of the topic is connected.
  bool isPublished() const;
  const std::vector<Person>& people() const { return people_; }
  /// Styles of motion from `topic`/motions; the own ones until there is a message.
  const crowd::MotionStyles& motions() const { return motions_; }
  void apply(const CrowdMotions& message);
  Nanoseconds stamp() const { return stamp_; }
  /// Number of changes; 0: no message has been accepted.
  int changes() const { return changes_; }
  const InputStatus& status() const { return status_; }
  /// Returns the status of the styles, whose last invalid message is ignored.
  const InputStatus& motionsStatus() const { return motions_status_; }

 private:
  void clear(const char* why);
  void subscribeMotions(ros::NodeHandle handle, const std::string& topic);
  void replace(std::vector<Person> people, const std_msgs::Header& header);

  std::function<void()> subscribe_full_;  // to all people
  bool has_view_{false};
  std::vector<Person> people_;
  crowd::MotionStyles motions_{crowd::ownStyles()};
  ros::Subscriber motions_subscriber_;
  Nanoseconds stamp_{0};
  int changes_{0}, seen_changes_{0};
  Nanoseconds changed_{0};  // time of the call of forgetUnchanged() after the last change
  InputStatus status_, motions_status_{true, "Own styles"};
};

}  // namespace vegetation_sim
