// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The ranges of dynamic_reconfigure are those of the structures in the node.
#include <gtest/gtest.h>

#include <vegetation_sim/ForestAnimatorConfig.h>

#include <algorithm>
#include <string>

#include "nodes/base/event_node.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/rigs/declared_fields.h"

namespace vegetation_sim {
namespace {

TEST(ForestRanges, MatchDynamicReconfigure) {  // S1-10, S1-45
  ForestTuning tuning;
  Declared declared;
  describe(declared, tuning);
  EXPECT_EQ(offered(ForestAnimatorConfig::__getMin__()), declared.low);
  EXPECT_EQ(offered(ForestAnimatorConfig::__getMax__()), declared.high);
  EXPECT_EQ(offered(ForestAnimatorConfig::__getDefault__()), declared.defaults);
}

TEST(ForestRanges, SettingsSurviveTheirEvent) {  // N6
  ForestTuning tuning;
  tuning.settings = {2.5, 4, 5, 0.1, 2.0, {4.0, 1000, 3, 10.0, 11.0, 1000.0}};
  tuning.design = {0.5, 1.5, 0.0, 1.25, 2.0};
  tuning.transition = 7.0;
  const auto event = settingsEvent<ForestInput>(tuning);
  ForestTuning back = tuningOf(event);
  Declared sent, received;
  describe(sent, tuning);
  describe(received, back);
  EXPECT_EQ(sent.defaults, received.defaults);
  EXPECT_EQ(event.names.size(), sent.defaults.size());
}

TEST(ForestRanges, EventsOfBadSettingsAreRefused) {
  const auto event = settingsEvent<ForestInput>(ForestTuning());
  const auto refused = [](const ForestInput& bad) {
    try {
      tuningOf(bad);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  ForestInput unknown = event, range = event, count = event;
  unknown.names[0] = "colour";
  EXPECT_EQ(refused(unknown), "event: colour is not known");
  const auto name = std::find(range.names.begin(), range.names.end(), "transition");
  ASSERT_NE(name, range.names.end());
  range.values[static_cast<std::size_t>(name - range.names.begin())] = 1e9;
  EXPECT_NE(refused(range).find("transition = 1e+09 s is outside 0.01 to 60 s"), std::string::npos)
      << refused(range);
  count.values.pop_back();
  const std::size_t names = event.names.size();
  EXPECT_EQ(refused(count), "event: " + std::to_string(names) + " names for " +
                                std::to_string(names - 1) + " values");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
