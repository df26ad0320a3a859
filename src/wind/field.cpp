// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/field.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/breeze.h"
#include "wind/fade.h"
#include "wind/gauss_markov.h"
#include "wind/laws.h"
#include "wind/limits.h"
#include "wind/trajectory.h"

namespace vegetation_sim::wind {
namespace {

// share of a repeated gust's cycle in which it fades, at each end
constexpr double REPEAT_EDGE = 0.1;
constexpr double BOUND_TIME = 1.0;  // [s] motion of a gust or wake that a bound covers
// A wake belongs to the mean velocity of its body over this time: that of a spline at one instant
// is only once differentiable.
constexpr double WAKE_TIME = 0.2;   // [s]
constexpr double WAKE_ONSET = 0.5;  // [m/s] speed of a body from which its wake has full strength

Vec3 levelDirection(const Vec3& v) {
  const double size = std::sqrt(v.x() * v.x() + v.y() * v.y());
  return size > 0.0 ? Vec3(v.x() / size, v.y() / size, 0.0) : Vec3(Vec3::UnitX());
}

void shapeDisk(const Primitive& p, double elapsed, double weight, Term& term) {
  // The two parts of the phase are reduced apart: the first is large, the second exact.
  const double turns = p.omega * elapsed / (2.0 * PI), psi = p.phase / (2.0 * PI);
  // Subtracting the nearest whole turn keeps all digits just before the epoch.
  const double sine = sinCosTurns(turns - std::floor(turns + 0.5) + psi).sin;
  term.smooth = p.envelope == Envelope::SMOOTH;
  term.amplitude = p.velocity * (weight * sine);
  term.peak = weight * length(p.velocity);
}

// It acts as a disk whose amplitude follows the process. Three standard deviations count for the
// bound, as for a breeze.
void shapeGaussMarkov(const Primitive& p, const GaussMarkov& process, double elapsed, double weight,
                      Term& term) {
  term.kind = Kind::DISK;
  term.amplitude = weight * (p.velocity + process.at(elapsed));
  term.peak = weight * (length(p.velocity) + 3.0 * process.rms());
}

void shapeGust(const Primitive& p, double elapsed, double weight, Term& term) {
  double tau = elapsed;
  if (p.repeat > 0.0) {
    tau = elapsed - p.repeat * std::floor(elapsed / p.repeat);
    const double edge = REPEAT_EDGE * p.repeat;
    weight *= ramp(tau, edge) * ramp(p.repeat - tau, edge);
  }
  term.direction = levelDirection(p.velocity);
  term.centre += term.direction * (p.front_speed * tau);
  term.amplitude = p.velocity * weight;
  term.rise = p.rise_length;
  term.plateau = p.plateau_length;
  term.decay = p.decay_length;
  term.travel = p.front_speed * BOUND_TIME;
  term.peak = weight * length(p.velocity);
}

// Returns the speed of the air at the centre of a body over that of the body and `inflow`. Near
// zero speed, the direction turns fast and the strength falls faster. A spline through way points
// within BODY_SPEEDS can be faster than they are.
double wakeShare(double speed) {
  return smootherStep(speed / WAKE_ONSET) *
         (speed > BODY_SPEEDS.high ? BODY_SPEEDS.high / speed : 1.0);
}

// `acceleration` bounds that of the centre over BOUND_TIME + WAKE_TIME / 2 to both sides.
void shapeWake(const Primitive& p, const Vec3& velocity, double acceleration, double weight,
               Term& term) {
  const Vec3 level(velocity.x(), velocity.y(), 0.0);
  const double speed = length(level), change = acceleration * BOUND_TIME;
  term.direction = levelDirection(level);
  term.amplitude = level * (p.inflow * weight * wakeShare(speed));
  term.plateau = p.plateau_length;
  term.decay = p.decay_length;
  term.sway = acceleration * BOUND_TIME * 0.5 * (BOUND_TIME + WAKE_TIME);
  term.travel = speed * BOUND_TIME + term.sway;
  term.turn = change < speed ? change / speed : change > 0.0 ? 1.0 : 0.0;
  term.peak = length(term.amplitude) * WAKE_PEAK;
  const double fastest = speed + change;
  term.limit = std::fabs(p.inflow) * weight * fastest * wakeShare(fastest) * WAKE_PEAK;
}

void shapeEddy(const Primitive& p, double weight, Term& term) {
  const bool tornado = term.kind == Kind::TORNADO;
  term.core = p.core_radius;
  term.speed = p.speed * weight;
  term.inflow = tornado ? p.inflow : 0.0;
  term.updraft = tornado ? p.updraft : 0.0;
  term.peak = std::fabs(term.speed) *
              std::sqrt(1.0 + term.inflow * term.inflow + term.updraft * term.updraft);
}

}  // namespace

struct Field::Compiled {
  Trajectory path;
  Breeze breeze;
  GaussMarkov gauss_markov;

