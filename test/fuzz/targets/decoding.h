// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/serialization.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::fuzz {

/// Reads the wire format of ROS. Unlike ros::serialization::IStream it rejects a list that
/// announces more elements than bytes follow, before memory is allocated for them: that defect of
/// roscpp is not ours.
class InputStream : public ros::serialization::Stream {
 public:
  static const ros::serialization::StreamType stream_type = ros::serialization::stream_types::Input;

  explicit InputStream(std::string_view bytes)
      : Stream(reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data())),
               static_cast<std::uint32_t>(bytes.size())) {}

  template <class T>
  void next(T& value) {
    ros::serialization::deserialize(*this, value);
  }
  template <class T, class Allocator>
  void next(std::vector<T, Allocator>& list) {
    InputStream head = *this;
    std::uint32_t count = 0;
    head.next(count);
    if (count > head.getLength()) ros::serialization::throwStreamOverrun();
    ros::serialization::deserialize(*this, list);
  }
  template <class T>
  InputStream& operator>>(T& value) {
    next(value);
    return *this;
  }
};

/// @return false if the bytes are no such message.
template <class Message>
bool decode(std::string_view bytes, Message& message) {
  InputStream stream(bytes);
  try {
    ros::serialization::deserialize(stream, message);
    return true;
  } catch (const ros::serialization::StreamOverrunException&) {
    return false;
  }
}

template <class Message>
std::string encode(const Message& message) {
  std::string out(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(out.data()),
                                     static_cast<std::uint32_t>(out.size()));
  ros::serialization::serialize(stream, message);
  return out;
}

/// Returns the first number of a text that is above 2^32 and not `sent`; 0 if there is none.
std::uint64_t otherHashIn(const std::string& text, std::uint64_t sent);

/// Gives a layout or a wind the hash of its content, which no fuzzer guesses. The error about a
/// wrong hash names the right one.
template <class Message>
void repairHash(Message& message) {
  try {
    fromMsg(message);
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    if (text.find("hash") == std::string::npos) return;
    if (const std::uint64_t hash = otherHashIn(text, message.hash)) message.hash = hash;
  }
}

}  // namespace vegetation_sim::fuzz
