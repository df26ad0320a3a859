// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread/cutter.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::grass {
namespace {

constexpr double LARGEST_TURN = 0.1;  // of a step [rad]

double crossOf(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

// Returns the convex hull of points, counter-clockwise (Andrew's monotone chain).
std::vector<Point> hullOf(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> out;
  const auto append = [&](const Point& p, std::size_t least) {
    while (out.size() >= least) {
      const Point &a = out[out.size() - 2], &b = out.back();
      if (crossOf({b.x - a.x, b.y - a.y}, {p.x - b.x, p.y - b.y}) > 0.0) break;
      out.pop_back();
    }
    out.push_back(p);
  };
  for (const Point& p : points) append(p, 2);
  const std::size_t lower = out.size() + 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) append(points[i], lower);
  out.pop_back();
  return out;
}

// Adds the corners of a box with ranges along and across the heading.
void addBox(const CutterPose& pose, const Range& along, double half_width,
            std::vector<Point>& out) {
  const Point h = pose.heading;
  for (const double forward : {along.low, along.high})
    for (const double left : {-half_width, half_width})
      out.push_back({pose.position.x + forward * h.x - left * h.y,
                     pose.position.y + forward * h.y + left * h.x});
}

CutterPose between(const CutterPose& a, const CutterPose& b, double part) {
  const auto mix = [part](double from, double to) { return from + part * (to - from); };
  const Point h{mix(a.heading.x, b.heading.x), mix(a.heading.y, b.heading.y)};
  const double size = distanceBetween({}, h);
  return {{mix(a.position.x, b.position.x), mix(a.position.y, b.position.y)},
          {h.x / size, h.y / size}};
}

// Returns the convex area that covers the footprints at both poses.
CutArea areaOf(const Cutter& cutter, const CutterPose& from, const CutterPose& to) {
  const bool is_disc = cutter.shape == CutterShape::DISC;
  const double length = is_disc ? cutter.width : cutter.length;
  CutArea out;
  out.height = cutter.height;
  std::vector<Point> swath;
  for (const CutterPose& pose : {from, to}) {
    if (is_disc)
      out.outline.push_back(pose.position);
    else
      addBox(pose, {-0.5 * length, 0.5 * length}, 0.5 * cutter.width, out.outline);
    addBox(pose, {-1.5 * length, -0.5 * length}, 0.5 * cutter.swath_width, swath);
  }
  if (is_disc)
    out.radius = 0.5 * cutter.width;
  else
    out.outline = hullOf(std::move(out.outline));
  if (cutter.swath_width > 0.0) out.swath = hullOf(std::move(swath));
  return out;
}

}  // namespace

void describe(FieldVisitor& v, Cutter& c) {
  v.choice("shape", c.shape, {"box", "disc"});
  v.number("width", c.width, "m", {0.01, 20.0});
  v.number("length", c.length, "m", {0.01, 20.0});
  v.number("height", c.height, "m", {0.0, 5.0});
  v.number("swath_width", c.swath_width, "m", {0.0, 20.0});
}

CutArea footprintOf(const Cutter& cutter, const CutterPose& pose) {
  return areaOf(cutter, pose, pose);
}

std::vector<CutArea> sweep(const Cutter& cutter, const CutterPose& from, const CutterPose& to) {
  const Point &a = from.heading, &b = to.heading;
  if (!(a.x * b.x + a.y * b.y > 0.0)) return {footprintOf(cutter, to)};
  // The angle is at most pi / 2 times its sine.
  const int steps = 1 + static_cast<int>(1.5708 * std::fabs(crossOf(a, b)) / LARGEST_TURN);
  std::vector<CutArea> out;
  CutterPose last = from;
  for (int i = 1; i <= steps; ++i) {
    const CutterPose next = i == steps ? to : between(from, to, static_cast<double>(i) / steps);
    out.push_back(areaOf(cutter, last, next));
    last = next;
  }
  return out;
}

}  // namespace vegetation_sim::grass
