// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/warp.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double STEEPEST = 0.5;

// Returns x^power on [0, 1] by + - * / and square roots alone, so that every processor gives the
// same bits.
double powerOf(double x, double power) {
  double out = 1.0;
  const double whole = std::floor(power);
  for (double i = 0.0; i < whole; i += 1.0) out *= x;
  double rest = power - whole, root = x;
  for (int bit = 0; bit < 30 && rest > 0.0; ++bit) {
    root = std::sqrt(root);
    rest *= 2.0;
    if (rest < 1.0) continue;
    rest -= 1.0;
    out *= root;
  }
  return out;
}

/// Largest differences between horizontal and vertical neighbours.
struct Steepness {
  double right{0.0}, above{0.0};
};

Steepness steepnessOf(const std::vector<double>& values, int size) {
  const int mask = size - 1;
  Steepness out;
  for (int row = 0; row < size; ++row) {
    const double* here = values.data() + row * size;
    const double* above = values.data() + ((row + 1) & mask) * size;
    for (int i = 0; i < size; ++i) {
      out.right = std::max(out.right, std::fabs(here[(i + 1) & mask] - here[i]));
      out.above = std::max(out.above, std::fabs(above[i] - here[i]));
    }
  }
  return out;
}

void weaken(std::vector<double>& values, double share) {
  double mean = 0.0;
  for (const double value : values) mean += value;
  mean /= static_cast<double>(values.size());
  for (double& value : values) value = mean + share * (value - mean);
}

}  // namespace

void describe(FieldVisitor& v, WarpSettings& s) {
  v.choice("form", s.form, {"right", "printed"});
  v.vector("lambda", s.lambda, "", {0.0, 10.0});
  v.number("reference_time", s.reference_time, "s", {0.0, 1.0});
  v.number("depth_loss", s.depth_loss, "", {0.0, 1.0});
  v.number("rigidity", s.rigidity, "", {0.0, 10.0});
  v.choice("method", s.method, {"warp", "bend"});
  v.number("twist", s.twist, "", {0.0, 10.0});
}

double mobility(double height, double top, double rigidity) {
  if (!(rigidity > 0.0)) return 1.0;
  return top > 0.0 ? powerOf(saturate(height / top), rigidity) : 0.0;
}

double depthShare(const WarpSettings& settings, double distance, double last) {
  const double ratio = last > 0.0 ? distance / last : 0.0;
  if (settings.form == Formula::PRINTED) return (1.0 - ratio * ratio) * settings.depth_loss;
  return 1.0 - settings.depth_loss * ratio * ratio;
}

Vec3 displacement(const WarpSettings& settings, const Vec3& velocity, double share, double dt) {
  const double time = share * (settings.form == Formula::PRINTED ? dt : settings.reference_time);
  const Vec3& lambda = settings.lambda;
  return {time * (lambda.x() * velocity.x()),
          time * (lambda.y() * velocity.y() - lambda.z() * std::fabs(velocity.z())), 0.0};
}

Vec3 bent(const Vec3& arm, const Vec3& displacement) {
  const Vec3 there = arm + displacement;
  const double size = length(there);
  return size > 0.0 ? Vec3(there * (length(arm) / size) - arm) : displacement;
}

Vec3 twisted(const WarpSettings& settings, const Vec3& along, const Vec3& side,
             const Vec3& displacement) {
  const Vec3 face = cross(along, side);
  const double size = length(along), area = length(face);
  if (!(settings.twist > 0.0) || !(area > 0.0)) return side;
  const double tangent = settings.twist * dot(displacement, face) / (area * size);
  return (side + (tangent / size) * face) / std::sqrt(1.0 + tangent * tangent);
}

double limitFolding(LayerMotion& motion, double reach, double cell) {
  const int size = motion.plane.size;
  double steepest = 0.0;
  for (const std::vector<double>* part : {&motion.plane.u, &motion.plane.v}) {
    const Steepness steep = steepnessOf(*part, size);
    steepest = std::max(steepest, steep.right + steep.above);
  }
  steepest *= reach / cell;
  if (!(steepest > STEEPEST)) return 1.0;
  const double share = STEEPEST / steepest;
  for (std::vector<double>* part : {&motion.plane.u, &motion.plane.v}) weaken(*part, share);
  return share;
}

}  // namespace vegetation_sim::canopy
