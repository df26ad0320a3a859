// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/skeleton.h"

#include <algorithm>
#include <cmath>

#include "core/math/noise.h"
#include "tree/growth/golden_angle.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

enum BranchDraw : std::uint64_t { LENGTH, PLACE, AZIMUTH, ANGLE, COUNT, LEAVES, LEAN, TREE };

struct Limb {
  int bearer{-1};  // index among the limbs one depth below
  int segment{0};  // segment of the parent
  double h{0.0};   // along that segment
  double theta{0.0}, phi{0.0};
  double length{0.0}, base_radius{0.0}, tip_radius{0.0};
  int leaves{0};
  std::uint64_t key{0};
};

double crownFactor(Crown crown, double f) {
  switch (crown) {
    case Crown::CONICAL:
      return 1.0 - 0.88 * f;
    case Crown::ROUND:
      return 0.35 + 0.65 * 4.0 * f * (1.0 - f);
    case Crown::FLAME:
      return f < 0.3 ? 0.5 + f / 0.6 : 1.0 - 0.9 * (f - 0.3) / 0.7;
    case Crown::EVEN:
      break;
  }
  return 1.0 - 0.25 * f;
}

double radiusAt(const Limb& limb, double f) {
  return limb.base_radius + (limb.tip_radius - limb.base_radius) * f;
}

// Returns a value in [-1, 1] times the species' noise; 0 leaves the bare rules (S1-12).
double vary(const Species& species, const Random& random, BranchDraw draw) {
  return std::min(1.0, species.noise) * random.uniform(draw, -1.0, 1.0);
}

class Grower {
 public:
  Grower(const TreeSeed& seed, const Species& species) : seed_(seed), species_(species) {}

  Skeleton grow() {
    std::size_t count = 0;
    const std::vector<std::vector<Limb>> limbs = sproutAll(count);
    out_.branches.reserve(count);
    for (std::size_t depth = 0; depth < limbs.size(); ++depth)
      addBranches(limbs[depth], static_cast<int>(depth));
    measure();
    return std::move(out_);
  }

  std::size_t count() const {
    std::size_t out = 0;
    sproutAll(out);
    return out;
  }

 private:
  // Returns the limbs of each depth, and the number of their branches.
  std::vector<std::vector<Limb>> sproutAll(std::size_t& count) const {
    std::vector<std::vector<Limb>> limbs{{trunk()}};
    for (int depth = 0; depth < species_.depths() && !limbs.back().empty(); ++depth) {
      count += limbs.back().size() * static_cast<std::size_t>(rule(depth).segments);
      if (depth + 1 < species_.depths()) limbs.push_back(sprout(limbs.back(), depth, count));
    }
    if (limbs.back().empty()) limbs.pop_back();
    return limbs;
  }
  const LimbRule& rule(int depth) const { return species_.limbs[static_cast<std::size_t>(depth)]; }

  double vary(const Random& random, BranchDraw draw) const {
    return forest::vary(species_, random, draw);
  }

  Limb trunk() const {
    const Random random = Random(seed_.seed).child(TREE);
    Limb out;
    const double size = trunkScale(seed_, species_);
    out.length = species_.height * size;
    out.base_radius = species_.trunk_radius * size;
    out.tip_radius = out.base_radius * rule(0).taper;
    out.theta = seed_.yaw + species_.turn * vary(random, AZIMUTH);
    out.phi = std::min(largestAngle(species_, 1.0), species_.lean * std::fabs(vary(random, LEAN)));
    out.leaves = leavesOf(random, 0);
    out.key = random.key();
    return out;
  }
  int leavesOf(const Random& limb, int depth) const {
    return static_cast<int>(rule(depth).leaves + 0.5 + 0.5 * vary(limb, LEAVES));
  }

