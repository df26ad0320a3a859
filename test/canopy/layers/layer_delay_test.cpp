// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/layer_delay.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/canopy/delay_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::canopy {
namespace {

TEST(Half, IsNearestAndSurvivesTheRoundTrip) {
  for (int bits = 0; bits < 0x7c00; ++bits)
    ASSERT_EQ(toHalf(fromHalf(static_cast<std::uint16_t>(bits))), bits);
  EXPECT_EQ(fromHalf(toHalf(1.0)), 1.0);
  EXPECT_EQ(fromHalf(toHalf(-2.5)), -2.5);
  EXPECT_EQ(fromHalf(toHalf(1e9)), 65504.0);
  EXPECT_EQ(fromHalf(toHalf(0.0)), 0.0);
  const Random random(1);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    const double x = random.uniform(i, -20.0, 20.0);
    EXPECT_LE(std::fabs(fromHalf(toHalf(x)) - x), std::fabs(x) / 2048.0 + 1e-7);
  }
}

// S3-19, E9: the vectors of the errata; bounded, and its sign is that of the wind.
TEST(LayerDelay, IsBoundedAndHasTheSignOfTheWind) {
  EXPECT_NEAR(layerDelay(1.0, -1.0, 0.2, false), 0.8333, 1e-4);
  EXPECT_NEAR(layerDelay(1.0, 0.1, 0.2, false), -3.3333, 1e-4);
  EXPECT_NEAR(layerDelay(1.0, 0.2, 0.2, false), -2.5, 1e-12);
  EXPECT_NEAR(layerDelay(1.0, 1.0, 0.2, false), -0.8333, 1e-4);
  EXPECT_NEAR(layerDelay(1.0, 0.0, 0.2, false), 5.0, 1e-12);
  for (double vz = -2.0; vz < 2.0; vz += 0.001)
    ASSERT_LE(std::fabs(layerDelay(1.0, vz, 0.2, false)), 5.0 + 1e-12);
  EXPECT_NEAR(layerDelay(1.0, 0.199, 0.2, true), 1000.0, 1e-6);
  EXPECT_NEAR(layerDelay(1.0, 0.201, 0.2, true), -1000.0, 1e-6);
  EXPECT_EQ(layerDelay(1.0, 0.2, 0.2, true), 0.0);  // the pole is no number; contained
}

// S3-21: each layer has its own, which does not flicker.
TEST(LayerDelay, HasASpeedOfItsOwnInEachLayer) {
  const LayerSettings settings;
  EXPECT_NE(delaySpeedOf(settings, 7, 1), delaySpeedOf(settings, 7, 2));
  EXPECT_EQ(delaySpeedOf(settings, 7, 1), delaySpeedOf(settings, 7, 1));
  for (int layer = 0; layer < MOST_LAYERS; ++layer)
    EXPECT_NEAR(delaySpeedOf(settings, 9, layer), 2.0, 0.4);
}

// S3-18, S3-20: an impulse of the first layer comes to the others after their delay, and half a
// tick is half way.
TEST(LayerMotion, IsThatOfTheFirstLayerSomeTimeAgo) {
  LayerSettings settings;
  History history(16, 31);
  PlaneField impulse(16);
  std::fill(impulse.u.begin(), impulse.u.end(), 4.0);
  history.push(toFrame(impulse, 0.0));
  LayerMotion layer;
  for (int age = 0; age < 20; ++age) {
    layerMotion(viewOf(settings, history), 1.0, 1.0, 3.0, layer);  // a third of a second
    EXPECT_NEAR(layer.plane.u[5], age == 10 ? 4.0 : 0.0, 1e-9) << age;
    layerMotion(viewOf(settings, history), 0.05, 1.0, 3.0, layer);  // half a tick
    EXPECT_NEAR(layer.plane.u[5], age < 2 ? 2.0 : 0.0, 1e-9) << age;
    layerMotion(viewOf(settings, history), 0.0, 1.0, 3.0, layer);
    EXPECT_NEAR(layer.plane.u[5], age == 0 ? 4.0 : 0.0, 1e-9) << age;
    history.push(toFrame(PlaneField(16), 0.0));
  }
  layerMotion(viewOf(settings, history), 1e6, 1e6, 3.0, layer);  // beyond the memory: the oldest
  EXPECT_EQ(layer.plane.u[5], 0.0);
}

