// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/WindField.h>

#include "ros/replicas/subscribed_replica.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {

/// The wind field of another node. It is a function of time, so nothing of it becomes invalid when
/// time jumps back.
class SubscribedWind : public SubscribedReplica<WindField> {
 public:
  /// @param on_change called with each new field; fields are never delayed.
  explicit SubscribedWind(const ReplicaOptions& options = {},
                          std::function<void(const wind::Field&)> on_change = {})
      : SubscribedReplica({options.frame_id, false, options.on_rejected}),
        on_change_(std::move(on_change)) {}
  ~SubscribedWind() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  void apply(const WindField& message) override;
  bool accepts(const WindField& message) override;

  const wind::Field& field() const { return field_; }
  /// Number of accepted messages.
  int messages() const { return messages_; }
  const InputStatus& status() const { return status_; }

 private:
  std::function<void(const wind::Field&)> on_change_;
  wind::Field field_;
  int messages_{0};
  InputStatus status_;
};

}  // namespace vegetation_sim
