// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/gait.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

struct Key {
  double percent, degrees;
};
template <std::size_t N>
using Curve = std::array<Key, N>;

// Extremes and turning points of the mean curves of natural walking, rounded to a degree: hip, knee
// and ankle after D. A. Winter, "The Biomechanics and Motor Control of Human Gait" (1991);
// shoulder and elbow after M. P. Murray, S. B. Sepic and E. J. Barnard, "Patterns of sagittal
// rotation of the upper limbs in walking", Physical Therapy 47 (1967).
constexpr Curve<9> HIP{
    {{0, 21}, {10, 18}, {25, 5}, {40, -7}, {51, -11}, {60, -5}, {72, 12}, {85, 22}, {94, 22}}};
constexpr Curve<9> KNEE{
    {{0, 4}, {14, 18}, {26, 12}, {40, 5}, {50, 10}, {60, 37}, {72, 63}, {84, 42}, {96, 4}}};
constexpr Curve<8> ANKLE{
    {{0, 0}, {7, -6}, {20, 3}, {42, 9}, {52, 3}, {62, -19}, {74, -5}, {88, 1}}};
constexpr Curve<4> SHOULDER{{{0, -24}, {25, -9}, {50, 8}, {75, -8}}};
constexpr Curve<4> ELBOW{{{0, 18}, {25, 26}, {50, 38}, {75, 28}}};

constexpr double RADIANS = PI / 180.0;
constexpr double SHORTEST = 0.02;  ///< least speed that has a stride [m/s]
/// Distances from below the hip, and from the place by the gait, from which on a foot is placed
/// again, relative to the height.
constexpr double FARTHEST_FOOT = 0.42, FARTHEST_OFF = 0.2;

double fractionOf(double cycles) {
  return cycles - std::floor(cycles);
}

// Returns the slope at a key from its neighbours, periodic in the cycle [degrees per percent].
template <std::size_t N>
double slopeAt(const Curve<N>& curve, std::size_t i) {
  const Key &before = curve[(i + N - 1) % N], &after = curve[(i + 1) % N];
  double span = after.percent - before.percent;
  if (span <= 0.0) span += 100.0;
  return (after.degrees - before.degrees) / span;
}

// Returns value and slope of the Bezier segment at the phase [rad], [rad per cycle].
template <std::size_t N>
void evaluate(const Curve<N>& curve, double phase, double& value, double& rate) {
  const double percent = 100.0 * fractionOf(phase);
  std::size_t i = N - 1;
  while (i > 0 && curve[i].percent > percent) --i;
  const std::size_t j = (i + 1) % N;
  const double span = (j == 0 ? 100.0 : curve[j].percent) - curve[i].percent;
  const double u = (percent - curve[i].percent) / span, w = 1.0 - u;
  const double p0 = curve[i].degrees, p3 = curve[j].degrees;
  const double p1 = p0 + span / 3.0 * slopeAt(curve, i), p2 = p3 - span / 3.0 * slopeAt(curve, j);
  value = RADIANS * (w * w * w * p0 + 3.0 * u * w * (w * p1 + u * p2) + u * u * u * p3);
  rate = RADIANS * 100.0 * 3.0 / span *
         (w * w * (p1 - p0) + 2.0 * u * w * (p2 - p1) + u * u * (p3 - p2));
}

void evaluateAll(double phase, Joints& values, Joints& rates) {
  evaluate(HIP, phase, values.hip, rates.hip);
  evaluate(KNEE, phase, values.knee, rates.knee);
  evaluate(ANKLE, phase, values.ankle, rates.ankle);
  evaluate(SHOULDER, phase, values.shoulder, rates.shoulder);
  evaluate(ELBOW, phase, values.elbow, rates.elbow);
}

// Returns the distance that a foot moves back while it stands, at full amplitude, relative to the
// height.
double fullReach() {
  static const double REACH = legPose(0.0, 1.0).stand - legPose(STANCE, 1.0).stand;
  return REACH;
}

Point toWorld(const Walker& w, const Point& local) {
  const SinCos turn = sinCos(w.heading);
  return {w.position.x + turn.cos * local.x - turn.sin * local.y,
          w.position.y + turn.sin * local.x + turn.cos * local.y};
}

Point toLocal(const Walker& w, const Point& place) {
  const SinCos turn = sinCos(w.heading);
  const Point v = place - w.position;
  return {turn.cos * v.x + turn.sin * v.y, turn.cos * v.y - turn.sin * v.x};
}

