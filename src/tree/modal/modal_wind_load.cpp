// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/modal/modal_wind_load.h"

#include <algorithm>
#include <numeric>

#include "core/math/vector_sums.h"
#include "tree/modal/modal_load.h"

namespace vegetation_sim::forest {
namespace {

using Range = WindLoadPoint*;

int longestAxis(Range begin, Range end) {
  Vec3 low = begin->centre, high = begin->centre;
  for (Range i = begin; i != end; ++i) {
    low = low.cwiseMin(i->centre);
    high = high.cwiseMax(i->centre);
  }
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (high[other] - low[other] > high[axis] - low[axis]) axis = other;
  return axis;
}

// Bisects a range into halves of equal drag, recursively.
void divide(Range begin, Range end, int bisection, std::vector<std::pair<Range, Range>>& out) {
  if (bisection == 0 || end - begin < 2) {
    if (begin != end) out.emplace_back(begin, end);
    return;
  }
  const int axis = longestAxis(begin, end);
  std::stable_sort(begin, end, [axis](const WindLoadPoint& a, const WindLoadPoint& b) {
    return a.centre[axis] < b.centre[axis];
  });
  const auto add = [](double sum, const WindLoadPoint& load_point) {
    return sum + load_point.drag;
  };
  const double all = std::accumulate(begin, end, 0.0, add);
  Range middle = begin + 1;  // neither half is empty
  for (double sum = begin->drag; middle + 1 != end && sum + 0.5 * middle->drag < 0.5 * all;
       ++middle)
    sum += middle->drag;
  divide(begin, middle, bisection - 1, out);
  divide(middle, end, bisection - 1, out);
}

WindPoint pointOf(Range begin, Range end) {
  WindPoint out;
  for (Range load_point = begin; load_point != end; ++load_point) {
    out.drag += load_point->drag;
    out.position += load_point->drag * load_point->centre;
  }
  out.position /= out.drag;
  return out;
}

// Adds [3][row] modal loads per wind velocity on a range.
void appendPush(const WindLoadPoint* begin, const WindLoadPoint* end, const Motions& motions,
                std::vector<double>& out) {
  const std::size_t row = modalRow(motions.size());
  const std::size_t start = out.size();
  out.resize(start + 3 * row, 0.0);
  for (std::size_t m = 0; m < motions.size(); ++m) {
    Vec3 sum = Vec3::Zero();
    for (const WindLoadPoint* load_point = begin; load_point != end; ++load_point)
      sum += load_point->drag * wayOf(*load_point, motions[m]);
    for (int axis = 0; axis < 3; ++axis)
      out[start + static_cast<std::size_t>(axis) * row + m] = sum[axis];
  }
}

// Drag of a sub-tree, and drag times its arms from the joint.
struct Held {
  double drag{0.0};
  Vec3 moment{Vec3::Zero()};
};

std::vector<Held> heldOf(const std::vector<physics::Link>& links, const std::vector<Pose>& rest,
                         const std::vector<WindLoadPoint>& load_points) {
  std::vector<Held> out(links.size());
  for (const WindLoadPoint& load_point : load_points)
    out[load_point.branch] = {load_point.drag, load_point.drag * load_point.arm};
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].parent < 0) continue;
    const auto p = static_cast<std::size_t>(links[i].parent);
    out[p].drag += out[i].drag;
    out[p].moment += out[i].moment + out[i].drag * (rest[i].position - rest[p].position);
  }
  return out;
}

// Returns the change of moments per amplitude of a motion.
std::vector<Vec3> momentChange(const std::vector<physics::Link>& links,
                               const std::vector<Held>& held,
                               const std::vector<WindLoadPoint>& load_points,
                               const std::vector<physics::SmallMotion>& motion) {
  std::vector<Vec3> out(links.size(), Vec3::Zero());
  for (const WindLoadPoint& load_point : load_points)
    out[load_point.branch] =
        load_point.drag * cross(motion[load_point.branch].turn, load_point.arm);
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].parent < 0) continue;
    const auto p = static_cast<std::size_t>(links[i].parent);
    out[p] += out[i] + held[i].drag * (motion[i].move - motion[p].move);
  }
  return out;
}

