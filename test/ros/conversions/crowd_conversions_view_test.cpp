// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/error_text.h"
#include "crowd/body/limb_error.h"
#include "ros/conversions/crowd_conversions.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim {
namespace {

/// Walkers on a slope far from the world's origin, after some seconds among each other.
struct Strollers {
  static terrain::HeightMap slope() {
    terrain::HeightMapLaw law;
    law.resolution = 50.0;
    law.origin = Vec3(4950.0, -7050.0, 100.0);
    law.height_max = 30.0;
    terrain::GreyImage image;
    image.columns = image.rows = 3;
    image.samples = {0, 0, 0, 100, 120, 90, 255, 240, 255};
    return terrain::HeightMap(law, image);
  }
  Strollers() {
    for (int i = 0; i < 60; ++i) {
      crowd::Spawn spawn;
      spawn.position = {5000.0 + 1.3 * (i % 8), -7000.0 + 1.3 * (i / 8)};
      spawn.height = 1.5 + 0.007 * i;
      crowd.spawn(spawn);
    }
    crowd.remove(7);
    crowd.remove(31);
  }
  void step() { crowd.advance(now += NANOSECONDS_PER_SECOND / 30); }
  std::vector<WalkerView> view() const { return fromMsg(toView(crowd.walkers(), crowd.terrain())); }

