// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/receiver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

constexpr int N = 20000;
constexpr double ENDLESS = std::numeric_limits<double>::infinity();

SensorModel exact() {
  SensorModel out;
  out.noise = 0.0;
  return out;
}

Echo echoAt(double distance, double signal, Label label = Label::TRUNK) {
  return {distance, signal, {distance, label, 1, 0, 1.0}};
}

/// The returns of one ray.
std::vector<Return> returnsOf(const Receiver& receiver, std::vector<Echo> echoes,
                              std::uint64_t ray = 0) {
  const RayRandom random({5, 77}, ray);
  std::vector<Return> detected, out(static_cast<std::size_t>(receiver.returns()));
  receiver.receive(echoes, &random, detected, out.data());
  return out;
}

/// Share of N rays that have a point, with mean and standard deviation of its range.
struct Statistics {
  double share{0.0}, mean{0.0}, deviation{0.0}, intensity{0.0};
};

Statistics measure(const SensorModel& model, const std::vector<Echo>& echoes,
                   double range_max = 1000.0) {
  const Receiver receiver(model, 0.3, range_max);
  double count = 0.0, sum = 0.0, squares = 0.0, intensity = 0.0;
  for (std::uint64_t ray = 0; ray < N; ++ray) {
    const Return one = returnsOf(receiver, echoes, ray)[0];
    if (!one.isPoint()) continue;
    count += 1.0;
    sum += one.range;
    squares += one.range * one.range;
    intensity += one.intensity;
  }
  const double mean = sum / count;
  return {count / N, mean, std::sqrt(squares / count - mean * mean), intensity / count};
}

double shareError(double share) {
  return 4.0 * std::sqrt(share * (1.0 - share) / N);
}

TEST(Receiver, WithoutModelsAnEchoIsItsReturnWithoutRandomNumbers) {
  const Receiver receiver(exact(), 0.3, 60.0);
  EXPECT_FALSE(receiver.isRandom());
  std::vector<Echo> echoes{echoAt(7.3, 0.35)};
  std::vector<Return> detected;
  Return out;
  receiver.receive(echoes, nullptr, detected, &out);
  EXPECT_EQ(out.range, 7.3);
  EXPECT_EQ(out.intensity, 0.35);
  EXPECT_EQ(out.type, ReturnType::SINGLE_STRONGEST);
}

// Bounds: four standard errors of mean and standard deviation.
TEST(Receiver, NoiseGrowsInProportionToTheRange) {
  SensorModel model = exact();
  model.noise = 0.02;
  model.noise_proportional = 0.001;
  for (const double range : {10.0, 80.0}) {
    const double deviation = 0.02 + 0.001 * range;
    const Statistics got = measure(model, {echoAt(range, 0.3)});
    EXPECT_EQ(got.share, 1.0);
    EXPECT_NEAR(got.mean, range, 4.0 * deviation / std::sqrt(N));
    EXPECT_NEAR(got.deviation, deviation, 4.0 * deviation / std::sqrt(2.0 * N));
  }
}

// s is the light over that of a target of reflectance 0.1 at the detection range.
TEST(Receiver, NoiseOfWeakEchoesFallsWithTheRootOfTheLight) {
  SensorModel model = exact();
  model.noise = 0.01;
  model.noise_weak = 0.1;
  model.detection.detection_range = 40.0;
  for (const auto& [range, signal, deviation] : {std::array<double, 3>{20.0, 0.1, 0.05},
                                                 {20.0, 0.4, 0.025},
                                                 {40.0, 0.4, 0.05},
                                                 {10.0, 0.8, 0.01}}) {
    const Statistics got = measure(model, {echoAt(range, signal)});
    EXPECT_NEAR(got.deviation, deviation, 4.0 * deviation / std::sqrt(2.0 * N)) << range;
  }
  const Statistics fog = [&] {
    SensorModel foggy = model;
    foggy.weather.fog_visibility = 100.0;
    return measure(foggy, {echoAt(20.0, 0.4)});
  }();
  EXPECT_NEAR(fog.deviation, 0.025 * std::exp(3.912 / 100.0 * 20.0), 0.003);
}

TEST(Receiver, DropoutLosesItsShare) {
  SensorModel model = exact();
  model.detection.dropout = 0.15;
  EXPECT_NEAR(measure(model, {echoAt(10.0, 0.3)}).share, 0.85, shareError(0.85));
}

TEST(Receiver, DetectionFollowsItsProbability) {
  SensorModel model = exact();
  model.detection.detection_range = 40.0;
  for (const double range : {30.0, 60.0, 90.0}) {
    const double share = detectionProbability(model.detection, 0.3, 1.0, range);
    EXPECT_NEAR(measure(model, {echoAt(range, 0.3)}).share, share, shareError(share));
  }
}