  // Adds the limbs of the next depth, grouped by parent. `grown` is the number of branches so far.
  std::vector<Limb> sprout(const std::vector<Limb>& bearers, int depth, std::size_t grown) const {
    std::vector<Limb> out;
    const LimbRule& next = rule(depth + 1);
    const auto room = static_cast<std::size_t>(std::max(0, MAX_BRANCHES - static_cast<int>(grown)) /
                                               next.segments);
    for (std::size_t b = 0; b < bearers.size(); ++b) {
      const Random random = Random(bearers[b].key);
      const double wanted = next.children * (1.0 + 0.2 * vary(random, COUNT));
      const int count = static_cast<int>(wanted + 0.5 + 0.5 * vary(random, PLACE));
      for (int i = 0; i < count && out.size() < room; ++i)
        out.push_back(lateral(bearers[b], static_cast<int>(b), depth + 1, i, count));
    }
    return out;
  }

  Limb lateral(const Limb& bearer, int bearer_index, int depth, int i, int count) const {
    const LimbRule& r = rule(depth);
    const Random random = Random(bearer.key).child(static_cast<std::uint64_t>(i) + 16);
    const int whorls = (count + r.whorl - 1) / r.whorl, turn = i / r.whorl;
    const double place = (turn + 0.5 + 0.25 * vary(random, PLACE)) / whorls;
    const double f = std::min(r.start + (r.end - r.start) * place, 0.999);
    Limb out;
    out.bearer = bearer_index;
    const double along = f * rule(depth - 1).segments;
    out.segment = static_cast<int>(along);
    out.h = (along - out.segment) * bearer.length / rule(depth - 1).segments;
    out.length = bearer.length * r.length * crownFactor(r.crown, place) *
                 (1.0 + r.length_variation * vary(random, LENGTH));
    const double bearer_radius = radiusAt(bearer, f);
    out.base_radius = std::max(bearer_radius * r.radius, species_.twig_radius);
    out.tip_radius = std::max(out.base_radius * r.taper, species_.twig_radius);
    out.length = std::min(out.length, species_.slenderness * out.base_radius);
    const double spread = 2.0 * PI * (i % r.whorl) / r.whorl;
    out.theta = turn * GOLDEN_ANGLE + spread + 0.3 * vary(random, AZIMUTH);
    const double angle = r.angle_low + (r.angle_high - r.angle_low) * place +
                         r.angle_variation * vary(random, ANGLE);
    const double widest = largestAngle(species_, out.base_radius / bearer_radius);
    out.phi = std::max(0.0, std::min(angle, widest));
    out.leaves = leavesOf(random, depth);
    out.key = random.key();
    return out;
  }

  // Branch (limb l, segment s) of a depth gets index begin + s * limbs + l: groups by segment.
  void addBranches(const std::vector<Limb>& limbs, int depth) {
    const int begin = static_cast<int>(out_.branches.size());
    const int count = static_cast<int>(limbs.size()), segments = rule(depth).segments;
    const int bearer_begin = depth > 1 ? out_.depth_end[static_cast<std::size_t>(depth) - 2] : 0;
    out_.branches.resize(static_cast<std::size_t>(begin + count * segments));
    for (int s = 0; s < segments; ++s) {
      for (int l = 0; l < count; ++l) {
        Branch& branch = out_.branches[static_cast<std::size_t>(begin + s * count + l)];
        const Limb& limb = limbs[static_cast<std::size_t>(l)];
        branch.depth = depth;
        branch.next = s + 1 < segments ? begin + (s + 1) * count + l : -1;
        if (s > 0) {
          branch.parent = begin + (s - 1) * count + l;
          proceed(limb, s, branch);
        } else {
          if (depth > 0) branch.parent = bearer_begin + limb.segment * bearers_ + limb.bearer;
          branch.h = limb.h;
          branch.theta = limb.theta;
          branch.phi = limb.phi;
        }
        finish(limb, s, branch);
      }
      out_.groups.push_back({begin + s * count, begin + (s + 1) * count, depth});
    }
    out_.depth_end.push_back(static_cast<int>(out_.branches.size()));
    bearers_ = count;
  }

