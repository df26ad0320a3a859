// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/wind/primitive.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "wind/limits.h"

namespace vegetation_sim::wind {
namespace {

bool isKind(const Primitive& p, std::initializer_list<Kind> kinds) {
  for (const Kind kind : kinds)
    if (p.kind == kind) return true;
  return false;
}

/// Sends fields that the kind does not use to a second visitor.
struct Split {
  FieldVisitor &used, &unused;
  FieldVisitor& operator()(bool is_used) const { return is_used ? used : unused; }
};

void visit(const Split& split, Primitive& p) {
  const bool disk = isKind(p, {Kind::DISK}), breeze = isKind(p, {Kind::BREEZE});
  const bool gust = isKind(p, {Kind::GUST}), tornado = isKind(p, {Kind::TORNADO});
  const bool wake = isKind(p, {Kind::WAKE}), markov = isKind(p, {Kind::GAUSS_MARKOV});
  const bool centred = !breeze, radial = isKind(p, {Kind::TORNADO, Kind::BLAST});
  split(true).choice("kind", p.kind, kindNames());
  split(true).number("fade_in", p.fade_in, "s", {0.0, 600.0});
  split(true).number("fade_out", p.fade_out, "s", {0.0, 600.0});
  split(centred).number("orbit_radius", p.orbit_radius, "m", {0.0, 1e5});
  split(centred).number("orbit_period", p.orbit_period, "s", {0.0, 1e6});
  split(!radial && !wake).vector("velocity", p.velocity, "m/s", SPEEDS);
  split(centred).number("radius", p.radius, "m", {0.01, 1e5});
  split(disk).number("omega", p.omega, "rad/s", {0.0, 100.0});
  split(disk).number("phase", p.phase, "rad", {-100.0, 100.0});
  split(disk).choice("envelope", p.envelope, {"smooth", "paper"});
  split(breeze || markov).number("turbulence", p.turbulence, "", TURBULENCE);
  split(breeze).number("length_scale", p.length_scale, "m", {1.0, 1000.0});
  split(gust).number("front_speed", p.front_speed, "m/s", {0.0, 200.0});
  split(gust).number("rise_length", p.rise_length, "m", {0.01, 1e4});
  split(gust || wake).number("plateau_length", p.plateau_length, "m", {0.0, 1e4});
  split(gust || wake).number("decay_length", p.decay_length, "m", {0.01, 1e4});
  split(gust).number("repeat", p.repeat, "s", {0.0, 1e6});
  split(radial).number("speed", p.speed, "m/s", SPEEDS);
  split(radial).number("core_radius", p.core_radius, "m", {0.01, 1e4});
  split(tornado || wake).number("inflow", p.inflow, "", {-2.0, 2.0});
  split(tornado).number("updraft", p.updraft, "", {-2.0, 2.0});
  // The hashes and archives of other kinds are those from before this field. A reader knows the
  // kind only now.
  if (isKind(p, {Kind::GAUSS_MARKOV}))
    split(true).number("time_scale", p.time_scale, "s", TIME_SCALES);
}

class Ignore : public FieldVisitor {
 public:
  void number(const char*, double&, const char*, Range) override {}
  void integer(const char*, int&, const char*, Range) override {}
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char*, int&, const std::vector<std::string>&) override {}
};

/// Checks that fields which a kind does not use are finite.
class FiniteChecker : public FieldChecker {
 public:
  using FieldChecker::FieldChecker;
  void number(const char* name, double& value, const char* unit, Range range) override {
    if (!std::isfinite(value)) FieldChecker::number(name, value, unit, range);
  }
  void choice(const char*, int&, const std::vector<std::string>&) override {}
};

std::string seconds(Nanoseconds stamp) {
  return std::to_string(secondsBetween(0, stamp)) + " s";
}

void checkStamp(const std::string& name, Nanoseconds stamp, Faults& faults) {
  if (stamp < 0 || stamp > LAST_STAMP)
    faults.add(name + " = " + seconds(stamp) + " is outside 0 to " + seconds(LAST_STAMP));
}

void checkTrajectory(const std::string& context, const Primitive& p, Faults& faults) {
  const auto& points = p.trajectory;
  if (points.size() > MAX_WAYPOINTS)
    return faults.add(context + "trajectory has " + std::to_string(points.size()) +
                      " way points, allowed are " + std::to_string(MAX_WAYPOINTS));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string point = context + "trajectory[" + std::to_string(i) + "]";
    Vec3 position = points[i].position;
    FieldChecker(point + ".", faults).vector("position", position, "m", POSITIONS);
    checkStamp(point + ".stamp", points[i].stamp, faults);
    if (i > 0 && points[i].stamp <= points[i - 1].stamp)
      faults.add(point + ".stamp = " + seconds(points[i].stamp) + " is not after " +
                 seconds(points[i - 1].stamp) + " of the point before");
  }
}

