// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_crowd.h"

#include <gtest/gtest.h>

#include "ros/conversions/crowd_conversions.h"

namespace vegetation_sim {
namespace {

AgentStates onePerson(Nanoseconds stamp, const char* frame = "map") {
  AgentStates out;
  out.header.stamp = toStamp(stamp);
  out.header.frame_id = frame;
  out.agents.push_back(toMsg(crowd::Walker(), terrain::HeightMap()));
  return out;
}

TEST(SubscribedCrowd, RejectsOtherFrames) {
  std::string reason;
  SubscribedCrowd crowd(
      {"map", false, [&](const std::string&, const std::string& why) { reason = why; }});
  crowd.apply(onePerson(NANOSECONDS_PER_SECOND, "odom"));
  EXPECT_TRUE(crowd.people().empty());
  EXPECT_EQ(crowd.changes(), 0);
  EXPECT_FALSE(crowd.status().good);
  EXPECT_NE(reason.find("odom"), std::string::npos);
  crowd.apply(onePerson(NANOSECONDS_PER_SECOND));
  EXPECT_EQ(crowd.people().size(), 1u);
  EXPECT_EQ(crowd.frame(), "map");
  EXPECT_TRUE(crowd.status().good);
}

// S2-35: bodies follow the styles of the node, rounded to floats.
TEST(SubscribedCrowd, HasTheStylesOfItsTopic) {
  SubscribedCrowd crowd;
  EXPECT_EQ(crowd.motions().size(), crowd::ownStyles().size());
  const crowd::MotionStyles sent{crowd::ownStyles()[2]};
  crowd.apply(toMsg(sent));
  ASSERT_EQ(crowd.motions().size(), 1u);
  EXPECT_EQ(crowd.motions()[0].name, sent[0].name);
  for (const double phase : {0.1, 0.45, 0.99})
    for (std::size_t i = 0; i < crowd::CHANNELS; ++i) {
      EXPECT_NEAR(crowd.motions()[0].walk.anglesAt(phase)[i], sent[0].walk.anglesAt(phase)[i],
                  1e-6);
      EXPECT_NEAR(crowd.motions()[0].turn.anglesAt(phase)[i], sent[0].turn.anglesAt(phase)[i],
                  1e-6);
    }
}

TEST(SubscribedCrowd, KeepsItsStylesWhenOthersAreInvalid) {
  SubscribedCrowd crowd;
  const auto errorOf = [&](const std::function<void(CrowdMotions&)>& spoil) {
    CrowdMotions message = toMsg(crowd::ownStyles());
    spoil(message);
    crowd.apply(message);
    EXPECT_EQ(crowd.motions().size(), crowd::ownStyles().size());
    return crowd.motionsStatus().text;
  };
  const auto limit = static_cast<float>(crowd::LARGEST_ANGLE);
  EXPECT_EQ(errorOf([=](CrowdMotions& m) { m.angles[7] = limit, m.angles[8] = -limit; }),
            "3 styles");
  EXPECT_NE(errorOf([](CrowdMotions& m) { m.angles.pop_back(); }).find("angles has 5183 numbers"),
            std::string::npos);
  EXPECT_NE(errorOf([](CrowdMotions& m) { m.angles[7] = 4.f; }).find("angle = 4 rad is outside"),
            std::string::npos);
  EXPECT_NE(errorOf([](CrowdMotions& m) { m.stand_period[0] = 0.0; }).find("stand_period = 0 s"),
            std::string::npos);
  EXPECT_NE(errorOf([](CrowdMotions& m) { m = CrowdMotions(); }).find("styles are 0"),
            std::string::npos);
}

// S2-35: the first message says how fast a person turns.
TEST(SubscribedCrowd, PeopleTurnAsFastAsTheMessageSays) {
  crowd::Walker turning;
  turning.turn_rate = 0.5;
  SubscribedCrowd crowd, rounded;
  AgentStates states = onePerson(NANOSECONDS_PER_SECOND);
  states.agents[0] = toMsg(turning, terrain::HeightMap());
  crowd.apply(states);
  ASSERT_EQ(crowd.people().size(), 1u);
  EXPECT_EQ(crowd.people()[0].walker.turn_rate, 0.5);
  CrowdView view = toView({turning}, terrain::HeightMap());
  view.header = states.header;
  rounded.apply(view);
  ASSERT_EQ(rounded.people().size(), 1u);
  EXPECT_NEAR(rounded.people()[0].walker.turn_rate, 0.5, 0.5 / 80.0);
}

TEST(SubscribedCrowd, ForgetsPeopleOfTheFutureAndSilentPeople) {
  SubscribedCrowd crowd;
  crowd.apply(onePerson(10 * NANOSECONDS_PER_SECOND));
  crowd.forgetLater(10 * NANOSECONDS_PER_SECOND);
  crowd.forgetSilent(10 * NANOSECONDS_PER_SECOND + SILENCE);
  EXPECT_EQ(crowd.people().size(), 1u);
  crowd.forgetLater(9 * NANOSECONDS_PER_SECOND);
  EXPECT_TRUE(crowd.people().empty());
  EXPECT_FALSE(crowd.status().good);
  crowd.apply(onePerson(10 * NANOSECONDS_PER_SECOND));
  crowd.forgetSilent(10 * NANOSECONDS_PER_SECOND + SILENCE + 1);
  EXPECT_TRUE(crowd.people().empty());
}

TEST(SubscribedCrowd, ForgetsUnchangedPeopleWhateverTheirStamps) {
  SubscribedCrowd crowd;
  const Nanoseconds now =
      1000 * NANOSECONDS_PER_SECOND;  // of a picture whose clock is far ahead of the stamps
  crowd.apply(onePerson(10 * NANOSECONDS_PER_SECOND));
  crowd.forgetUnchanged(now);
  crowd.forgetUnchanged(now + SILENCE);
  EXPECT_EQ(crowd.people().size(), 1u);
  crowd.apply(onePerson(11 * NANOSECONDS_PER_SECOND));
  crowd.forgetUnchanged(now + SILENCE + 1);
  EXPECT_EQ(crowd.people().size(), 1u);
  crowd.forgetUnchanged(now + 2 * SILENCE + 2);
  EXPECT_TRUE(crowd.people().empty());
  EXPECT_FALSE(crowd.status().good);
}

TEST(SubscribedCrowd, ReadsRoundedPeopleLikeTheOthersAndKeepsThemIfAMessageIsInvalid) {
  crowd::Walker walker;
  walker.id = 5;
  walker.position = {3.0, -4.0};
  CrowdView message = toView({walker}, terrain::HeightMap());
  message.header.stamp = toStamp(NANOSECONDS_PER_SECOND);
  message.header.frame_id = "map";
  SubscribedCrowd crowd;
  crowd.apply(message);
  ASSERT_EQ(crowd.people().size(), 1u);
  EXPECT_EQ(crowd.people()[0].walker.id, 5u);
  EXPECT_NEAR(crowd.people()[0].walker.position.y, -4.0, 1e-9);
  EXPECT_EQ(crowd.stamp(), NANOSECONDS_PER_SECOND);
  EXPECT_EQ(crowd.frame(), "map");
  message.heading.clear();
  crowd.apply(message);
  EXPECT_FALSE(crowd.status().good);
  EXPECT_EQ(crowd.people().size(), 1u);
  EXPECT_EQ(crowd.changes(), 1);
  message = toView({}, terrain::HeightMap());
  crowd.apply(message);
  EXPECT_TRUE(crowd.people().empty());
  EXPECT_TRUE(crowd.status().good);
}

}  // namespace
}  // namespace vegetation_sim