// The torque about an axis per wind velocity v is (axis x moment) . v. The axis of a bend rotates
// with the parents of the joint and half as far as the joint itself (a rotation vector).
void torqueChange(const std::vector<physics::Link>& links, const std::vector<Pose>& rest,
                  const std::vector<Held>& held, const std::vector<Vec3>& change,
                  const std::vector<physics::SmallMotion>& motion,
                  std::array<std::vector<double>, 3>& out) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    Vec3 turn = motion[i].turn;
    if (links[i].parent >= 0)
      turn = 0.5 * (turn + motion[static_cast<std::size_t>(links[i].parent)].turn);
    else
      turn *= 0.5;
    const Vec3 axes[] = {axisX(rest[i].orientation), axisY(rest[i].orientation)};
    for (std::size_t bend = 0; bend < 2; ++bend) {
      const Vec3 sum =
          cross(cross(turn, axes[bend]), held[i].moment) + cross(axes[bend], change[i]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        out[axis][2 * i + bend] = sum[static_cast<int>(axis)];
    }
  }
}

}  // namespace

std::vector<WindLoadPoint> windLoadPoints(const Skeleton& skeleton, const Wood& wood) {
  std::vector<WindLoadPoint> out;
  for (std::size_t i = 0; i < skeleton.branches.size(); ++i) {
    const Composite& body = wood.own[i];
    if (body.drag <= 0.0) continue;
    const Pose& rest = skeleton.branches[i].rest;
    const Vec3 arm = rotate(rest.orientation, Vec3(body.drag_moment / body.drag));
    out.push_back({i, body.drag, arm, rest.position + arm});
  }
  return out;
}

Vec3 wayOf(const WindLoadPoint& load_point, const std::vector<physics::SmallMotion>& motion) {
  const physics::SmallMotion& link = motion[load_point.branch];
  return link.move + cross(link.turn, load_point.arm);
}

std::vector<double> uniformLoad(const physics::LinearChain& chain,
                                const std::vector<WindLoadPoint>& load_points,
                                const Vec3& direction) {
  std::vector<physics::Wrench> wrenches(chain.size() / 2);
  for (const WindLoadPoint& load_point : load_points) {
    const Vec3 force = load_point.drag * direction;
    wrenches[load_point.branch] = {force, cross(load_point.arm, force)};
  }
  return chain.torquesOf(wrenches);
}

std::vector<double> uniformWindLoad(const std::vector<WindLoadPoint>& load_points,
                                    const Motions& motions) {
  std::vector<double> out;
  appendPush(load_points.data(), load_points.data() + load_points.size(), motions, out);
  return out;
}

WindPoints pointsOf(std::vector<WindLoadPoint>& load_points, const Motions& motions,
                    int bisection) {
  std::vector<std::pair<Range, Range>> parts;
  divide(load_points.data(), load_points.data() + load_points.size(), bisection, parts);
  WindPoints out;
  for (const auto& [begin, end] : parts) {
    out.at.push_back(pointOf(begin, end));
    appendPush(begin, end, motions, out.push);
  }
  return out;
}

std::vector<double> leverArmChange(const std::vector<physics::Link>& links,
                                   const physics::LinearChain& chain, const physics::Modes& modes,
                                   const std::vector<WindLoadPoint>& load_points,
                                   const Motions& motions) {
  const std::size_t count = modes.size(), row = modalRow(count);
  const std::vector<Held> held = heldOf(links, chain.rest(), load_points);
  std::array<std::vector<double>, 3> torque;
  torque.fill(std::vector<double>(modes.length));
  std::vector<double> out(3 * row * count, 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    torqueChange(links, chain.rest(), held, momentChange(links, held, load_points, motions[n]),
                 motions[n], torque);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t m = 0; m <= n; ++m)
        out[(3 * n + axis) * row + m] = out[(3 * m + axis) * row + n] =
            physics::dotOf(modes.shapeOf(m), torque[axis].data(), modes.length);
  }
  return out;
}

}  // namespace vegetation_sim::forest