// The fast way, many cells at once in single precision, finds what equation 3 says cell by cell, at
// any view and while one driver fades into the other.
TEST(LayerMotion, IsThatOfTheEquationCellByCell) {
  const LayerSettings settings;
  History history(32, 31);
  for (std::uint64_t i = 0; i < 40; ++i) history.push(toFrame(noiseField(32, i), 0.1 * i - 1.0));
  LayerView view = viewOf(settings, history);
  view.towards = Vec3(0.6, -0.64, 0.48);
  view.front_share = 0.3;
  LayerMotion layer;
  layerMotion(view, 0.7, 1.6, 2.0, layer);
  const double share = smoothStep(0.3);
  for (std::size_t cell = 0; cell < layer.depth.size(); ++cell) {
    const PlaneMotion now = history.at(cell, 0.0);
    const double vz = dot(view.towards, Vec3(now.u, now.v, now.depth));
    const auto ago = [&](double distance) {
      return history.at(cell, std::fabs(layerDelay(distance, vz, 2.0, false)) / view.tick);
    };
    const PlaneMotion front = ago(0.7), back = ago(0.9);
    // Single precision: 6e-8 of up to 30 ticks, each of up to 2 m/s.
    EXPECT_NEAR(layer.plane.u[cell], share * front.u + (1.0 - share) * back.u, 2e-5);
    EXPECT_NEAR(layer.plane.v[cell], share * front.v + (1.0 - share) * back.v, 2e-5);
    EXPECT_NEAR(layer.depth[cell], share * front.depth + (1.0 - share) * back.depth, 2e-5);
  }
}

// S3-23: with the wind from behind the last layer moves first.
TEST(LayerMotion, IsDrivenByTheLayerThatTheWindMeetsFirst) {
  const LayerSettings settings;
  History history(16, 31);
  PlaneField impulse(16);
  std::fill(impulse.u.begin(), impulse.u.end(), 4.0);
  history.push(toFrame(impulse, 0.0));
  LayerView view = viewOf(settings, history);
  view.front_share = 0.0;
  LayerMotion front, back;
  layerMotion(view, 0.0, 1.0, 3.0, front);
  layerMotion(view, 1.0, 1.0, 3.0, back);
  EXPECT_NEAR(back.plane.u[0], 4.0, 1e-9);
  EXPECT_NEAR(front.plane.u[0], 0.0, 1e-9);
}

// E9: no jump where the wind in depth changes sign, whereas the printed delay leaps.
TEST(LayerMotion, IsContinuousWhereTheWindInDepthTurns) {
  LayerSettings settings;
  settings.hysteresis = 0.1;
  History history(16, 31);
  Driver driver;
  LayerMotion layer;
  double last = 0.0, largest = 0.0;
  bool turned = false;
  for (int tick = 0; tick < 240; ++tick) {
    PlaneField motion(16);
    std::fill(motion.u.begin(), motion.u.end(), 2.0 * sinCosTurns(tick / 120.0).sin);
    const double vz = -1.0 + tick / 120.0;
    history.push(toFrame(motion, vz));
    driver.advance(1.0 / 30.0, vz, settings);
    turned = turned || driver.share() == 0.0;
    LayerView view = viewOf(settings, history);
    view.front_share = driver.share();
    layerMotion(view, 0.5, 1.5, 2.0, layer);
    if (tick > 40) largest = std::max(largest, std::fabs(layer.plane.u[3] - last));
    last = layer.plane.u[3];
  }
  EXPECT_TRUE(turned);
  // The first layer itself moves 0.105 a tick; the fade adds at most the delays' difference
  // over its 30 ticks.
  EXPECT_LT(largest, 0.25);
}

TEST(Driver, DoesNotFlickerInACalm) {
  const LayerSettings settings;
  Driver driver;
  for (int i = 0; i < 100; ++i) driver.advance(1.0 / 30.0, i % 2 ? 0.15 : -0.15, settings);
  EXPECT_EQ(driver.share(), 1.0);
  for (int i = 0; i < 100; ++i) driver.advance(1.0 / 30.0, 0.5, settings);
  EXPECT_EQ(driver.share(), 0.0);
  for (int i = 0; i < 100; ++i) driver.advance(1.0 / 30.0, 0.0, settings);
  EXPECT_EQ(driver.share(), 0.0);
}

