// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/canopy_conversions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error_text.h"
#include "scenes/canopy/canopy_scene.h"

namespace vegetation_sim {
namespace {

TEST(CanopyConversions, LayoutSurvivesTheRoundTrip) {
  const canopy::Layout layout = canopy::shrubScene();
  CanopyLayout message = toMsg(layout);
  EXPECT_EQ(fromMsg(message).hash(), layout.hash());
  message.plants[1].yaw += 1e-9;
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("its hash is"), std::string::npos);
  message.plants[1].kind = 7;
  message.plants[0].position.x = std::nan("");
  const std::string text = errorOf([&] { fromMsg(message); });
  EXPECT_NE(text.find("kind = 7 is unknown"), std::string::npos) << text;
  EXPECT_NE(text.find("plants[0]: position.x"), std::string::npos) << text;
  message.law = "{";
  EXPECT_THROW(fromMsg(message), InvalidInput);
}

// A replica that receives the messages moves every leaf to the same bits.
TEST(CanopyConversions, StateRebuildsEveryLeafToTheBit) {
  canopy::Canopy sender(canopy::shrubScene());
  sender.setWind(canopy::breezeFrom(Vec3(2.0, 4.0, 0.0)));
  sender.setViewer(canopy::CutView{Vec3(-6.0, 1.0, 1.7), {std::sqrt(0.84), 0.0, 0.0, 0.4}});
  canopy::Replica receiver(fromMsg(toMsg(sender.layout())));
  forest::Body body;
  body.id = "ball";
  body.size.x() = 0.6;
  body.pose.position = sender.layout().plants[1].position + Vec3(0.3, 0.2, 0.8);
  body.stamp = canopy::tickStamp(0);
  sender.setBody(body);
  for (int tick = 0; tick < 60; ++tick) {
    sender.advance(canopy::tickStamp(tick));
    receiver.apply(fromMsg(toMsg(sender.update(true))));
  }
  EXPECT_TRUE(receiver.foliage().isBent(1));
  const canopy::Layout& layout = sender.layout();
  for (const canopy::Leaf& leaf : canopy::grow(layout.kinds[0], layout.plants[1]).leaves) {
    const canopy::MovedLeaf want = sender.foliage().move(leaf, 1);
    ASSERT_NE(want.tip, leaf.tip);
    ASSERT_EQ(receiver.foliage().move(leaf, 1).tip, want.tip);
  }
}

TEST(CanopyConversions, InvalidStatesAreRejected) {
  canopy::Canopy sender(canopy::shrubScene());
  sender.advance(canopy::tickStamp(0));
  const CanopyState good = toMsg(sender.update(false));
  EXPECT_EQ(errorOf([&] { fromMsg(good); }), "");
  CanopyState bad = good;
  bad.right[3] = 0x7e00;
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("not finite"), std::string::npos);
  bad = good;
  bad.front_share = 1.5;
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("front_share = 1.5"), std::string::npos);
  bad = good;
  bad.eye.orientation.w = 0.0;
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("norm"), std::string::npos);
  bad = good;
  bad.bent_plants = {0, 1};
  bad.bent_cells = {3, 4};
  bad.lean_x = {100, 200};
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("lean_y has 0 entries, bent_plants has 2"),
            std::string::npos);
  bad.lean_y = {0, -100};
  EXPECT_EQ(fromMsg(bad).bent.at(1).y, -100);
  bad = good;
  bad.lists_cuts = true;
  bad.cut_plants = {0, 1};
  bad.cut_heights = {0.3};
  EXPECT_NE(errorOf([&] { fromMsg(bad); }).find("cut_heights has 1 entries, cut_plants has 2"),
            std::string::npos);
  bad.cut_heights.push_back(0.4);
  EXPECT_EQ(fromMsg(bad).stubble, (canopy::Stubble{{0, 0.3}, {1, 0.4}}));
  EXPECT_EQ(fromMsg(toMsg(fromMsg(bad))).stubble, fromMsg(bad).stubble);
  bad.lists_cuts = false;
  EXPECT_FALSE(fromMsg(bad).stubble);
  bad = good;
  bad.up.resize(7);
  canopy::Replica receiver(sender.layout());
  EXPECT_NE(errorOf([&] { receiver.apply(fromMsg(bad)); }).find("cells"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim
