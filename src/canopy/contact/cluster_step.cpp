// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/contact/cluster_step.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/canopy/flow/wave_steps.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr int SAMPLES = 6;      // of the part of a fibre near a body
constexpr double SMALL = 1e-2;  // [rad]; series below it are exact to 1e-15

// Returns the ground of a cell within the plant [m^2].
double groundOf(const Fibres& fibres, std::size_t cell) {
  return fibres.edge() * fibres.edge() * filledShare(fibres, cell);
}

double omegaOf(const PushLaw& law) {
  return 2.0 * PI * law.frequency;
}

/// Direction of a fibre that leans, and its derivatives by the two parts of the lean.
struct Direction {
  explicit Direction(const Flat& lean) {
    const double angle = lean.size(), square = angle * angle;
    const SinCos turn = sinCos(angle);
    const bool small = angle < SMALL;
    const double sinc = small ? 1.0 - square / 6.0 * (1.0 - square / 20.0) : turn.sin / angle;
    const double slope =
        small ? -1.0 / 3.0 + square / 30.0 * (1.0 - square / 28.0) : (turn.cos - sinc) / square;
    along = Vec3(sinc * lean.x, sinc * lean.y, turn.cos);
    const double mixed = slope * lean.x * lean.y;
    by_x = Vec3(sinc + slope * lean.x * lean.x, mixed, -sinc * lean.x);
    by_y = Vec3(mixed, sinc + slope * lean.y * lean.y, -sinc * lean.y);
  }
  /// Returns the components of a vector along the derivatives.
  Flat into(const Vec3& v) const { return {dot(by_x, v), dot(by_y, v)}; }
  Vec3 along, by_x, by_y;
};

/// A piece of the fibres of a cell that overlaps a body.
struct Overlap {
  std::size_t body;
  double height;       // of its middle along the fibre [m]
  Vec3 place, normal;  // world; the normal is from the body
  double depth;        // [m]
  double width;        // length of the piece over the edge of the cell
  Vec3 velocity;       // of the body there [m/s]
  Flat pull;           // components of the normal
  bool pressed{true};
};

/// Symmetric matrix of two rows.
struct Square {
  double xx{0.0}, xy{0.0}, yy{0.0};
  void add(double factor, const Flat& v) {
    xx += factor * v.x * v.x;
    xy += factor * v.x * v.y;
    yy += factor * v.y * v.y;
  }
  Flat solve(const Flat& b) const {
    const double determinant = xx * yy - xy * xy;
    return {(yy * b.x - xy * b.y) / determinant, (xx * b.y - xy * b.x) / determinant};
  }
};

// Narrows the part [low, high] of a ray to that between two planes perpendicular to an axis.
void clip(double start, double slope, double limit, double& low, double& high) {
  if (std::fabs(slope) < 1e-12) {
    if (std::fabs(start) > limit) high = low;
    return;
  }
  const double a = (-limit - start) / slope, b = (limit - start) / slope;
  low = std::max(low, std::min(a, b));
  high = std::min(high, std::max(a, b));
}

/// One cell in one step.
class Step {
 public:
  Step(const PushLaw& law, const Fibres& fibres, std::size_t cell, double dt,
       const std::vector<PosedBody>& bodies, Cluster& cluster)
      : law_(law),
        fibres_(fibres),
        dt_(dt),
        bodies_(bodies),
        cluster_(cluster),
        cell_(cell),
        foot_(fibres.footOf(cell)),
        direction_(cluster.lean) {
    for (std::size_t body = 0; body < bodies.size(); ++body) findOverlaps(body);
  }

  bool touches() const { return !overlaps_.empty(); }

