// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/walking_speed.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr int SWEEPS = 6;
constexpr double UNBOUNDED = 1e9;         // [m]
constexpr double JUST_LESS = 1.0 - 1e-9;  // share of a hard limit, for rounding
constexpr double BACKWARDS = 0.35;        // share of the speed across and against the body's front
constexpr double TURN_TIME = 0.7;         // [s]
constexpr double TURN_SLACK = 0.05;       // angle below which a body does not turn [rad]

// Returns a direction by which two walkers at one place part, equal for both.
Point partingLine(std::uint32_t self, std::uint32_t other) {
  const std::uint32_t low = std::min(self, other), high = std::max(self, other);
  const double turns = static_cast<double>(mix32(low * 0x9E3779B9U + high)) / 4294967296.0;
  const SinCos line = sinCosTurns(turns);
  return self < other ? Point{line.cos, line.sin} : Point{-line.cos, -line.sin};
}

bool project(const Limit& limit, double bound, Point& step) {
  const double over = dot(step, limit.normal) - bound;
  if (!(over > 0.0)) return false;
  step = step - over * limit.normal;
  return true;
}

// Projects onto one limit after the other until the step is within all or violates them evenly.
void projectOnAll(const std::array<Limit, View::MOST>& limits, int count, double Limit::*bound,
                  Point& step) {
  bool crosses = true;
  for (int sweep = 0; sweep < SWEEPS && crosses; ++sweep) {
    crosses = false;
    for (int i = count - 1; i >= 0; --i) {
      const Limit& limit = limits[static_cast<std::size_t>(i)];
      if (project(limit, limit.*bound, step)) crosses = true;
    }
  }
}

double wrapped(double angle) {
  return angle - 2.0 * PI * std::floor(angle * (0.5 / PI) + 0.5);
}

// Approximates the angle within 0.005 rad and 6 %, which suffices for steering.
double roughAngle(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y), big = std::max(ax, ay);
  if (!(big > 0.0)) return 0.0;
  const double ratio = std::min(ax, ay) / big;
  double angle = ratio * (PI / 4.0 + 0.273 * (1.0 - ratio));
  if (ay > ax) angle = PI / 2.0 - angle;
  if (x < 0.0) angle = PI - angle;
  return y < 0.0 ? -angle : angle;
}

}  // namespace

double slopeFactor(double slope) {
  constexpr double STEEPNESS = 3.5, BEST = -0.05;
  return exponential(STEEPNESS * (std::fabs(BEST) - std::fabs(slope - BEST)));
}

double paceAt(const Point& place, const Point& direction, const terrain::HeightMap& terrain,
              const Resistance& resistance, const CrowdSettings& s) {
  double out = s.pace;
  if (!terrain.isFlat()) {
    const Vec3 up = terrain.normal(place.x, place.y);
    out *= slopeFactor(-(up.x() * direction.x + up.y() * direction.y) / up.z());
  }
  if (resistance) out *= 1.0 - s.grass_drag * saturate(resistance(place));
  return out;
}

int limitsOf(std::uint32_t self, const View& view, const CrowdSettings& s, double dt,
             std::array<Limit, View::MOST>& limits) {
  for (int i = 0; i < view.count; ++i) {
    const Sight& sight = view.at(i);
    Limit& limit = limits[static_cast<std::size_t>(i)];
    limit.normal = sight.normal;
    if (dot(sight.normal, sight.normal) == 0.0)
      limit.normal = sight.kind == Seen::WALKER ? partingLine(self, sight.index) : Point{1.0, 0.0};
    const double share = sight.kind == Seen::WALKER ? 0.5 : 1.0;
    limit.wanted = share * (sight.gap - s.clearance);
    limit.hard = share * JUST_LESS * std::max(0.0, std::min(sight.gap, sight.lower));
    // Only static ones among the overlapping obstacles are hard limits.
    if (sight.gap < 0.0 && (i > 0 || sight.kind != Seen::STATIC)) limit.hard = UNBOUNDED;
    if (sight.kind == Seen::ROBOT)
      limit.wanted -= dt * std::max(0.0, -dot(sight.velocity, limit.normal));
    limit.wanted = std::max(limit.wanted, -s.push_speed * dt);
  }
  return view.count;
}

Point safeStep(const Point& desired, const std::array<Limit, View::MOST>& limits, int count,
               double farthest) {
  Point step = desired;
  projectOnAll(limits, count, &Limit::wanted, step);
  projectOnAll(limits, count, &Limit::hard, step);
  double scale = 1.0;
  for (int i = 0; i < count; ++i) {
    const Limit& limit = limits[static_cast<std::size_t>(i)];
    const double along = dot(step, limit.normal);
    if (along > limit.hard) scale = std::min(scale, limit.hard / along);
  }
  const double size = length(step);
  if (size * scale > farthest) scale = std::max(0.0, farthest) / size;
  return scale * step;
}

Point frontOf(const Walker& walker) {
  const SinCos front = sinCos(walker.heading);
  return {front.cos, front.sin};
}

Point followed(const Walker& walker, const Point& front, const Command& command,
               const CrowdSettings& s, double dt) {
  const double facing = dot(front, command.direction);
  const double speed = command.speed * (BACKWARDS + (1.0 - BACKWARDS) * std::max(0.0, facing));
  Point change = speed * command.direction - walker.velocity;
  change = (dt / (dt + s.reaction)) * change;
  const double size = length(change), most = s.acceleration * dt;
  if (size > most) change = (most / size) * change;
  return walker.velocity + change;
}

void turnTowards(const Point& direction, const Point& front, const CrowdSettings& s, double dt,
                 Walker& walker) {
  const double off =
      roughAngle(front.x * direction.y - front.y * direction.x, dot(front, direction));
  const double beyond = std::copysign(std::max(0.0, std::fabs(off) - TURN_SLACK), off);
  const double wanted = std::min(s.turn_rate, std::max(-s.turn_rate, beyond / TURN_TIME));
  walker.turn_rate += (dt / (dt + 0.5 * TURN_TIME)) * (wanted - walker.turn_rate);
  double turn = walker.turn_rate * dt;
  if (std::fabs(turn) > std::fabs(off) && turn * off > 0.0) turn = off;
  walker.heading = wrapped(walker.heading + turn);
}

}  // namespace vegetation_sim::crowd