  Vec3 centreAt(const Primitive& p, Nanoseconds stamp) const {
    const Vec3 centre = path.at(stamp);
    if (!(p.orbit_radius > 0.0)) return centre;
    const SinCos turn = sinCosTurns(secondsBetween(p.epoch, stamp) / p.orbit_period);
    return centre + Vec3(turn.cos, turn.sin, 0.0) * p.orbit_radius;
  }
  double accelerationBound(const Primitive& p, Nanoseconds stamp) const {
    const Nanoseconds margin = fromSeconds(BOUND_TIME + 0.5 * WAKE_TIME);
    double out = path.accelerationBound(stamp - margin, stamp + margin);
    if (p.orbit_radius > 0.0) {
      const double omega = 2.0 * PI / p.orbit_period;
      out += omega * omega * p.orbit_radius;
    }
    return out;
  }
};

Field::Field() = default;
Field::~Field() = default;

Field::Field(std::vector<Primitive> primitives, std::uint64_t seed)
    : primitives_(std::move(primitives)), seed_(seed) {
  Faults faults;
  if (primitives_.size() > MAX_PRIMITIVES)
    faults.add("field has " + std::to_string(primitives_.size()) + " primitives, allowed are " +
               std::to_string(MAX_PRIMITIVES));
  std::set<std::uint32_t> ids;
  for (const Primitive& p : primitives_) {
    check(p, faults);
    if (!ids.insert(p.id).second)
      faults.add("primitive " + inQuotes(p.name) + ": id = " + std::to_string(p.id) +
                 " is already in use");
  }
  faults.throwIfAny();
  for (const Primitive& p : primitives_) {
    const bool breeze = p.kind == Kind::BREEZE, markov = p.kind == Kind::GAUSS_MARKOV;
    compiled_.push_back(std::make_shared<Compiled>(
        Compiled{Trajectory(p.trajectory), breeze ? Breeze(p, seed_) : Breeze(),
                 markov ? GaussMarkov(p, seed_) : GaussMarkov()}));
  }
}

Instant Field::at(Nanoseconds stamp) const {
  Instant instant;
  at(stamp, instant);
  return instant;
}

void Field::at(Nanoseconds stamp, Instant& instant) const {
  instant.mean = Vec3::Zero();
  instant.breezes = 0;
  instant.modes.clear();
  instant.terms.clear();
  for (std::size_t i = 0; i < primitives_.size(); ++i) {
    const Primitive& p = primitives_[i];
    if (p.kind != Kind::BREEZE) {
      Term term;
      if (termAt(i, stamp, term)) instant.terms.push_back(term);
    } else if (const double weight = fade(p, stamp); weight != 0.0) {
      ++instant.breezes;
      instant.mean += p.velocity * weight;
      compiled_[i]->breeze.addModes(secondsBetween(p.epoch, stamp), weight, instant.modes);
    }
  }
}

bool Field::termAt(std::size_t index, Nanoseconds stamp, Term& out) const {
  const Primitive& p = primitives_[index];
  out = Term();
  out.kind = p.kind;
  if (out.kind == Kind::BREEZE) return false;
  const double weight = fade(p, stamp), elapsed = secondsBetween(p.epoch, stamp);
  if (weight == 0.0) return false;
  out.radius = p.radius;
  out.centre = compiled_[index]->centreAt(p, stamp);
  if (out.kind == Kind::DISK) shapeDisk(p, elapsed, weight, out);
  if (p.kind == Kind::GAUSS_MARKOV)
    shapeGaussMarkov(p, compiled_[index]->gauss_markov, elapsed, weight, out);
  if (out.kind == Kind::GUST) shapeGust(p, elapsed, weight, out);
  if (out.kind == Kind::TORNADO || out.kind == Kind::BLAST) shapeEddy(p, weight, out);
  if (out.kind == Kind::WAKE) {
    const Nanoseconds half = fromSeconds(0.5 * WAKE_TIME);
    const Vec3 before = compiled_[index]->centreAt(p, stamp - half);
    shapeWake(p, (compiled_[index]->centreAt(p, stamp + half) - before) / WAKE_TIME,
              compiled_[index]->accelerationBound(p, stamp), weight, out);
  }
  return out.peak > 0.0 || out.limit > 0.0;
}

const Breeze& Field::breezeOf(std::size_t index) const {
  return compiled_[index]->breeze;
}

std::uint64_t Field::hash() const {
  Hash hash;
  hash.add(seed_);
  hash.add(static_cast<std::uint64_t>(primitives_.size()));
  FieldHasher hasher(hash);
  for (Primitive p : primitives_) {
    hash.add(static_cast<std::uint64_t>(p.id));
    hash.add(p.name);
    for (const Nanoseconds stamp : {p.epoch, p.t_on, p.t_off})
      hash.add(static_cast<std::uint64_t>(stamp));
    describeAll(hasher, p);
    hash.add(static_cast<std::uint64_t>(p.trajectory.size()));
    for (const Waypoint& point : p.trajectory) {
      hash.add(static_cast<std::uint64_t>(point.stamp));
      hash.add(point.position);
    }
  }
  return hash.value();
}

}  // namespace vegetation_sim::wind