  void take(std::vector<BodyLoad>& loads) {
    Flat rate = solve();
    while (release(rate)) rate = solve();
    const Flat before = cluster_.lean;
    cluster_.lean = {before.x + dt_ * rate.x, before.y + dt_ * rate.y};
    cluster_.rate = rate;
    // At the largest lean the fibres stop, and bodies overlap them.
    const double size = cluster_.lean.size();
    if (size > LARGEST_LEAN) {
      const double kept = LARGEST_LEAN / size;
      cluster_.lean = {kept * cluster_.lean.x, kept * cluster_.lean.y};
      rate = {(cluster_.lean.x - before.x) / dt_, (cluster_.lean.y - before.y) / dt_};
      cluster_.rate = {};
    }
    const double area = groundOf(fibres_, cell_);
    for (const Overlap& overlap : overlaps_) addLoad(overlap, rate, area, loads[overlap.body]);
  }

 private:
  // The fibre, a straight line, near the body in the axes of the body.
  void findOverlaps(std::size_t body) {
    const PosedBody& posed = bodies_[body];
    const Quat back = conjugate(posed.pose.orientation);
    const Vec3 start = rotate(back, Vec3(foot_ - posed.pose.position));
    const Vec3 along = rotate(back, direction_.along);
    const double half = 0.5 * fibres_.edge(), room = posed.shape.radius + half;
    double low = 0.0, high = fibres_.length;
    for (int i = 0; i < 3; ++i) clip(start[i], along[i], posed.shape.half[i] + room, low, high);
    if (!(high > low)) return;
    const double piece = (high - low) / SAMPLES;
    for (int i = 0; i < SAMPLES; ++i) {
      Overlap out;
      out.body = body;
      out.height = low + (i + 0.5) * piece;
      Vec3 normal;
      const Vec3 place = start + out.height * along;
      const double distance = physics::signedDistance(posed.shape, place, normal);
      out.normal = rotate(posed.pose.orientation, normal);
      // Fibres fill the cell, but do not reach beyond it upwards or downwards.
      out.depth = half * Flat{out.normal.x(), out.normal.y()}.size() - distance;
      if (!(out.depth > 0.0)) continue;
      out.place = foot_ + out.height * direction_.along;
      out.width = piece / fibres_.edge();
      out.velocity = posed.velocity + cross(posed.spin, Vec3(out.place - posed.pose.position));
      out.pull = direction_.into(out.normal);
      overlaps_.push_back(out);
    }
  }

  // Solves the step for the rate at its end. All terms are those of the tops, over mu length.
  Flat solve() const {
    const double omega = omegaOf(law_), height = fibres_.length;
    const double inertia = law_.stiffness / (omega * omega);
    const double self =
        inertia + dt_ * 2.0 * law_.damping * law_.stiffness / omega + dt_ * dt_ * law_.stiffness;
    Square matrix{self, 0.0, self};
    Flat right{
        inertia * cluster_.rate.x - dt_ * law_.stiffness * (cluster_.lean.x - cluster_.set.x),
        inertia * cluster_.rate.y - dt_ * law_.stiffness * (cluster_.lean.y - cluster_.set.y)};
    for (const Overlap& overlap : overlaps_) {
      if (!overlap.pressed) continue;
      const double share = overlap.height / height;
      const double spring = overlap.width * law_.pressure;
      const double drag = overlap.width * overlap.depth * law_.drag;
      matrix.add(dt_ * dt_ * spring * share * share, overlap.pull);
      for (int i = 0; i < 3; ++i)
        matrix.add(dt_ * drag * share * share, {direction_.by_x[i], direction_.by_y[i]});
      const Flat flow = direction_.into(overlap.velocity);
      const double push = dt_ * spring * overlap.depth, carry = dt_ * drag;
      right.x += share / height * (push * overlap.pull.x + carry * flow.x);
      right.y += share / height * (push * overlap.pull.y + carry * flow.y);
    }
    return matrix.solve(right);
  }

  // Pressure at the end of the step [Pa].
  double pressureAfter(const Overlap& overlap, const Flat& rate) const {
    const double motion = overlap.height * overlap.pull.dot(rate);
    return law_.pressure * (overlap.depth - dt_ * motion) +
           law_.drag * overlap.depth * (dot(overlap.velocity, overlap.normal) - motion);
  }

  // Drops the overlaps that would pull. Returns whether there were any.
  bool release(const Flat& rate) {
    bool any = false;
    for (Overlap& overlap : overlaps_)
      if (overlap.pressed && pressureAfter(overlap, rate) < 0.0) {
        overlap.pressed = false;
        any = true;
      }
    return any;
  }

  void addLoad(const Overlap& overlap, const Flat& rate, double area, BodyLoad& load) const {
    if (!overlap.pressed) return;
    const double volume = area * overlap.width * overlap.depth;
    const Vec3 slip =
        overlap.velocity - overlap.height * (rate.x * direction_.by_x + rate.y * direction_.by_y);
    const Vec3 along = slip - dot(slip, overlap.normal) * overlap.normal;
    const Vec3 pressed = std::max(0.0, pressureAfter(overlap, rate)) * overlap.normal;
    const Vec3 impulse = -dt_ * (area * overlap.width * pressed + volume * law_.drag * along);
    const double weight = length(impulse);
    load.impulse += impulse;
    load.moment += cross(Vec3(overlap.place - bodies_[overlap.body].pose.position), impulse);
    load.weighted += weight * overlap.place;
    load.weight += weight;
    load.volume += dt_ * volume;
  }

  const PushLaw& law_;
  const Fibres& fibres_;
  double dt_;
  const std::vector<PosedBody>& bodies_;
  Cluster& cluster_;
  std::size_t cell_;
  Vec3 foot_;
  Direction direction_;
  std::vector<Overlap> overlaps_;
};

// A cell that has leant far keeps a share of its lean, and recovers in time.
void updateSet(const PushLaw& law, double dt, Cluster& cluster) {
  const double left = exponential(-dt / law.recovery);
  Flat& set = cluster.set;
  set = {left * set.x, left * set.y};
  if (law.set * cluster.lean.size() > set.size())
    set = {law.set * cluster.lean.x, law.set * cluster.lean.y};
}

}  // namespace

void swing(const PushLaw& law, double dt, Cluster& cluster) {
  if (cluster.rests()) {
    cluster = {};
    return;
  }
  const double omega = omegaOf(law);
  const ModeStep step = modeStep(law.damping * omega, omega * omega, dt);
  const auto part = [&](double& lean, double& rate, double set) {
    const double offset = lean - set, speed = rate;
    lean = set + (step.keep * offset + step.from_rate * speed);
    rate = step.to_rate * offset + step.keep_rate * speed;
  };
  part(cluster.lean.x, cluster.rate.x, cluster.set.x);
  part(cluster.lean.y, cluster.rate.y, cluster.set.y);
  const double size = cluster.lean.size();
  if (size > LARGEST_LEAN) {
    const double kept = LARGEST_LEAN / size;
    cluster.lean = {kept * cluster.lean.x, kept * cluster.lean.y};
    cluster.rate = {};
  }
  updateSet(law, dt, cluster);
}

void stepCluster(const PushLaw& law, const Fibres& fibres, std::size_t cell, double dt,
                 const std::vector<PosedBody>& bodies, Cluster& cluster,
                 std::vector<BodyLoad>& loads) {
  Step step(law, fibres, cell, dt, bodies, cluster);
  if (!step.touches()) return swing(law, dt, cluster);
  step.take(loads);
  updateSet(law, dt, cluster);
}

double energyOf(const PushLaw& law, const Fibres& fibres, std::size_t cell,
                const Cluster& cluster) {
  const double omega = omegaOf(law), height = fibres.length;
  const Flat offset{cluster.lean.x - cluster.set.x, cluster.lean.y - cluster.set.y};
  return 0.5 * groundOf(fibres, cell) * law.stiffness * height * height *
         (offset.dot(offset) + cluster.rate.dot(cluster.rate) / (omega * omega));
}

}  // namespace vegetation_sim::canopy