// Returns the position of a foot by the gait alone, forward and left of the walker [m].
Point gaitPlace(const Walker& w, int foot) {
  const double amplitude = gaitAmplitude(speedOf(w), w.height);
  const double side = foot == 0 ? 1.0 : -1.0;
  return {w.height * legPose(footPhase(w, foot), amplitude).stand,
          side * w.height * Proportions::HIP_HALF};
}

void setFoot(Walker& w, int index, bool struck) {
  Foot& foot = w.feet[static_cast<std::size_t>(index)];
  const bool stands = footPhase(w, index) < STANCE;
  if (stands) {
    const Point place = toWorld(w, gaitPlace(w, index));
    const bool lost = length(foot.planted - w.position) > FARTHEST_FOOT * w.height ||
                      length(foot.planted - place) > FARTHEST_OFF * w.height;
    if (struck || !foot.stands || lost) foot.planted = place;
  } else if (foot.stands || struck) {
    foot.offset = toLocal(w, foot.planted) - gaitPlace(w, index);
    if (length(foot.offset) > FARTHEST_FOOT * w.height) foot.offset = Point();
  }
  foot.stands = stands;
}

}  // namespace

Joints jointsAt(double phase) {
  Joints values, rates;
  evaluateAll(phase, values, rates);
  return values;
}

Joints jointRatesAt(double phase) {
  Joints values, rates;
  evaluateAll(phase, values, rates);
  return rates;
}

double strideLength(double speed, double height) {
  constexpr double NATURAL_SPEED = 1.35, NATURAL_STRIDE = 1.42, NATURAL_HEIGHT = 1.75;
  const double v = std::max(SHORTEST, speed) / NATURAL_SPEED;
  return NATURAL_STRIDE * (height / NATURAL_HEIGHT) * std::sqrt(v);
}

double gaitAmplitude(double speed, double height) {
  if (speed < SHORTEST) return speed / SHORTEST * gaitAmplitude(SHORTEST, height);
  return STANCE * strideLength(speed, height) / (fullReach() * height);
}

LegPose legPose(double phase, double amplitude) {
  return legPose(jointsAt(phase), amplitude);
}

LegPose legPose(const Joints& joints, double amplitude) {
  const SinCos thigh = sinCos(amplitude * joints.hip);
  const SinCos shank = sinCos(amplitude * (joints.hip - joints.knee));
  LegPose out;
  out.pitch = amplitude * (joints.hip - joints.knee + joints.ankle);
  out.ankle_forward = Proportions::THIGH * thigh.sin + Proportions::SHANK * shank.sin;
  out.ankle_up = -Proportions::THIGH * thigh.cos - Proportions::SHANK * shank.cos;
  double forward;
  rollOver(out.pitch, forward, out.ankle_height);
  out.stand = out.ankle_forward - forward;
  return out;
}

void rollOver(double pitch, double& forward, double& up) {
  const SinCos turn = sinCos(pitch);
  const double h = Proportions::ANKLE - Proportions::SOLE;
  if (pitch > 0.0) {  // about the heel
    forward = -(Proportions::FOOT_FRONT + Proportions::FOOT_BACK) +
              (Proportions::FOOT_BACK * turn.cos - h * turn.sin);
    up = Proportions::SOLE + Proportions::FOOT_BACK * turn.sin + h * turn.cos;
  } else {  // about the ball
    forward = -Proportions::FOOT_FRONT * turn.cos - h * turn.sin;
    up = Proportions::SOLE - Proportions::FOOT_FRONT * turn.sin + h * turn.cos;
  }
}

double speedOf(const Walker& walker) {
  return length(walker.velocity);
}

double footPhase(const Walker& walker, int foot) {
  return fractionOf(walker.gait + (foot == 0 ? 0.0 : 0.5));
}

void advanceGait(double way, Walker& walker) {
  const double before = walker.gait;
  walker.gait += way / strideLength(speedOf(walker), walker.height);
  for (int i = 0; i < 2; ++i) {
    const double shift = i == 0 ? 0.0 : 0.5;
    setFoot(walker, i, std::floor(walker.gait + shift) != std::floor(before + shift));
  }
}

Point footPlace(const Walker& walker, int index) {
  const Foot& foot = walker.feet[static_cast<std::size_t>(index)];
  if (foot.stands) return foot.planted;
  const double part = (footPhase(walker, index) - STANCE) / (1.0 - STANCE);
  return toWorld(walker, gaitPlace(walker, index) + (1.0 - smoothStep(part)) * foot.offset);
}

}  // namespace vegetation_sim::crowd
