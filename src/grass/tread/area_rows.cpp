// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread/area_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegetation_sim::grass {
namespace {

using Ranges = std::vector<std::pair<double, double>>;

// Extends a range by where the line meets an edge. An edge contains its lower end only.
void addCrossing(double y, const Point& a, const Point& b, std::vector<double>& out) {
  if ((a.y > y) == (b.y > y)) return;
  out.push_back(a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y));
}

void addInside(double y, const std::vector<Point>& outline, Ranges& out) {
  std::vector<double> crossings;
  for (std::size_t i = 0; i < outline.size(); ++i)
    addCrossing(y, outline[i], outline[(i + 1) % outline.size()], crossings);
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    out.push_back({crossings[i], crossings[i + 1]});
}

// Adds the part of the line within `radius` of a segment: it meets a capsule, which is convex.
void addCapsule(double y, const Point& a, const Point& b, double radius, Ranges& out) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto widen = [&](double from, double to) {
    low = std::min(low, from);
    high = std::max(high, to);
  };
  for (const Point& end : {a, b}) {
    const double square = radius * radius - (y - end.y) * (y - end.y);
    if (square < 0.0) continue;
    const double half = std::sqrt(square);
    widen(end.x - half, end.x + half);
  }
  const double length = distanceBetween(a, b);
  if (length > 0.0) {
    const double x = -(b.y - a.y) * radius / length, z = (b.x - a.x) * radius / length;
    const Point corners[] = {
        {a.x + x, a.y + z}, {b.x + x, b.y + z}, {b.x - x, b.y - z}, {a.x - x, a.y - z}};
    std::vector<double> crossings;
    for (std::size_t i = 0; i < 4; ++i) addCrossing(y, corners[i], corners[(i + 1) % 4], crossings);
    for (const double crossing : crossings) widen(crossing, crossing);
  }
  if (low <= high) out.push_back({low, high});
}

}  // namespace

AreaBounds boundsOf(const std::vector<Point>& outline, double radius) {
  AreaBounds out{outline[0], outline[0]};
  for (const Point& p : outline) {
    out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y)};
    out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y)};
  }
  out.low = {out.low.x - radius, out.low.y - radius};
  out.high = {out.high.x + radius, out.high.y + radius};
  return out;
}

Ranges rangesAt(double y, const std::vector<Point>& outline, double radius) {
  Ranges all;
  addInside(y, outline, all);
  if (radius > 0.0)
    for (std::size_t i = 0; i < outline.size(); ++i)
      addCapsule(y, outline[i], outline[(i + 1) % outline.size()], radius, all);
  std::sort(all.begin(), all.end());
  Ranges out;
  for (const auto& range : all)
    if (!out.empty() && range.first <= out.back().second)
      out.back().second = std::max(out.back().second, range.second);
    else
      out.push_back(range);
  return out;
}

}  // namespace vegetation_sim::grass
