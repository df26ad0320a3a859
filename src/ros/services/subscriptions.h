// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/transport_hints.h>

#include <boost/function.hpp>
#include <cstdint>
#include <string>

namespace vegetation_sim {

/// Subscribes to a topic of small messages in quick succession. Publishers send each at once: by
/// default TCP holds a message back until the one before is acknowledged, for up to 40 ms on Linux.
/// @param Argument of the callback: the message, or a shared pointer to it.
/// @throws ros::InvalidNameException
template <class Message, class Argument>
ros::Subscriber subscribeWithoutDelay(ros::NodeHandle handle, const std::string& topic,
                                      std::uint32_t queue,
                                      const boost::function<void(const Argument&)>& callback) {
  return handle.subscribe<Message>(topic, queue, callback, ros::VoidConstPtr(),
                                   ros::TransportHints().tcpNoDelay());
}

}  // namespace vegetation_sim
