// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/frame_listener.h"

#include <tf2/exceptions.h>

#include <utility>

#include "ros/services/subscriptions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr unsigned FRAMES_QUEUE = 100;

}  // namespace

FrameListener::FrameListener(tf2_ros::Buffer& buffer, ros::NodeHandle handle)
    : buffer_(buffer), handle_(std::move(handle)), spinner_(1, &queue_) {
  handle_.setCallbackQueue(&queue_);
  const boost::function<void(const Arrival&)> moving = [this](const Arrival& arrival) {
    add(arrival, false);
  };
  const boost::function<void(const Arrival&)> fixed = [this](const Arrival& arrival) {
    add(arrival, true);
  };
  moving_ = subscribeWithoutDelay<tf2_msgs::TFMessage>(handle_, "/tf", FRAMES_QUEUE, moving);
  fixed_ = handle_.subscribe<tf2_msgs::TFMessage>("/tf_static", FRAMES_QUEUE, fixed);
  buffer_.setUsingDedicatedThread(true);
  spinner_.start();
}

FrameListener::~FrameListener() {
  spinner_.stop();
  moving_.shutdown();
  fixed_.shutdown();
}

void FrameListener::add(const Arrival& arrival, bool is_static) {
  if (clock_times_.jumpsBackTo(fromMsg(ros::Time::now()))) buffer_.clear();
  for (const geometry_msgs::TransformStamped& frame : arrival.getConstMessage()->transforms) {
    try {
      buffer_.setTransform(frame, arrival.getPublisherName(), is_static);
    } catch (const tf2::TransformException& error) {
      if (rejections_.hasPassed())
        ROS_ERROR("frame '%s' is rejected: %s", frame.child_frame_id.c_str(), error.what());
    }
  }
}

}  // namespace vegetation_sim
