// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/skeleton.h"

#include <algorithm>
#include <cmath>

#include "core/math/math_batch.h"
#include "core/math/noise.h"
#include "core/math/random_batch.h"
#include "tree/growth/limb_growth.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

// Rz(theta) Ry(phi) of sine and cosine of half the angles.
Quat restRotation(const SinCos& t, const SinCos& p) {
  return {t.cos * p.cos, -t.sin * p.sin, t.cos * p.sin, t.sin * p.cos};
}

// Numbers of the limbs of one depth, in their order.
struct GroupNumbers {
  explicit GroupNumbers(const std::vector<Limb>& limbs)
      : key(limbs.size()), azimuth(key), angle(key), left(key), right(key), index(key) {
    for (std::size_t l = 0; l < limbs.size(); ++l) {
      key[l] = limbs[l].key;
      azimuth[l] = limbs[l].azimuth;
      angle[l] = limbs[l].angle;
    }
    for (std::vector<double>* list :
         {&theta, &phi, &a, &b, &across, &up, &sin_theta, &cos_theta, &sin_phi, &cos_phi})
      list->resize(limbs.size());
  }
  std::size_t size() const { return key.size(); }

  std::vector<std::uint64_t> key, azimuth, angle, left, right, index;
  std::vector<double> theta, phi;  // rest turns [rad]
  std::vector<double> a, b;        // turn of the direction about the axes of the segment before
  std::vector<double> across, up;  // upwards in the frame of the segment before
  std::vector<double> sin_theta, cos_theta, sin_phi, cos_phi;  // of half the rest turns
};

class Grower {
 public:
  Grower(const TreeSeed& seed, const Species& species) : seed_(seed), species_(species) {}

  Skeleton grow() {
    std::size_t count = 0;
    const std::vector<std::vector<Limb>> limbs = growLimbs(seed_, species_, count);
    out_.branches.reserve(count);
    for (std::size_t depth = 0; depth < limbs.size(); ++depth)
      addBranches(limbs[depth], static_cast<int>(depth));
    if (!out_.branches.empty()) out_.trunk_radius = out_.branches.front().base_radius;
    out_.reach = std::sqrt(reach_squared_);
    return std::move(out_);
  }

 private:
  const LimbRule& rule(int depth) const { return species_.limbs[static_cast<std::size_t>(depth)]; }

  // Branch (limb l, segment s) of a depth gets index begin + s * limbs + l: groups by segment.
  void addBranches(const std::vector<Limb>& limbs, int depth) {
    const int begin = static_cast<int>(out_.branches.size());
    const int count = static_cast<int>(limbs.size()), segments = rule(depth).segments;
    const int bearer_begin = depth > 1 ? out_.depth_end[static_cast<std::size_t>(depth) - 2] : 0;
    out_.branches.resize(static_cast<std::size_t>(begin + count * segments));
    GroupNumbers numbers(limbs);
    for (int s = 0; s < segments; ++s) {
      const int first = begin + s * count;
      for (int l = 0; l < count; ++l) {
        Branch& branch = out_.branches[static_cast<std::size_t>(first + l)];
        const Limb& limb = limbs[static_cast<std::size_t>(l)];
        branch.depth = depth;
        branch.next = s + 1 < segments ? first + count + l : -1;
        if (s > 0)
          branch.parent = first - count + l;
        else if (depth > 0)
          branch.parent = bearer_begin + limb.segment * bearers_ + limb.bearer;
      }
      if (s == 0)
        leave(limbs, first, numbers);
      else
        proceed(depth, s, first, numbers);
      finish(limbs, depth, s, first, numbers);
      out_.groups.push_back({first, first + count, depth});
    }
    out_.depth_end.push_back(static_cast<int>(out_.branches.size()));
    bearers_ = count;
  }

  // Directions of the first segments.
  void leave(const std::vector<Limb>& limbs, int first, GroupNumbers& numbers) {
    for (std::size_t l = 0; l < limbs.size(); ++l) {
      Branch& branch = out_.branches[static_cast<std::size_t>(first) + l];
      branch.h = limbs[l].h;
      numbers.theta[l] = branch.theta = limbs[l].theta;
      numbers.phi[l] = branch.phi = limbs[l].phi;
    }
  }

  // Directions of segment s > 0: noise and tropism turn it away from the segment before.
  void proceed(int depth, int s, int first, GroupNumbers& numbers) {
    const LimbRule& r = rule(depth);
    const double step = species_.noise * r.wander / r.segments, turn = r.rise / r.segments;
    addNoise(step, 0.37 + 0.61 * s, numbers.azimuth, numbers, numbers.a);
    addNoise(step, 0.71 + 0.61 * s, numbers.angle, numbers, numbers.b);
    bendUpwards(turn, first, numbers);
    batchArcTangent(numbers.b.data(), numbers.a.data(), numbers.size(), numbers.theta.data());
    const double widest = largestAngle(species_, 1.0);
    for (std::size_t l = 0; l < numbers.size(); ++l) {
      Branch& branch = out_.branches[static_cast<std::size_t>(first) + l];
      const Branch& before = out_.branches[static_cast<std::size_t>(branch.parent)];
      const double a = numbers.a[l], b = numbers.b[l];
      branch.h = before.length;
      branch.theta = numbers.theta[l];
      branch.phi = numbers.phi[l] = std::min(std::sqrt(a * a + b * b), widest);
      branch.roll = before.roll - branch.theta;
    }
  }