// The parts of the speed of a wake's body: between way points, and around its orbit.
void checkBody(const std::string& context, const Primitive& p, Faults& faults) {
  for (std::size_t i = 1; i < p.trajectory.size(); ++i) {
    const double speed = levelSpeed(p.trajectory[i - 1], p.trajectory[i]);
    if (speed > BODY_SPEEDS.high)
      faults.add(rangeFault(context + "speed to trajectory[" + std::to_string(i) + "]", speed,
                            "m/s", BODY_SPEEDS));
  }
  if (!(p.orbit_radius > 0.0 && p.orbit_period >= SHORTEST_ORBIT)) return;
  const double speed = 2.0 * PI * p.orbit_radius / p.orbit_period;
  if (speed > BODY_SPEEDS.high)
    faults.add(rangeFault(context + "speed on the orbit", speed, "m/s", BODY_SPEEDS));
}

void checkOrbit(const std::string& context, const Primitive& p, Faults& faults) {
  if (p.orbit_radius > 0.0 && p.orbit_period >= 0.0 && p.orbit_period < SHORTEST_ORBIT)
    faults.add(rangeFault(context + "orbit_period", p.orbit_period, "s", {SHORTEST_ORBIT, 1e6}));
}

void checkGust(const std::string& context, const Primitive& p, Faults& faults) {
  if (p.velocity.x() == 0.0 && p.velocity.y() == 0.0)
    faults.add(context + "velocity has no horizontal part, so the gust has no direction");
}

}  // namespace

double levelSpeed(const Waypoint& from, const Waypoint& to) {
  const Vec3 step = to.position - from.position;
  return std::sqrt(step.x() * step.x() + step.y() * step.y()) /
         secondsBetween(from.stamp, to.stamp);
}

const std::vector<std::string>& kindNames() {
  static const std::vector<std::string> NAMES = {"disk",  "breeze", "gust",        "tornado",
                                                 "blast", "wake",   "gauss_markov"};
  return NAMES;
}

void describe(FieldVisitor& visitor, Primitive& p) {
  Ignore ignore;
  visit({visitor, ignore}, p);
}

void describeAll(FieldVisitor& visitor, Primitive& p) {
  visit({visitor, visitor}, p);
}

void check(Primitive p, Faults& faults) {
  if (p.name.empty()) faults.add("primitive " + std::to_string(p.id) + ": name is empty");
  if (p.name.size() > MAX_NAME)
    faults.add("primitive " + std::to_string(p.id) + ": name has " + std::to_string(p.name.size()) +
               " characters, allowed are " + std::to_string(MAX_NAME));
  const std::string context = "primitive " + inQuotes(p.name) + ": ";
  FieldChecker used(context, faults);
  FiniteChecker unused(context, faults);
  visit({used, unused}, p);
  if (!isKind(p, {Kind::GAUSS_MARKOV})) unused.number("time_scale", p.time_scale, "s", TIME_SCALES);
  checkStamp(context + "epoch", p.epoch, faults);
  checkStamp(context + "t_on", p.t_on, faults);
  checkStamp(context + "t_off", p.t_off, faults);
  if (p.t_off != 0 && p.t_off <= p.t_on)
    faults.add(context + "t_off = " + seconds(p.t_off) + " is not after t_on = " + seconds(p.t_on));
  checkTrajectory(context, p, faults);
  if (!isKind(p, {Kind::BREEZE})) checkOrbit(context, p, faults);
  if (isKind(p, {Kind::GUST})) checkGust(context, p, faults);
  if (isKind(p, {Kind::WAKE})) checkBody(context, p, faults);
}

}  // namespace vegetation_sim::wind
