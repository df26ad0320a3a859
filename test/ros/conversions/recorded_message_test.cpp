// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/conversions/recorded_message.h"

#include <gtest/gtest.h>
#include <std_msgs/String.h>
#include <vegetation_sim/CrowdEvent.h>

#include <cstdint>
#include <vector>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

const std::string CROWD_EVENT = "vegetation_sim/CrowdEvent";
const std::string CROWD_MD5 = ros::message_traits::md5sum<CrowdEvent>();

// Returns a message as a subscriber of any type receives it.
template <class Message>
topic_tools::ShapeShifter receivedAs(const std::string& type, const std::string& md5,
                                     const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  topic_tools::ShapeShifter received;
  received.morph(md5, type, "", "0");
  ros::serialization::IStream in(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  received.read(in);
  return received;
}

TEST(RecordedMessage, AMessageOfThisVersionIsReadWhole) {
  CrowdEvent event;
  event.kind = CrowdEvent::REMOVE;
  event.id = 7;
  const auto read = readRecorded<CrowdEvent>(receivedAs(CROWD_EVENT, CROWD_MD5, event));
  EXPECT_EQ(read->kind, event.kind);
  EXPECT_EQ(read->id, event.id);
}

TEST(RecordedMessage, AMessageOfAnotherVersionIsRejectedWithBothVersions) {
  const auto old = receivedAs(CROWD_EVENT, "0123", CrowdEvent());
  EXPECT_EQ(errorOf([&] { readRecorded<CrowdEvent>(old); }),
            "recorded with another version of vegetation_sim, as " + CROWD_EVENT +
                " of MD5 sum 0123; this version reads " + CROWD_EVENT + " of MD5 sum " + CROWD_MD5);
}

TEST(RecordedMessage, AMessageOfAnotherTypeIsRejectedEvenWithTheSum) {
  const auto other = receivedAs("std_msgs/String", CROWD_MD5, std_msgs::String());
  EXPECT_NE(errorOf([&] { readRecorded<CrowdEvent>(other); }).find("std_msgs/String"),
            std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim
