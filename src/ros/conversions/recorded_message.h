// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <topic_tools/shape_shifter.h>

#include <boost/shared_ptr.hpp>
#include <string>

namespace vegetation_sim {

/// @throws InvalidInput with both types and MD5 sums if a message differs from this type.
void checkRecorded(const topic_tools::ShapeShifter& recorded, const std::string& type,
                   const std::string& md5);

/// Returns a message of a bag as this version's type. A subscriber of that type would never receive
/// the messages of another version: roscpp refuses the connection and reports it nowhere.
/// @throws InvalidInput if another version of the package has recorded it.
template <class Message>
boost::shared_ptr<const Message> readRecorded(const topic_tools::ShapeShifter& recorded) {
  checkRecorded(recorded, ros::message_traits::datatype<Message>(),
                ros::message_traits::md5sum<Message>());
  return recorded.instantiate<Message>();
}

}  // namespace vegetation_sim