// Koschmieder's extinction on both ways: echoes and light decrease by exp(-2 3.912
// range/visibility).
TEST(Receiver, FogLosesEchoesAndLight) {
  SensorModel model = exact();
  model.weather.fog_visibility = 100.0;
  const double share = std::exp(-2.0 * 3.912 / 100.0 * 12.0);
  const Statistics got = measure(model, {echoAt(12.0, 0.4)});
  EXPECT_NEAR(got.share, share, shareError(share));
  EXPECT_NEAR(got.intensity, 0.4 * share, 1e-12);
}

// Towards the sky only drops return: of all rays, drops * exp(-drops r) dr meet the first one at r,
// and exp(-2 extinction r) of these are detected.
TEST(Receiver, RainGivesFalseReturns) {
  SensorModel model = exact();
  model.weather.rain_rate = 80.0;
  model.weather.rain_returns = 3.0;
  const Air air(model.weather);
  const double rate = air.drops() + 2.0 * air.extinction();
  const double share =
      air.drops() / rate * std::exp(-2.0 * air.extinction() * 0.3) * (1.0 - std::exp(-rate * 59.7));
  const Statistics got = measure(model, {}, 60.0);
  EXPECT_GT(share, 0.1);
  EXPECT_NEAR(got.share, share, shareError(share));
  const Receiver receiver(model, 0.3, 60.0);
  for (std::uint64_t ray = 0; ray < 200; ++ray) {
    const Return one = returnsOf(receiver, {}, ray)[0];
    if (one.isPoint()) {
      EXPECT_EQ(one.hit.label, Label::RAIN);
    }
  }
}

// A drop of reflectance 0.02 is stronger than a target of 0.32 at four times its distance.
TEST(Receiver, ADropHidesATargetOnlyIfItsEchoIsStronger) {
  SensorModel model = exact();
  model.weather.rain_rate = 80.0;
  model.weather.rain_returns = 10.0;
  const Receiver strongest(model, 0.3, 60.0);
  model.returns = ReturnMode::LAST;
  const Receiver last(model, 0.3, 60.0);
  int drops = 0;
  for (std::uint64_t ray = 0; ray < 2000; ++ray) {
    const Return one = returnsOf(strongest, {echoAt(40.0, 0.32)}, ray)[0];
    if (one.hit.label == Label::RAIN && one.isPoint()) {
      ++drops;
      const Return other = returnsOf(last, {echoAt(40.0, 0.32)}, ray)[0];
      if (other.hit.label == Label::TRUNK) {
        EXPECT_LT(one.range, 10.0 * std::exp(0.5 * 2.0 * Air(model.weather).extinction() * 40.0));
      }
    }
  }
  EXPECT_GT(drops, 100);
}

TEST(Receiver, ChoosesTheStrongestTheLastOrBoth) {
  SensorModel model = exact();
  const std::vector<Echo> weak_last{echoAt(5.0, 0.3), echoAt(8.0, 0.1), echoAt(20.0, 0.2)};
  const std::vector<Echo> strong_last{echoAt(5.0, 0.01), echoAt(8.0, 0.03), echoAt(10.0, 0.3)};
  const auto choose = [&](ReturnMode mode, const std::vector<Echo>& echoes) {
    model.returns = mode;
    return returnsOf(Receiver(model, 0.3, 60.0), echoes);
  };
  EXPECT_EQ(choose(ReturnMode::STRONGEST, weak_last)[0].range, 5.0);
  EXPECT_EQ(choose(ReturnMode::LAST, weak_last)[0].range, 20.0);
  EXPECT_EQ(choose(ReturnMode::LAST, weak_last)[0].type, ReturnType::SINGLE_LAST);
  const auto first = choose(ReturnMode::BOTH, weak_last);
  EXPECT_EQ(first[0].range, 5.0);
  EXPECT_EQ(first[0].type, ReturnType::DUAL_STRONGEST_FIRST);
  EXPECT_EQ(first[1].range, 20.0);
  EXPECT_EQ(first[1].type, ReturnType::DUAL_WEAK_LAST);
  const auto second = choose(ReturnMode::BOTH, strong_last);
  EXPECT_EQ(second[0].range, 10.0);
  EXPECT_EQ(second[0].type, ReturnType::DUAL_STRONGEST_LAST);
  EXPECT_EQ(second[1].range, 8.0);
  EXPECT_EQ(second[1].type, ReturnType::DUAL_WEAK_FIRST);
  const auto only = choose(ReturnMode::BOTH, {echoAt(5.0, 0.3)});
  EXPECT_EQ(only[0].type, ReturnType::DUAL_ONLY);
  EXPECT_FALSE(only[1].isPoint());
}

// REP 117
TEST(Receiver, TooNearIsMinusInfinityAndNothingIsInfinity) {
  const Receiver receiver(exact(), 1.0, 60.0);
  EXPECT_EQ(returnsOf(receiver, {echoAt(0.5, 0.3)})[0].range, -ENDLESS);
  EXPECT_EQ(returnsOf(receiver, {})[0].range, ENDLESS);
  EXPECT_EQ(returnsOf(receiver, {echoAt(0.5, 0.3), echoAt(4.0, 0.01)})[0].range, 4.0);
}

}  // namespace
}  // namespace vegetation_sim::scan