  Nanoseconds now{NANOSECONDS_PER_SECOND};
  crowd::Crowd crowd{3, crowd::CrowdSettings(), crowd::Area{4990.0, 5020.0, -7010.0, -6990.0},
                     std::make_shared<const terrain::HeightMap>(slope())};
};

// Half a step of each number, and a small part of it for the rounding of doubles.
constexpr double HALF = 0.5 * (1.0 + 1e-6);

void expectNear(const crowd::Point& a, const crowd::Point& b, double error) {
  EXPECT_NEAR(a.x, b.x, error);
  EXPECT_NEAR(a.y, b.y, error);
}

double turnBetween(double a, double b) {
  return std::remainder(a - b, 2.0 * PI);
}

TEST(CrowdConversionsView, AViewDiffersFromTheWalkersByHalfAStep) {
  Strollers s;
  int swinging = 0, turning = 0;
  for (int tick = 0; tick < 120; ++tick) {
    s.step();
    const std::vector<WalkerView> view = s.view();
    ASSERT_EQ(view.size(), 58u);
    for (std::size_t i = 0; i < view.size(); ++i) {
      const crowd::Walker &w = s.crowd.walkers()[i], &seen = view[i].walker;
      EXPECT_EQ(seen.id, w.id);
      expectNear(seen.position, w.position, HALF * 1e-3);
      expectNear(seen.velocity, w.velocity, HALF * 1e-3);
      EXPECT_NEAR(turnBetween(seen.heading, w.heading), 0.0, HALF * 2.0 * PI / 65536);
      EXPECT_NEAR(std::remainder(seen.gait - w.gait, 1.0), 0.0, HALF / 65536);
      EXPECT_NEAR(seen.turn_rate, std::clamp(w.turn_rate, -127.0 / 80.0, 127.0 / 80.0),
                  HALF / 80.0);
      turning += std::fabs(seen.turn_rate) > 0.1;
      EXPECT_NEAR(seen.height, w.height, HALF * 1e-4);
      EXPECT_NEAR(view[i].ground, s.crowd.terrain().height(w.position.x, w.position.y),
                  HALF * 1e-3);
      for (std::size_t k = 0; k < 2; ++k) {
        ASSERT_EQ(seen.feet[k].stands, w.feet[k].stands);
        if (w.feet[k].stands) expectNear(seen.feet[k].planted, w.feet[k].planted, HALF * 1e-3);
        if (!w.feet[k].stands) expectNear(seen.feet[k].offset, w.feet[k].offset, HALF * 1e-3);
        swinging += !w.feet[k].stands;
      }
    }
  }
  EXPECT_GT(swinging, 1000);
  EXPECT_GT(turning, 1000);
}

// The ends of limbs follow from all numbers together.
TEST(CrowdConversionsView, BodiesOfAViewAreThoseOfTheWalkersWithinACentimetre) {
  Strollers s;
  double worst = 0.0, sum = 0.0;
  int ends = 0;
  for (int tick = 0; tick < 120; ++tick) {
    s.step();
    const std::vector<WalkerView> view = s.view();
    for (std::size_t i = 0; i < view.size(); ++i) {
      const crowd::Skeleton a = skeletonOf(s.crowd.walkers()[i], s.crowd.terrain());
      const crowd::Skeleton b = skeletonOf(view[i].walker, s.crowd.terrain());
      for (std::size_t k = 0; k < crowd::PARTS; ++k)
        for (const double error : {length(a[k].from - b[k].from), length(a[k].to - b[k].to)}) {
          worst = std::max(worst, error);
          sum += error;
          ++ends;
        }
    }
  }
  RecordProperty("worst_um", static_cast<int>(1e6 * worst));
  RecordProperty("mean_um", static_cast<int>(1e6 * sum / ends));
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(sum / ends, 0.001);
}

/// Returns a body as displays draw it: all of it as high above the ground as the message says.
crowd::Skeleton drawnBody(const crowd::Walker& walker, double ground, const Strollers& s) {
  const terrain::HeightMap& terrain = s.crowd.terrain();
  crowd::Skeleton out = skeletonOf(walker, terrain, crowd::ownStyles(), secondsBetween(0, s.now));
  const double rise = ground - terrain.height(walker.position.x, walker.position.y);
  for (crowd::Limb& limb : out) {
    limb.from.z() += rise;
    limb.to.z() += rise;
  }
  return out;
}

double largestDifference(const crowd::Skeleton& a, const crowd::Skeleton& b) {
  double out = 0.0;
  for (std::size_t k = 0; k < crowd::PARTS; ++k)
    out = std::max({out, length(a[k].from - b[k].from), length(a[k].to - b[k].to)});
  return out;
}

// N9: on a slope the prediction is an upper estimate of each body's error, and no more than some
// times larger: errors of a dozen numbers seldom all add up.
TEST(CrowdConversionsView, ErrorsOfBodiesArePredicted) {
  Strollers s;
  double measured = 0.0, predicted = 0.0;
  for (int tick = 0; tick < 120; ++tick) {
    s.step();
    if (tick % 4 > 0) continue;
    const std::vector<crowd::Walker>& walkers = s.crowd.walkers();
    const std::vector<WalkerView> view = s.view();
    const crowd::WalkerRounding rounding = viewRounding(walkers, s.crowd.terrain());
    for (std::size_t i = 0; i < view.size(); ++i) {
      const crowd::Walker& w = walkers[i];
      const double ground = s.crowd.terrain().height(w.position.x, w.position.y);
      const double error =
          largestDifference(drawnBody(w, ground, s), drawnBody(view[i].walker, view[i].ground, s));
      const double bound =
          limbErrorOf(w, s.crowd.terrain(), crowd::ownStyles(), secondsBetween(0, s.now), rounding);
      EXPECT_LE(error, bound) << "walker " << w.id << ", tick " << tick;
      measured += error;
      predicted += bound;
    }
  }
  std::printf("mean predicted error over mean measured error of bodies: %.2f\n",
              predicted / measured);
  EXPECT_GT(predicted, 1.2 * measured);
  EXPECT_LT(predicted, 6.0 * measured);
}

// A leg that is nearly straight moves its knee farther than the rounding moves foot and hip.
TEST(CrowdConversionsView, PredictedErrorsHaveTheLeverageOfLegs) {
  Strollers s;
  for (int tick = 0; tick < 30; ++tick) s.step();
  const auto largest = [&](const crowd::WalkerRounding& rounding) {
    double out = 0.0;
    for (const crowd::Walker& w : s.crowd.walkers())
      out = std::max(out, limbErrorOf(w, s.crowd.terrain(), crowd::ownStyles(), 1.0, rounding));
    return out;
  };
  crowd::WalkerRounding places;
  EXPECT_EQ(largest(places), 0.0);
  places.place = 0.5e-3;
  EXPECT_GT(largest(places), 1.5 * std::sqrt(3.0) * places.place);
  EXPECT_GT(largest(viewRounding(s.crowd.walkers(), s.crowd.terrain())), largest(places));
}

// Rounding must not make a standing foot slide while the walker moves on.
TEST(CrowdConversionsView, AStandingFootOfAViewStaysWhereItIs) {
  Strollers s;
  s.step();
  std::vector<WalkerView> last = s.view();
  int stood = 0;
  for (int tick = 0; tick < 60; ++tick) {
    const std::vector<crowd::Walker> before = s.crowd.walkers();
    s.step();
    const std::vector<WalkerView> view = s.view();
    for (std::size_t i = 0; i < view.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const crowd::Foot &was = before[i].feet[k], &is = s.crowd.walkers()[i].feet[k];
        if (!was.stands || !is.stands || length(was.planted - is.planted) > 0.0) continue;
        expectNear(view[i].walker.feet[k].planted, last[i].walker.feet[k].planted, 1e-9);
        ++stood;
      }
    last = view;
  }
  EXPECT_GT(stood, 1000);
}

TEST(CrowdConversionsView, AViewHas30BytesAWalker) {
  const auto bytesOf = [](std::uint32_t walkers) {
    std::vector<crowd::Walker> all(walkers);
    for (std::uint32_t i = 0; i < walkers; ++i) all[i].id = i;
    return ros::serialization::serializationLength(toView(all, terrain::HeightMap()));
  };
  EXPECT_EQ(bytesOf(1001) - bytesOf(1), 30u * 1000u);
}

TEST(CrowdConversionsView, RejectInvalidViews) {
  constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
  using Spoil = std::function<void(CrowdView&)>;
  const std::vector<std::pair<std::string, Spoil>> faults = {
      {"y has 1 numbers, 2 walkers have 2", [](CrowdView& v) { v.y.pop_back(); }},
      {"ground has 3 numbers", [](CrowdView& v) { v.ground.push_back(0); }},
      {"heading has 0 numbers", [](CrowdView& v) { v.heading.clear(); }},
      {"gait has 1 numbers", [](CrowdView& v) { v.gait.pop_back(); }},
      {"turn_rate has 1 numbers", [](CrowdView& v) { v.turn_rate.pop_back(); }},
      {"height has 1 numbers", [](CrowdView& v) { v.height.pop_back(); }},
      {"velocity_x has 1 numbers", [](CrowdView& v) { v.velocity_x.pop_back(); }},
      {"velocity_y has 1 numbers", [](CrowdView& v) { v.velocity_y.pop_back(); }},
      {"feet_x has 2 numbers, 2 walkers have 4", [](CrowdView& v) { v.feet_x.resize(2); }},
      {"feet_y has 5 numbers", [](CrowdView& v) { v.feet_y.push_back(0); }},
      {"feet_stand has 1 numbers", [](CrowdView& v) { v.feet_stand.pop_back(); }},
      {"id_count has 2 numbers, first_id has 3", [](CrowdView& v) { v.first_id.push_back(9); }},
      {"id_count, its sum, = 3", [](CrowdView& v) { v.id_count[1] = 2; }},
      {"first_id[1] = 3 is below 4", [](CrowdView& v) { v.first_id[1] = 3; }},
      {"id_count = 0 is outside 1 to", [](CrowdView& v) { v.id_count[0] = 0; }},
      {"id_count = 2 is outside 1 to 1",
       [](CrowdView& v) { v.first_id[1] = 4294967295U, v.id_count[1] = 2; }},
      {"walkers = 100001 is outside 0 to 100000", [](CrowdView& v) { v.x.resize(100001); }},
      {"origin_x = nan", [](CrowdView& v) { v.origin_x = NONE; }},
      {"origin_y", [](CrowdView& v) { v.origin_y = 1e8; }},
      {"ground_low", [](CrowdView& v) { v.ground_low = NONE; }},
      {"ground_step = 0 m is outside", [](CrowdView& v) { v.ground_step = 0.0; }},
      {"height[1] = 0 m is outside 0.1 to 5 m", [](CrowdView& v) { v.height[1] = 0; }},
      {"feet_stand[0] = 4 is outside 0 to 3", [](CrowdView& v) { v.feet_stand[0] = 4; }}};
  std::vector<crowd::Walker> walkers(2);
  walkers[0].id = 3;
  walkers[1].id = 7;
  const CrowdView good = toView(walkers, terrain::HeightMap());
  EXPECT_EQ(fromMsg(good).size(), 2u);
  for (const auto& [text, spoil] : faults) {
    CrowdView bad = good;
    spoil(bad);
    const std::string refusal = errorOf([&] { fromMsg(bad); });
    EXPECT_NE(refusal.find(text), std::string::npos) << text << ": " << refusal;
  }
}

}  // namespace
}  // namespace vegetation_sim
