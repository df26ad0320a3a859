// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/knife.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tree/physical/influence.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr double LARGEST_TURN = 0.1;  // of a straight step [rad]
constexpr double JUMP = 1.5;          // A larger turn has no way [rad].
constexpr int SEARCHES = 32;          // steps of golden section; finds a place to 2e-7 of a range
constexpr double GOLDEN = 0.61803398874989485;

// A ball that holds a knife on its way.
struct KnifeBall {
  Vec3 centre;
  double radius;
};

KnifeBall ballOf(const Knife& knife) {
  const double size =
      knife.is_disc ? 0.5 * knife.width : 0.5 * length(Vec3(knife.length, knife.width, 0.0));
  return {0.5 * (knife.from.position + knife.to.position),
          size + Knife::THICKNESS + 0.5 * length(knife.to.position - knife.from.position)};
}

// A tapered part of a branch.
struct Rod {
  Vec3 base, tip;
  double base_radius, tip_radius;
};

// Cuts off the part of a rod that is too thick. @return false if nothing is left.
bool keepThinPart(double thickest, Rod& rod) {
  const double taper = rod.tip_radius - rod.base_radius;
  const bool thick_base = rod.base_radius > thickest, thick_tip = rod.tip_radius > thickest;
  if (thick_base && thick_tip) return false;
  if (!thick_base && !thick_tip) return true;
  const Vec3 limit = rod.base + (thickest - rod.base_radius) / taper * (rod.tip - rod.base);
  (thick_base ? rod.base : rod.tip) = limit;
  (thick_base ? rod.base_radius : rod.tip_radius) = thickest;
  return true;
}

bool isInBall(const KnifeBall& ball, const Rod& rod) {
  const Vec3 axis = rod.tip - rod.base, offset = ball.centre - rod.base;
  const double square = dot(axis, axis);
  const double part = square > 0.0 ? std::clamp(dot(offset, axis) / square, 0.0, 1.0) : 0.0;
  return length(offset - part * axis) <= ball.radius + std::max(rod.base_radius, rod.tip_radius);
}

// Returns the distance of a point (axes of the plate) from the plate, whose edges are round.
double distanceTo(const Knife& knife, const Vec3& p) {
  constexpr double EDGE = 0.5 * Knife::THICKNESS;
  const auto beyond = [](double at, double size) {
    return std::max(0.0, std::fabs(at) - std::max(0.0, 0.5 * size - EDGE));
  };
  const Vec3 out =
      knife.is_disc
          ? Vec3(beyond(std::sqrt(p.x() * p.x() + p.y() * p.y()), knife.width), 0.0, p.z())
          : Vec3(beyond(p.x(), knife.length), beyond(p.y(), knife.width), p.z());
  return length(out) - EDGE;
}

// Returns the smallest value of a convex function from 0 to 1, or one that is not positive.
template <class Function>
double smallest(const Function& f) {
  double low = 0.0, high = 1.0, a = high - GOLDEN, b = low + GOLDEN, at_a = f(a), at_b = f(b);
  double least = std::min(std::min(f(low), f(high)), std::min(at_a, at_b));
  for (int i = 0; i < SEARCHES && least > 0.0; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - GOLDEN * (high - low);
      at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + GOLDEN * (high - low);
      at_b = f(b);
    }
    least = std::min(least, std::min(at_a, at_b));
  }
  return least;
}

Vec3 inAxesOf(const Pose& pose, const Vec3& point) {
  return rotate(conjugate(pose.orientation), point - pose.position);
}

// Returns whether a rod meets the plate on a way without a turn or with a small one, on which the
// ends of the rod go straight in the axes of the plate.
bool meets(const Knife& knife, const Pose& from, const Pose& to, const Rod& rod) {
  const Vec3 base = inAxesOf(from, rod.base), tip = inAxesOf(from, rod.tip);
  const Vec3 base_way = inAxesOf(to, rod.base) - base, tip_way = inAxesOf(to, rod.tip) - tip;
  const auto gapAt = [&](double time) {
    const Vec3 b = base + time * base_way, t = tip + time * tip_way;
    return smallest([&](double part) {
      const double radius = rod.base_radius + part * (rod.tip_radius - rod.base_radius);
      return distanceTo(knife, b + part * (t - b)) - radius;
    });
  };
  // No point comes nearer than by its way.
  const double reach = 0.5 * std::max(length(base_way), length(tip_way));
  const double middle = gapAt(0.5);
  if (middle <= 0.0 || middle > reach) return middle <= 0.0;
  return smallest(gapAt) <= 0.0;
}

double angleBetween(const Quat& a, const Quat& b) {
  const Quat turn = conjugate(a) * b;
  return 2.0 * arcTangent(length(Vec3(turn.x, turn.y, turn.z)), std::fabs(turn.w));
}

Pose between(const Pose& a, const Pose& b, double part) {
  Quat q = b.orientation;
  const Quat& p = a.orientation;
  if (p.w * q.w + p.x * q.x + p.y * q.y + p.z * q.z < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
  const auto mix = [part](double from, double to) { return from + part * (to - from); };
  return {a.position + part * (b.position - a.position),
          normalized({mix(p.w, q.w), mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z)})};
}

bool cuts(const Knife& knife, const KnifeBall& ball, Rod rod) {
  if (!keepThinPart(knife.thickest, rod) || !isInBall(ball, rod)) return false;
  const double turn = angleBetween(knife.from.orientation, knife.to.orientation);
  if (turn > JUMP) return meets(knife, knife.to, knife.to, rod);
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / LARGEST_TURN)));
  Pose last = knife.from;
  for (int i = 1; i <= steps; ++i) {
    const Pose next =
        i == steps ? knife.to : between(knife.from, knife.to, static_cast<double>(i) / steps);
    if (meets(knife, last, next, rod)) return true;
    last = next;
  }
  return false;
}

}  // namespace

std::vector<int> findCuts(const Tree& tree, const std::vector<Pose>& poses,
                          const std::vector<Knife>& knives) {
  std::vector<KnifeBall> balls;
  for (const Knife& knife : knives) balls.push_back(ballOf(knife));
  const std::vector<Branch>& branches = tree.skeleton.branches;
  std::vector<char> gone(branches.size(), 0);
  std::vector<int> out;
  for (std::size_t i = 1; i < branches.size(); ++i) {
    const Branch& branch = branches[i];
    gone[i] = branch.broken || gone[index(branch.parent)];
    if (gone[i]) continue;
    const Vec3 base = tree.foot + poses[i].position;
    const Rod rod{base, base + branch.length * axisZ(poses[i].orientation), branch.base_radius,
                  branch.tip_radius};
    for (std::size_t k = 0; k < knives.size() && !gone[i]; ++k)
      gone[i] = cuts(knives[k], balls[k], rod);
    if (gone[i]) out.push_back(static_cast<int>(i));
  }
  return out;
}

std::vector<BranchCut> findCuts(const Layout& layout, const TreeGrid& grid,
                                const terrain::HeightMap& terrain, const std::vector<Knife>& knives,
                                const TreePoser& trees) {
  std::map<std::uint32_t, std::vector<Knife>> near;
  for (const Knife& knife : knives) {
    const KnifeBall ball = ballOf(knife);
    for (const std::uint32_t id : findTreesNear(layout, &grid, terrain, ball.centre, ball.radius))
      near[id].push_back(knife);
  }
  std::vector<BranchCut> out;
  for (const auto& [id, around] : near) {
    const std::shared_ptr<const Tree> tree = trees.grow(id);
    for (const int branch : findCuts(*tree, trees.pose(*tree, id), around))
      out.push_back({id, branch});
  }
  return out;
}

}  // namespace vegetation_sim::forest
