// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/buffer.h>

#include "ros/time/backward_step.h"
#include "ros/time/warning_interval.h"

namespace vegetation_sim {

/// Fills a buffer with the frames of /tf and /tf_static, in a thread of its own. A step back of the
/// clock keeps them, as nodes ride it out (BackwardStep); tf2_ros::TransformListener would clear
/// the buffer.
class FrameListener {
 public:
  /// @param buffer must outlive the listener.
  explicit FrameListener(tf2_ros::Buffer& buffer, ros::NodeHandle handle = ros::NodeHandle());
  ~FrameListener();

 private:
  using Arrival = ros::MessageEvent<const tf2_msgs::TFMessage>;

  void add(const Arrival& arrival, bool is_static);

  tf2_ros::Buffer& buffer_;
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  BackwardStep clock_times_;
  WarningInterval rejections_;
  ros::Subscriber moving_, fixed_;
  ros::AsyncSpinner spinner_;
};

}  // namespace vegetation_sim
