// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/bvh.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::crowd {
namespace {

const std::string HEAD =
    "HIERARCHY\nROOT hip\n{\n OFFSET 0 0 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation "
    "Xrotation Yrotation\n JOINT knee\n {\n  OFFSET 0 -2 0\n  CHANNELS 2 Yrotation Xrotation\n"
    "  End Site\n  {\n   OFFSET 0 -1 0\n  }\n }\n}\n";
const std::string TAIL = "MOTION\nFrames: 2\nFrame Time: 0.1\n1 2 3 0 0 0 0 0\n0 0 0 90 0 0 0 90\n";

std::string errorOf(const std::string& text) {
  try {
    parseBvh(text, "a.bvh");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = HEAD + TAIL;
  return text.replace(text.find(from), from.size(), to);
}

void expectNear(const Vec3& a, const Vec3& b) {
  EXPECT_LT((a - b).norm(), 1e-12) << a.transpose() << " " << b.transpose();
}

// S2-35: turns are applied in the order of the file, positions replace offsets.
TEST(Bvh, HasJointsWhereTheChannelsPutThem) {
  const BvhMotion motion = parseBvh(HEAD + TAIL, "a.bvh");
  ASSERT_EQ(motion.joints.size(), 3U);
  EXPECT_EQ(motion.joints[1].name, "knee");
  EXPECT_EQ(motion.channels, 8U);
  EXPECT_EQ(motion.frames(), 2U);
  EXPECT_EQ(motion.frame_time, 0.1);
  const std::vector<Vec3> first = jointPositions(motion, 0), second = jointPositions(motion, 1);
  expectNear(first[0], Vec3(1, 2, 3));
  expectNear(first[2], Vec3(1, -1, 3));
  // Ninety degrees about z carry -y to x; in the turned frame ninety about x carry -y to -z.
  expectNear(second[1], Vec3(2, 0, 0));
  expectNear(second[2], Vec3(2, 0, -1));
}

TEST(Bvh, RejectsBrokenFilesByLineValueAndRange) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "a.bvh:1: the text ends, expected HIERARCHY"},
      {replaced("Frame Time: 0.1", "Frame Time: 0"),
       "a.bvh:18: frame time = 0 s is outside 0.001 to 1"},
      {replaced("Frames: 2", "Frames: 1"), "a.bvh:17: number of frames = 1 is outside 2 to"},
      {replaced("Frames: 2", "Frames: 99999"), "a.bvh:21: the text ends"},
      {replaced("Frames: 2", "Frames: 2.5"), "a.bvh:17: number of frames = 2.5 is no whole"},
      {replaced("CHANNELS 2 Yrotation", "CHANNELS 7 Yrotation"),
       "a.bvh:9: CHANNELS = 7 is outside 0 to 6"},
      {replaced("2 Yrotation Xrotation", "2 Yrotation Yrotation"),
       "a.bvh:9: channel Yrotation twice in joint 'knee'"},
      {replaced("2 Yrotation", "2 Wrotation"), "a.bvh:9: channel 'Wrotation' is none of"},
      {replaced("OFFSET 0 -2 0", "OFFSET 0 nan 0"), "a.bvh:8: OFFSET = 'nan' is no number"},
      {replaced("OFFSET 0 -2 0", "OFFSET 0 1e9 0"), "a.bvh:8: OFFSET = 1e+09 is outside"},
      {replaced("End Site", "Joint Site"), "a.bvh:10: 'Joint', expected JOINT, End or }"},
      {replaced("1 2 3 0", "1 2 \x01 0"), "a.bvh:19: value of a channel = '?' is no number"},
      {HEAD + TAIL + "7", "a.bvh:21: '7' after the last frame"}};
  for (const auto& [text, error] : cases)
    EXPECT_EQ(errorOf(text).substr(0, error.size()), error) << errorOf(text);
}

TEST(Bvh, RejectsHugeFiles) {
  std::string deep = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 0 ";
  for (int i = 0; i < 100; ++i) deep += "JOINT b { OFFSET 0 0 0 CHANNELS 0 ";
  EXPECT_NE(errorOf(deep).find("allowed are 64 levels"), std::string::npos) << errorOf(deep);
  std::string wide = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 0 ";
  for (int i = 0; i < 300; ++i) wide += "JOINT b { OFFSET 0 0 0 CHANNELS 0 } ";
  EXPECT_NE(errorOf(wide).find("more than 256 joints"), std::string::npos) << errorOf(wide);
  std::string long_one = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 1 Xposition ";
  for (int i = 0; i < 200; ++i) long_one += "JOINT b { OFFSET 0 0 0 CHANNELS 0 } ";
  long_one += "} MOTION Frames: 100000 Frame Time: 0.01";
  EXPECT_NE(errorOf(long_one).find("joints in all frames, allowed are 2000000"), std::string::npos)
      << errorOf(long_one);
  EXPECT_NE(errorOf(std::string(LARGEST_BVH + 1, ' ')).find("allowed are"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::crowd