  // Sets `out` to gradientNoise(seeds, x), which has amplitude `step`.
  static void addNoise(double step, double x, const std::vector<std::uint64_t>& seeds,
                       GroupNumbers& numbers, std::vector<double>& out) {
    const double cell = std::floor(x), u = x - cell;
    const auto index = static_cast<std::uint64_t>(cell);
    drawBits(seeds.data(), seeds.size(), index, numbers.left.data());
    drawBits(seeds.data(), seeds.size(), index + 1, numbers.right.data());
    for (std::size_t l = 0; l < seeds.size(); ++l)
      out[l] = step * 2.0 *
               gradientNoise(-1.0 + 2.0 * Random::uniformOf(numbers.left[l]),
                             -1.0 + 2.0 * Random::uniformOf(numbers.right[l]), u);
  }

  // Adds the tropism of one segment, which ends when the limb points upwards or downwards.
  void bendUpwards(double turn, int first, GroupNumbers& numbers) {
    for (std::size_t l = 0; l < numbers.size(); ++l) {
      const Branch& branch = out_.branches[static_cast<std::size_t>(first) + l];
      const Quat& q = out_.branches[static_cast<std::size_t>(branch.parent)].rest.orientation;
      const double x = axisX(q).z(), y = axisY(q).z();
      numbers.across[l] = std::sqrt(x * x + y * y);
      numbers.up[l] = axisZ(q).z();
    }
    std::vector<double>& left = numbers.phi;  // for now
    batchArcTangent(numbers.across.data(), numbers.up.data(), numbers.size(), left.data());
    for (std::size_t l = 0; l < numbers.size(); ++l) {
      const double across = numbers.across[l];
      if (!(across > 1e-9)) continue;
      const Branch& branch = out_.branches[static_cast<std::size_t>(first) + l];
      const Quat& q = out_.branches[static_cast<std::size_t>(branch.parent)].rest.orientation;
      const double bend = turn > 0.0 ? std::min(turn, left[l]) : std::max(turn, left[l] - PI);
      numbers.a[l] += bend * axisX(q).z() / across;
      numbers.b[l] += bend * axisY(q).z() / across;
    }
  }

  // Sets the rest rotations and all that does not depend on directions.
  void finish(const std::vector<Limb>& limbs, int depth, int s, int first, GroupNumbers& numbers) {
    const std::size_t count = numbers.size();
    std::fill(numbers.index.begin(), numbers.index.end(), static_cast<std::uint64_t>(s));
    drawChildren(numbers.key.data(), numbers.index.data(), count, numbers.left.data());
    for (double& angle : numbers.theta) angle *= 0.5;
    for (double& angle : numbers.phi) angle *= 0.5;
    batchSinCos(numbers.theta.data(), count, numbers.sin_theta.data(), numbers.cos_theta.data());
    batchSinCos(numbers.phi.data(), count, numbers.sin_phi.data(), numbers.cos_phi.data());
    const int segments = rule(depth).segments;
    const double from = static_cast<double>(s) / segments, to = (s + 1.0) / segments;
    for (std::size_t l = 0; l < count; ++l) {
      const Limb& limb = limbs[l];
      Branch& branch = out_.branches[static_cast<std::size_t>(first) + l];
      branch.length = limb.length / segments;
      branch.base_radius = radiusAt(limb, from);
      branch.tip_radius = radiusAt(limb, to);
      branch.leaves = limb.leaves * (s + 1) / segments - limb.leaves * s / segments;
      branch.key = numbers.left[l];
      branch.turn = restRotation({numbers.sin_theta[l], numbers.cos_theta[l]},
                                 {numbers.sin_phi[l], numbers.cos_phi[l]});
      place(branch);
    }
  }

  void place(Branch& branch) {
    if (branch.parent < 0) {
      branch.rest.orientation = branch.turn;
    } else {
      const Pose& parent = out_.branches[static_cast<std::size_t>(branch.parent)].rest;
      branch.rest.orientation = parent.orientation * branch.turn;
      branch.rest.position = parent.position + branch.h * axisZ(parent.orientation);
    }
    const Vec3 tip = tipOf(branch, branch.rest);
    out_.height = std::max(out_.height, tip.z());
    reach_squared_ = std::max(reach_squared_, tip.x() * tip.x() + tip.y() * tip.y());
  }

  const TreeSeed& seed_;
  const Species& species_;
  Skeleton out_;
  double reach_squared_{0.0};
  int bearers_{0};  // limbs of the depth added last
};

}  // namespace

Quat restRotation(double theta, double phi) {
  return restRotation(sinCos(0.5 * theta), sinCos(0.5 * phi));
}

Vec3 tipOf(const Branch& branch, const Pose& pose) {
  return pose.position + branch.length * axisZ(pose.orientation);
}

Skeleton grow(const TreeSeed& seed, const Species& species) {
  return Grower(seed, species).grow();
}

std::size_t countBranches(const TreeSeed& seed, const Species& species) {
  std::size_t out = 0;
  growLimbs(seed, species, out);
  return out;
}

std::uint64_t Skeleton::hash() const {
  Hash out;
  for (const Branch& b : branches) {
    out.add(static_cast<std::uint64_t>(static_cast<std::int64_t>(b.parent)));
    out.add(b.h);
    out.add(b.theta);
    out.add(b.phi);
    out.add(b.length);
    out.add(b.base_radius);
    out.add(b.rest.position);
    out.add(static_cast<std::uint64_t>(b.leaves));
  }
  return out.value();
}

}  // namespace vegetation_sim::forest
