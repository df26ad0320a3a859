// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/receiver.h"

#include <algorithm>

namespace vegetation_sim::scan {
namespace {

constexpr double ENDLESS = std::numeric_limits<double>::infinity();

double powerOf(const Return& one) {
  return one.intensity / (one.hit.distance * one.hit.distance);
}

// Returns the strongest of the first `count` returns, of equal ones the nearest.
std::size_t strongestOf(const std::vector<Return>& all, std::size_t count) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < count; ++i)
    if (powerOf(all[i]) > powerOf(all[best])) best = i;
  return best;
}

}  // namespace

Receiver::Receiver(const SensorModel& model, double range_min, double range_max)
    : model_(model), air_(model.weather), range_min_(range_min), range_max_(range_max) {}

bool Receiver::isRandom() const {
  return model_.noise > 0.0 || model_.noise_proportional > 0.0 || model_.detection.dropout > 0.0 ||
         model_.detection.detection_range > 0.0 || !air_.isClear();
}

// A drop reflects a small part of the beam, so it hides nothing. Drops behind the last echo are in
// its shadow.
void Receiver::addDrop(const RayRandom& random, std::vector<Echo>& echoes) const {
  const double distance = range_min_ + air_.firstDrop(random.drop());
  if (!(distance < (echoes.empty() ? range_max_ : echoes.back().distance))) return;
  const Hit hit{distance, Label::RAIN, 0, -1, 1.0};
  const auto place = std::find_if(echoes.begin(), echoes.end(),
                                  [&](const Echo& echo) { return echo.distance > distance; });
  echoes.insert(place, {distance, signalOf(hit), hit});
}

// Returns whether an echo is too near.
bool Receiver::detect(const std::vector<Echo>& echoes, const RayRandom* random,
                      std::vector<Return>& detected) const {
  detected.clear();
  bool near = false;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const Echo& echo = echoes[i];
    const auto number = static_cast<int>(i);
    const double transmission = air_.transmission(echo.distance);
    const double chance =
        detectionProbability(model_.detection, echo.signal, transmission, echo.distance);
    if (chance < 1.0 && !(random->detection(number) < chance)) continue;
    const double deviation = deviationOf(model_, echo.signal, transmission, echo.distance);
    const double error = deviation > 0.0 ? deviation * random->unitNoise(number) : 0.0;
    const double range = echo.distance + error;
    if (echo.distance < range_min_ || range < range_min_)
      near = true;
    else if (!(range > range_max_))
      detected.push_back({range, echo.hit, echo.signal * transmission, ReturnType::NONE});
  }
  return near;
}

void Receiver::choose(const std::vector<Return>& all, Return* out) const {
  const std::size_t last = all.size() - 1, best = strongestOf(all, all.size());
  if (model_.returns == ReturnMode::STRONGEST) {
    out[0] = all[best];
    out[0].type = ReturnType::SINGLE_STRONGEST;
  } else if (model_.returns == ReturnMode::LAST) {
    out[0] = all[last];
    out[0].type = ReturnType::SINGLE_LAST;
  } else {
    out[0] = all[best];
    out[0].type = last == 0      ? ReturnType::DUAL_ONLY
                  : best == last ? ReturnType::DUAL_STRONGEST_LAST
                                 : ReturnType::DUAL_STRONGEST_FIRST;
    if (last == 0) return;
    out[1] = best == last ? all[strongestOf(all, last)] : all[last];
    out[1].type = best == last ? ReturnType::DUAL_WEAK_FIRST : ReturnType::DUAL_WEAK_LAST;
  }
}

void Receiver::receive(std::vector<Echo>& echoes, const RayRandom* random,
                       std::vector<Return>& detected, Return* out) const {
  if (air_.drops() > 0.0) addDrop(*random, echoes);
  const bool near = detect(echoes, random, detected);
  for (int i = 0; i < returns(); ++i) {
    out[i] = Return();
    out[i].range = ENDLESS;
  }
  if (!detected.empty()) return choose(detected, out);
  if (near) out[0].range = -ENDLESS;
  if (!echoes.empty()) out[0].hit = echoes.front().hit;
}

}  // namespace vegetation_sim::scan
