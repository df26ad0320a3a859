// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/decision.h"

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double LARGEST_PRINTED = 10.0;  ///< limit, times the noise at the sensor's range
constexpr double HORIZON = 1.5;           ///< distance of the wanted place, in ranges of the sensor
constexpr double STOPPING = 0.5;          ///< time in which a walker stops before an obstacle [s]
constexpr double SIDE_KEPT = 0.35;        ///< relative squared cost of the other side
constexpr double CREEP = 0.15;            ///< share of the speed that remains in a throng
constexpr double WARNING = 2.0;  ///< time before a robot arrives from which on it is evaded [s]
constexpr double HURRY = 1.4;    ///< factor on the speed out of a robot's way
constexpr double WOBBLE_PERIOD = 2.5;                    ///< period of the smooth noise [s]
constexpr double WOBBLE_DEVIATION = 0.3;                 ///< standard deviation of gradientNoise()
constexpr std::uint64_t KEY_OF_SPEED = 0x5350454544ULL;  ///< makes its noise another one

// Angles of the fan to the left; [0] is straight ahead.
constexpr int FAN = 9;
constexpr double ANGLES[FAN] = {0.0, 0.12, 0.26, 0.42, 0.62, 0.86, 1.15, 1.5, 2.1};

struct Fan {
  SinCos turns[FAN];
  Fan() {
    for (int i = 0; i < FAN; ++i) turns[i] = sinCos(ANGLES[i]);
  }
};

const Fan& fan() {
  static const Fan FAN_OF_ALL;
  return FAN_OF_ALL;
}

double meeting(const Walker& walker, const Sight& sight, const Point& velocity) {
  const Point relative = velocity - sight.velocity;
  if (sight.obstacle) return timeToMeet(walker.position, walker.radius, relative, *sight.obstacle);
  return timeToMeet(sight.place - walker.position, walker.radius + sight.radius, relative);
}

double firstMeeting(const Walker& walker, const View& view, const Point& velocity) {
  double out = std::numeric_limits<double>::infinity();
  for (int i = 0; i < view.count; ++i) out = std::min(out, meeting(walker, view.at(i), velocity));
  return out;
}

bool isThreatened(const Walker& walker, const View& view, const Point& velocity) {
  for (int i = 0; i < view.count; ++i) {
    const Sight& sight = view.at(i);
    if (sight.kind == Seen::ROBOT && dot(sight.velocity, sight.velocity) > 0.0 &&
        meeting(walker, sight, velocity) < WARNING)
      return true;
  }
  return false;
}

// Evades a robot in the direction, of all around, that meets nothing for longest.
Command evade(const Walker& walker, const View& view, const Wish& wish) {
  constexpr int ROUND = 16;
  Command out{wish.direction, HURRY * walker.speed};
  double best = -1.0;
  for (int i = 0; i < ROUND; ++i) {
    const Point direction = turned(wish.direction, sinCosTurns(static_cast<double>(i) / ROUND));
    const double time = firstMeeting(walker, view, out.speed * direction);
    const double worth = std::min(time, 2.0 * WARNING) + 0.05 * dot(direction, wish.direction);
    if (worth <= best) continue;
    best = worth;
    out.direction = direction;
  }
  return out;
}

// Returns a smooth noise of time with this standard deviation.
double wobbleOf(double deviation, std::uint64_t key, Nanoseconds stamp) {
  const double seconds = static_cast<double>(stamp) * 1e-9;
  return deviation * gradientNoise(key, seconds / WOBBLE_PERIOD) / WOBBLE_DEVIATION;
}

}  // namespace

double noiseAt(const CrowdSettings& s, double most, double distance) {
  const double share = saturate(distance / s.sensor_range);
  if (s.noise == NoiseLaw::GROWING) return most * share;
  return most / std::max(share, 1.0 / LARGEST_PRINTED);
}

double normalNumber(std::uint64_t key, std::uint64_t index) {
  const auto words = philox(
      {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), 0x6E6F6973U, 0U},
      {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
  std::uint32_t sum = 0;
  for (const std::uint32_t word : words) sum += (word & 0xFFFFU) + (word >> 16);
  // Eight numbers of 16 bits have the mean 4 * 65535 and the variance 8 / 12.
  return (static_cast<double>(sum) * (1.0 / 65536.0) - 4.0 * 65535.0 / 65536.0) *
         1.2247448713915890;
}

Command decideByGoal(const Walker& walker, const View& view, const CrowdSettings& s,
                     const Wish& wish, Nanoseconds stamp, int& side) {
  if (isThreatened(walker, view, wish.speed * wish.direction)) return evade(walker, view, wish);
  Command out{wish.direction, wish.speed};
  if (!(wish.speed > 0.0)) return out;
  const double gap = view.count > 0 ? view.at(0).gap : s.sensor_range;
  const double wobble = wobbleOf(noiseAt(s, s.noise_heading, gap), walker.key, stamp);
  const Point ahead =
      s.noise_heading > 0.0 ? turned(wish.direction, sinCos(wobble)) : wish.direction;
  const double seen = s.sensor_range, far = HORIZON * seen, bonus = std::min(0.0, s.handedness);
  double best = std::numeric_limits<double>::infinity(), free = seen;
  int taken = 0;
  for (int i = 0; i < 2 * FAN - 1; ++i) {
    const int step = (i + 1) / 2, hand = i % 2 == 1 ? -1 : 1;  // right before left
    const SinCos& turn = fan().turns[step];
    double cost = 0.0;
    if (step > 0) {
      // Stops if even a direction without obstacles would not be better.
      const double most = std::min(seen, std::max(0.0, far * turn.cos));
      const double least = far * far + most * (most - 2.0 * far * turn.cos);
      if (least + far * far * bonus >= best) break;
      cost = hand > 0 ? s.handedness : 0.0;
      if (walker.side == -hand) cost += SIDE_KEPT;
      if (least + far * far * cost >= best) continue;
    }
    const Point direction = turned(ahead, {hand * turn.sin, turn.cos});
    const double time = firstMeeting(walker, view, wish.speed * direction);
    const double reach = std::min(seen, wish.speed * time);
    cost = far * far * (1.0 + cost) + reach * (reach - 2.0 * far * turn.cos);
    if (cost >= best) continue;
    best = cost;
    free = reach;
    taken = step > 1 ? hand : 0;
    out.direction = direction;
  }
  side = taken;
  double wanted = wish.speed;
  if (s.noise_speed > 0.0)
    wanted = noisySpeed(wanted,
                        wobbleOf(noiseAt(s, s.noise_speed, gap), walker.key ^ KEY_OF_SPEED, stamp));
  out.speed = std::min(wanted, std::max(free / STOPPING, CREEP * wanted));
  return out;
}

}  // namespace vegetation_sim::crowd