  // Direction of segment s > 0: noise and tropism turn it away from the segment before.
  void proceed(const Limb& limb, int s, Branch& branch) const {
    const Branch& before = out_.branches[static_cast<std::size_t>(branch.parent)];
    const LimbRule& r = rule(before.depth);
    branch.h = before.length;
    const double step = species_.noise * r.wander / r.segments;
    const Random random(limb.key);
    double a = step * 2.0 * gradientNoise(random.bits(AZIMUTH), 0.37 + 0.61 * s);
    double b = step * 2.0 * gradientNoise(random.bits(ANGLE), 0.71 + 0.61 * s);
    const Vec3 up(
        axisX(before.rest.orientation).z(), axisY(before.rest.orientation).z(),
        axisZ(before.rest.orientation).z());  // upwards in the frame of the segment before
    const double across = std::sqrt(up.x() * up.x() + up.y() * up.y());
    if (across > 1e-9) {
      const double turn = r.rise / r.segments, left = arcTangent(across, up.z());
      const double bend = turn > 0.0 ? std::min(turn, left) : std::max(turn, left - PI);
      a += bend * up.x() / across;
      b += bend * up.y() / across;
    }
    branch.theta = arcTangent(b, a);
    branch.phi = std::min(std::sqrt(a * a + b * b), largestAngle(species_, 1.0));
    branch.roll = before.roll - branch.theta;
  }

  void finish(const Limb& limb, int s, Branch& branch) const {
    const LimbRule& r = rule(branch.depth);
    branch.length = limb.length / r.segments;
    branch.base_radius = radiusAt(limb, static_cast<double>(s) / r.segments);
    branch.tip_radius = radiusAt(limb, (s + 1.0) / r.segments);
    branch.leaves = limb.leaves * (s + 1) / r.segments - limb.leaves * s / r.segments;
    branch.key = Random(limb.key).child(static_cast<std::uint64_t>(s)).key();
    branch.turn = restRotation(branch.theta, branch.phi);
    if (branch.parent < 0) {
      branch.rest.orientation = branch.turn;
      return;
    }
    const Pose& parent = out_.branches[static_cast<std::size_t>(branch.parent)].rest;
    branch.rest.orientation = parent.orientation * branch.turn;
    branch.rest.position = parent.position + branch.h * axisZ(parent.orientation);
  }

  void measure() {
    if (!out_.branches.empty()) out_.trunk_radius = out_.branches.front().base_radius;
    for (const Branch& branch : out_.branches) {
      const Vec3 tip = tipOf(branch, branch.rest);
      out_.height = std::max(out_.height, tip.z());
      out_.reach = std::max(out_.reach, std::sqrt(tip.x() * tip.x() + tip.y() * tip.y()));
    }
  }

  const TreeSeed& seed_;
  const Species& species_;
  Skeleton out_;
  int bearers_{0};  // limbs of the depth added last
};

}  // namespace

Quat restRotation(double theta, double phi) {
  const SinCos t = sinCos(0.5 * theta), p = sinCos(0.5 * phi);
  return {t.cos * p.cos, -t.sin * p.sin, t.cos * p.sin, t.sin * p.cos};
}

Vec3 tipOf(const Branch& branch, const Pose& pose) {
  return pose.position + branch.length * axisZ(pose.orientation);
}

double trunkScale(const TreeSeed& seed, const Species& species) {
  const double change = vary(species, Random(seed.seed).child(TREE), LENGTH);
  return seed.scale * (1.0 + species.height_variation * change);
}

Skeleton grow(const TreeSeed& seed, const Species& species) {
  return Grower(seed, species).grow();
}

std::size_t countBranches(const TreeSeed& seed, const Species& species) {
  return Grower(seed, species).count();
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
