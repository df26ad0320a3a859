// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/layers/plane_view.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double LONGEST_WAY = 1e8;  // [cells] limit for the conversion to int

Quat turn(double angle, int axis) {
  const SinCos half = sinCos(0.5 * angle);
  return {half.cos, axis == 0 ? half.sin : 0.0, axis == 1 ? half.sin : 0.0,
          axis == 2 ? half.sin : 0.0};
}

// Returns the weight of the field itself: 1 in the middle, where the moved field has its seam, 0 at
// the edges.
double ownShare(int cell, int size) {
  const double from_edge = std::min(cell, size - cell) / (0.5 * size);
  return saturate(2.0 * from_edge - 0.5);
}

}  // namespace

Axes axesOf(const Quat& orientation) {
  return {Vec3(-axisY(orientation)), axisZ(orientation), Vec3(-axisX(orientation))};
}

Vec3 into(const Axes& axes, const Vec3& world) {
  return {dot(axes.right, world), dot(axes.up, world), dot(axes.out, world)};
}

Vec3 outOf(const Axes& axes, const Vec3& c) {
  return (axes.right * c.x() + axes.up * c.y()) + axes.out * c.z();
}

void describe(FieldVisitor& v, PlaneSettings& s) {
  v.vector("camera", s.camera, "m", {-1e6, 1e6});
  v.number("yaw", s.yaw, "rad", {-10.0, 10.0});
  v.number("pitch", s.pitch, "rad", {-1.6, 1.6});
  v.number("roll", s.roll, "rad", {-3.2, 3.2});
  v.number("distance", s.distance, "m", {0.1, 1000.0});
  v.number("field_of_view", s.field_of_view, "rad", {0.05, 2.5});
  v.choice("projection", s.projection, {"rotation", "printed"});
  v.choice("tiling", s.tiling, {"periodic", "blend"});
}

Quat orientationOf(const PlaneSettings& s) {
  return turn(s.yaw, 2) * turn(s.pitch, 1) * turn(s.roll, 0);
}

Plane::Plane(const PlaneSettings& s) : axes(axesOf(orientationOf(s))) {
  centre = s.camera - axes.out * s.distance;
  const SinCos half = sinCos(0.5 * s.field_of_view);
  width = 2.0 * s.distance * half.sin / half.cos;
}

PlaneVector Plane::cellAt(const Vec3& world, int size) const {
  const Vec3 offset = world - centre;
  const auto cell = [&](const Vec3& axis) {
    const double x = (dot(axis, offset) / width + 0.5) * size;
    return std::min(LONGEST_WAY, std::max(-LONGEST_WAY, x));
  };
  return {cell(axes.right), cell(axes.up)};
}

PlaneToView::PlaneToView(const Axes& plane, const Axes& view) {
  const auto row = [&](const Vec3& axis) {
    return Vec3(dot(axis, plane.right), dot(axis, plane.up), dot(axis, plane.out));
  };
  right = row(view.right);
  up = row(view.up);
  out = row(view.out);
}

void blendSeams(PlaneField& field) {
  const int size = field.size, mask = size - 1;
  for (const bool across : {true, false}) {
    const PlaneField from = field;
    for (int row = 0; row < size; ++row)
      for (int column = 0; column < size; ++column) {
        const int moved = across ? row * size + ((column + size / 2) & mask)
                                 : ((row + size / 2) & mask) * size + column;
        const double own = ownShare(across ? column : row, size);
        const auto i = static_cast<std::size_t>(row * size + column);
        const auto j = static_cast<std::size_t>(moved);
        field.u[i] = own * from.u[i] + (1.0 - own) * from.u[j];
        field.v[i] = own * from.v[i] + (1.0 - own) * from.v[j];
      }
  }
}

}  // namespace vegetation_sim::canopy
