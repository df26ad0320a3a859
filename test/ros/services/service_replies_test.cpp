// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/service_replies.h"

#include <gtest/gtest.h>
#include <vegetation_sim/GetTree.h>

#include <functional>
#include <string>

namespace vegetation_sim {
namespace {

GetTree::Response replyOf(const std::function<std::string()>& body) {
  GetTree::Response out;
  out.height = 3.0;
  EXPECT_TRUE(answer(out, body));
  return out;
}

TEST(ServiceReplies, SuccessHasTheMessageAndNoCode) {
  const GetTree::Response reply = replyOf([] { return "grown"; });
  EXPECT_TRUE(reply.success);
  EXPECT_EQ(reply.error_code, ErrorCode::NONE);
  EXPECT_EQ(reply.message, "grown");
  EXPECT_EQ(reply.height, 3.0);
}

// A rejected request has no half of a result.
TEST(ServiceReplies, ARejectionHasCodeAndTextOnly) {
  const GetTree::Response reply =
      replyOf([]() -> std::string { throw InvalidInput("grabs = 257", FaultCode::NO_ROOM); });
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.error_code, ErrorCode::NO_ROOM);
  EXPECT_EQ(reply.message, "grabs = 257");
  EXPECT_EQ(reply.height, 0.0);
}

TEST(ServiceReplies, ANumberThatIsOutOfRangeIsUnknownAndAnythingElseAFaultOfTheNode) {
  EXPECT_EQ(replyOf([]() -> std::string { throw std::out_of_range("tree"); }).error_code,
            ErrorCode::UNKNOWN);
  EXPECT_EQ(replyOf([]() -> std::string { throw std::bad_alloc(); }).error_code,
            ErrorCode::INTERNAL);
}

TEST(ServiceReplies, SeveralFaultsHaveTheCodeOfTheFirst) {
  Faults faults;
  faults.add("ids: walker 7 is unknown", FaultCode::UNKNOWN);
  faults.add("goal.x = 1e9 m is outside");
  EXPECT_EQ(replyOf([&]() -> std::string {
              faults.throwIfAny();
              return "";
            }).error_code,
            ErrorCode::UNKNOWN);
}

// The standard service std_srvs/Trigger has no code.
TEST(ServiceReplies, TriggersAreRejectedByText) {
  std_srvs::Trigger::Response reply;
  answer(reply, []() -> std::string { throw InvalidInput("a replay"); });
  EXPECT_FALSE(reply.success);
  EXPECT_EQ(reply.message, "a replay");
}

}  // namespace
}  // namespace vegetation_sim
