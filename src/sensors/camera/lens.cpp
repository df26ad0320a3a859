// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/lens.h"

#include <cmath>
#include <cstdio>

namespace vegetation_sim::scan {
namespace {

constexpr Range K{-10.0, 10.0};
constexpr Range P{-1.0, 1.0};
constexpr Range SIDE{1, 4096};
static_assert(SIDE.high == MOST_PIXELS_OF_SIDE);
constexpr int MOST_STEPS = 30;           // of Newton's method
constexpr double CONVERGED = 1e-12;      // residual, relative to the focal length
constexpr int CHECKED = 24, PARTS = 12;  // places of a side, and parts of the way to each

struct Plane {
  double x{0.0}, y{0.0};  // at z = 1
};

// The distortion is the gradient of a function, so its derivative is symmetric.
struct Derivative {
  double xx, xy, yy;
  double determinant() const { return xx * yy - xy * xy; }
  bool isPositive() const { return xx > 0.0 && determinant() > 0.0; }
};

Plane distort(const Distortion& d, const Plane& p) {
  const double square = p.x * p.x + p.y * p.y;
  const double radial = 1.0 + square * (d.k1 + square * (d.k2 + square * d.k3));
  return {p.x * radial + 2.0 * d.p1 * p.x * p.y + d.p2 * (square + 2.0 * p.x * p.x),
          p.y * radial + d.p1 * (square + 2.0 * p.y * p.y) + 2.0 * d.p2 * p.x * p.y};
}

Derivative derivativeAt(const Distortion& d, const Plane& p) {
  const double square = p.x * p.x + p.y * p.y;
  const double radial = 1.0 + square * (d.k1 + square * (d.k2 + square * d.k3));
  const double slope = 2.0 * (d.k1 + square * (2.0 * d.k2 + square * 3.0 * d.k3));
  return {radial + p.x * p.x * slope + 2.0 * d.p1 * p.y + 6.0 * d.p2 * p.x,
          p.x * p.y * slope + 2.0 * (d.p1 * p.x + d.p2 * p.y),
          radial + p.y * p.y * slope + 6.0 * d.p1 * p.y + 2.0 * d.p2 * p.x};
}

// Newton's method from a first guess.
Plane undistort(const Distortion& d, const Plane& wanted, Plane guess) {
  for (int step = 0; step < MOST_STEPS; ++step) {
    const Plane reached = distort(d, guess);
    const double x = wanted.x - reached.x, y = wanted.y - reached.y;
    if (x * x + y * y < CONVERGED * CONVERGED) break;
    const Derivative slope = derivativeAt(d, guess);
    const double scale = 1.0 / slope.determinant();
    guess.x += scale * (slope.yy * x - slope.xy * y);
    guess.y += scale * (slope.xx * y - slope.xy * x);
  }
  return guess;
}

Plane planeOf(const Lens& lens, const Pixel& pixel) {
  return {(pixel.u - lens.cx) / lens.fx, (pixel.v - lens.cy) / lens.fy};
}

// Follows the inverse from the principal point outwards, where it must stay unique.
bool isInvertibleAt(const Lens& lens, const Pixel& pixel) {
  const Plane wanted = planeOf(lens, pixel);
  Plane place;
  for (int part = 1; part <= PARTS; ++part) {
    const double share = static_cast<double>(part) / PARTS;
    place = undistort(lens.distortion, {share * wanted.x, share * wanted.y}, place);
    if (!derivativeAt(lens.distortion, place).isPositive()) return false;
  }
  const Pixel back = project(lens, directionOf(lens, pixel));
  const Plane found = undistort(lens.distortion, wanted, wanted);
  return std::hypot(back.u - pixel.u, back.v - pixel.v) < LENS_ERROR &&
         std::hypot(found.x - place.x, found.y - place.y) < 1e-6;
}

void describe(FieldVisitor& v, Distortion& d) {
  v.number("k1", d.k1, "", K);
  v.number("k2", d.k2, "", K);
  v.number("p1", d.p1, "", P);
  v.number("p2", d.p2, "", P);
  v.number("k3", d.k3, "", K);
}

void describeSize(FieldVisitor& v, int& width, int& height) {
  v.integer("width", width, "pixel", SIDE);
  v.integer("height", height, "pixel", SIDE);
}

}  // namespace

void describe(FieldVisitor& v, LensSettings& s) {
  describeSize(v, s.width, s.height);
  v.number("field_of_view", s.field_of_view, "rad", {0.01, 2.8});
  describe(v, s.distortion);
}

Lens lensOf(const LensSettings& settings) {
  Lens out;
  out.width = settings.width;
  out.height = settings.height;
  out.fx = out.fy = 0.5 * settings.width / std::tan(0.5 * settings.field_of_view);
  out.cx = 0.5 * (settings.width - 1);
  out.cy = 0.5 * (settings.height - 1);
  out.distortion = settings.distortion;
  return out;
}

Pixel project(const Lens& lens, const Vec3& place) {
  const Plane at = distort(lens.distortion, {place.x() / place.z(), place.y() / place.z()});
  return {lens.cx + lens.fx * at.x, lens.cy + lens.fy * at.y};
}

Vec3 directionOf(const Lens& lens, const Pixel& pixel) {
  const Plane wanted = planeOf(lens, pixel);
  const Plane at = undistort(lens.distortion, wanted, wanted);
  const Vec3 out(at.x, at.y, 1.0);
  return out / length(out);
}

void check(const Lens& lens, const std::string& context, Faults& faults) {
  const std::size_t before = faults.list().size();
  Lens copy = lens;
  FieldChecker checker(context, faults);
  describeSize(checker, copy.width, copy.height);
  checker.number("fx", copy.fx, "pixel", {1.0, 1e5});
  checker.number("fy", copy.fy, "pixel", {1.0, 1e5});
  checker.number("cx", copy.cx, "pixel", {-1e4, 1e4});
  checker.number("cy", copy.cy, "pixel", {-1e4, 1e4});
  describe(checker, copy.distortion);
  if (faults.list().size() > before) return;
  for (int i = 0; i <= CHECKED; ++i)
    for (int j = 0; j <= CHECKED; ++j) {
      const Pixel pixel{static_cast<double>(i) * lens.width / CHECKED - 0.5,
                        static_cast<double>(j) * lens.height / CHECKED - 0.5};
      if (isInvertibleAt(lens, pixel)) continue;
      char text[100];
      std::snprintf(text, sizeof text, "the distortion k1 to k3 has no inverse at pixel (%g, %g)",
                    pixel.u, pixel.v);
      return faults.add(context + text);
    }
}

}  // namespace vegetation_sim::scan
