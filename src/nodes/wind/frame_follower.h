// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tf2_ros/buffer.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "nodes/wind/wind_settings.h"
#include "ros/services/missing_inputs.h"
#include "wind/schedule/attachment.h"
#include "wind/schedule/primitive_schedule.h"

namespace vegetation_sim {

/// Sources whose centre is a tf frame. The broadcaster alone looks up tf, at update(), and
/// publishes pieces of trajectory, so that wind needs no tf elsewhere and a bag replays.
class FrameFollower {
 public:
  FrameFollower(const tf2_ros::Buffer& buffer, const WindSettings& settings);

  /// Follows a frame for this source, instead of any source of the same name.
  /// @throws InvalidInput if too many are followed.
  void set(const wind::Source& source);
  bool follows(const std::string& name) const { return attachments_.count(name) > 0; }
  void remove(const std::string& name) { attachments_.erase(name); }
  void clear();

  /// Takes what refused an input, and why.
  using Report = std::function<void(const std::string& what, const std::string& why)>;
  /// Samples every frame and adds the next pieces to the schedule. A frame that is out of range, or
  /// jumps, is reported. @return whether any piece was added.
  /// @throws InvalidInput if the schedule is full.
  bool update(wind::PrimitiveSchedule& schedule, Nanoseconds now, const Report& report);

  std::vector<std::string> names() const;
  /// Maps the names of the sources to their attachments.
  using Attachments = std::map<std::string, wind::Attachment>;
  const Attachments& attachments() const { return attachments_; }
  void restore(const Attachments& attachments);
  /// Writes or reads attachments of this node. @throws InvalidInput when it reads.
  void archive(Archive& a, Attachments& attachments) const;
  /// Transforms that the last update missed.
  MissingInputs& missing() { return missing_; }

 private:
  bool sample(wind::Attachment& attachment, Nanoseconds now, const Report& report);

  const tf2_ros::Buffer& buffer_;
  std::string frame_id_;
  double period_, horizon_, lead_;  // [s]
  Attachments attachments_;
  MissingInputs missing_;
};

}  // namespace vegetation_sim