/// Frames of a wave that travels to the right by a cell a tick.
History travellingWave(double mean, double swing) {
  History history(64, 31);
  for (int tick = 0; tick < 60; ++tick) {
    PlaneField wave(64);
    for (std::size_t i = 0; i < wave.u.size(); ++i)
      wave.u[i] = mean + swing * sinCosTurns((static_cast<double>(i % 64) - tick) / 32.0).sin;
    history.push(toFrame(wave, 0.0));
  }
  return history;
}

double differenceOfModels(const History& history, int direction) {
  LayerSettings settings;
  settings.direction = static_cast<LookupDirection>(direction);
  LayerView view = viewOf(settings, history);
  settings.wave_speed = view.cell / view.tick;
  LayerMotion exact, looked;
  const double delay = 6.0 * view.tick;
  layerMotion(view, 2.0 * delay, 1.0, 2.0, exact);
  settings.model = LayerModel::LOOKUP;
  layerMotion(view, 2.0 * delay, 1.0, 2.0, looked);
  return relativeError(looked.plane, exact.plane);
}

// S3-22, E9b: for a plane wave at speed s the one look-up is the true delay; the printed direction
// only where the motion happens to be 1 m/s.
TEST(LayerMotion, OfOneLookupIsExactForAPlaneWave) {
  EXPECT_LT(differenceOfModels(travellingWave(2.0, 0.5), 0), 1e-6);
  EXPECT_GT(differenceOfModels(travellingWave(2.0, 0.5), 1), 0.05);
  EXPECT_LT(differenceOfModels(travellingWave(1.0, 0.002), 1), 1e-3);
}

// S3-18, S3-22: the history is as good as exact in 1 MB; the look-up is hardly better than nothing.
TEST(LayerMotion, FromHistoryIsWithinHalfAPercentInGusts) {
  for (const double delay : {0.125, 0.5083333333333333}) {
    const GustErrors errors = errorsInGusts(delay);
    const std::string at = std::to_string(delay);
    RecordProperty("history_" + at, std::to_string(errors.history));
    RecordProperty("lookup_" + at, std::to_string(errors.lookup));
    RecordProperty("nothing_" + at, std::to_string(errors.nothing));
    EXPECT_LE(errors.history, 0.005) << delay;
    EXPECT_GT(errors.lookup, 10.0 * errors.history) << delay;
  }
  EXPECT_LE(History(64, 61).bytes(), 1000000U);  // two seconds at 30 Hz
}

// S3-31: similar, but not the same.
TEST(LayerMotion, CorrelatesWithTheFirstLayerWithoutBeingIt) {
  const GustErrors errors = errorsInGusts(0.125);
  EXPECT_GT(errors.nothing, 0.01);
  EXPECT_LT(errors.nothing, 0.9);
}

TEST(History, RejectsFramesOfAnotherSize) {
  History history(16, 4);
  EXPECT_THROW(history.push(toFrame(PlaneField(32), 0.0)), InvalidInput);
  EXPECT_THROW(History(16, 1), InvalidInput);
  EXPECT_THROW(History(15, 4), InvalidInput);
}

// N6: many cells at once, halfs that have no leading one and delays beyond the memory among them.
TEST(LayerMotion, HasTheSameBitsOnEveryInstructionSet) {
  const LayerSettings settings;
  History history(32, 31);
  for (std::uint64_t i = 0; i < 31; ++i) {
    PlaneField motion = noiseField(32, i);
    for (double& value : motion.u) value *= i % 3 == 0 ? 1e-6 : 3.0;
    history.push(toFrame(motion, 0.3 * static_cast<double>(i % 5) - 0.6));
  }
  std::vector<std::uint64_t> hashes;
  for (const std::string& name : instructionSets()) {
    forceInstructionSet(name);
    Hash hash;
    for (const double share : {1.0, 0.4, 0.0})
      for (const double distance : {0.0, 0.37, 1.2, 60.0}) {
        LayerView view = viewOf(settings, history);
        view.towards = Vec3(0.36, -0.48, 0.8);
        view.front_share = share;
        LayerMotion layer;
        layerMotion(view, distance, 60.0, 1.9, layer);
        for (const std::vector<double>* values : {&layer.plane.u, &layer.plane.v, &layer.depth})
          for (const double value : *values) hash.add(value);
      }
    hashes.push_back(hash.value());
  }
  forceInstructionSet("");
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

}  // namespace
}  // namespace vegetation_sim::canopy
