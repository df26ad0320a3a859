// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/wind/wind_settings.h"

#include <gtest/gtest.h>

#include <map>

namespace vegetation_sim {
namespace {

/// Collects ranges by the names of the fields.
class Ranges : public FieldVisitor {
 public:
  void number(const char* name, double&, const char*, Range range) override {
    found.emplace(name, range);
  }
  void integer(const char*, int&, const char*, Range) override {}
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char*, int&, const std::vector<std::string>&) override {}

  std::map<std::string, Range> found;
};

TEST(BreezeSettings, HaveTheRangesAndDefaultsOfDynamicReconfigure) {
  Ranges ranges;
  BreezeSettings breeze;
  describe(ranges, breeze);
  const BreezeSettings least = fromConfig(WindBroadcasterConfig::__getMin__()),
                       most = fromConfig(WindBroadcasterConfig::__getMax__());
  EXPECT_EQ(fromConfig(WindBroadcasterConfig::__getDefault__()), breeze);
  ASSERT_EQ(ranges.found.size(), WindBroadcasterConfig::__getParamDescriptions__().size());
  const std::map<std::string, Range> shown = {
      {"breeze_speed", {least.speed, most.speed}},
      {"breeze_direction", {least.direction, most.direction}},
      {"breeze_turbulence", {least.turbulence, most.turbulence}}};
  for (const auto& [name, range] : shown) {
    EXPECT_EQ(ranges.found.at(name).low, range.low) << name;
    EXPECT_EQ(ranges.found.at(name).high, range.high) << name;
  }
}

TEST(BreezeSettings, ReturnFromThePrimitiveTheyWereAppliedTo) {
  for (const BreezeSettings& wanted :
       {BreezeSettings{5.0, 0.3, 0.2}, BreezeSettings{200.0, -3.1, 1.0}}) {
    wind::Primitive base;
    base.velocity.z() = 0.5;
    const BreezeSettings found = BreezeSettings::of(wanted.applyTo(base), 0.0);
    EXPECT_NEAR(found.speed, wanted.speed, 1e-12 * wanted.speed);
    EXPECT_NEAR(found.direction, wanted.direction, 1e-14);
    EXPECT_EQ(found.turbulence, wanted.turbulence);
    EXPECT_EQ(wanted.applyTo(base).velocity.z(), 0.5);
  }
}

TEST(BreezeSettings, KeepTheDirectionOfACalm) {
  wind::Primitive calm;
  calm.velocity = Vec3::Zero();
  EXPECT_EQ(BreezeSettings::of(calm, 1.2).direction, 1.2);
}

TEST(FreshSchedule, StartsAllStampsAtTheStart) {
  WindSettings settings;
  settings.seed = 9;
  wind::Source late, tied;
  late.primitive.name = "late";
  late.primitive.t_on = fromSeconds(5.0);
  tied.primitive.name = "tied";
  tied.attached_frame = "drone";
  settings.sources = {late, tied};
  const wind::Field field = initialSchedule(settings, fromSeconds(100.0)).field();
  ASSERT_EQ(field.primitives().size(), 1u);  // The attached primitive waits for tf.
  EXPECT_EQ(field.primitives()[0].t_on, fromSeconds(105.0));
  EXPECT_EQ(field.seed(), 9u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
