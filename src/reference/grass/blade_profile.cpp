// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/blade_profile.h"

#include <algorithm>
#include <cmath>

#include "grass/blades/blade_math.h"

namespace vegetation_sim::grass {
namespace {

// Links have equal length; link i is tilted by hinge + arc (i + 1/2) / LINKS. The sines of equal
// steps follow from the two before: sin(a + d) = 2 cos(d) sin(a) - sin(a - d).
template <class T>
Profile<T> arcProfile(T length, T hinge, T arc) {
  const SineCosine<T> root = sineCosine(hinge);
  const SineCosine<T> half = smallSineCosine(arc * T(0.5 / LINKS));
  const T twice = T(2) - T(4) * half.sin * half.sin;
  const T link = length * T(1.0 / LINKS);
  const T ls = link * half.sin, lc = link * half.cos;
  T s = root.sin * lc + root.cos * ls, s_before = root.sin * lc - root.cos * ls;
  T c = root.cos * lc - root.sin * ls, c_before = root.cos * lc + root.sin * ls;
  Profile<T> out;
  for (std::size_t i = 0; i < LINKS; ++i) {
    out.reach[i + 1] = out.reach[i] + s;
    out.rise[i + 1] = out.rise[i] + c;
    const T s_next = twice * s - s_before, c_next = twice * c - c_before;
    s_before = s;
    c_before = c;
    s = s_next;
    c = c_next;
  }
  return out;
}

// With the end tangent of the paper the curve is s^2 tip + (s - s^2) up.
template <class T>
Profile<T> paperProfile(T length, T hinge, T arc) {
  const T x = length * sineCosine(hinge + T(0.5) * arc).sin;
  const T z = std::sqrt(std::max(T(0), length * length - x * x));
  Profile<T> out;
  for (int i = 1; i < POINTS; ++i) {
    const T s = T(i) * T(1.0 / LINKS), square = s * s;
    out.reach[static_cast<std::size_t>(i)] = square * x;
    out.rise[static_cast<std::size_t>(i)] = square * z + (s - square) * length;
  }
  return out;
}

}  // namespace

template <class T>
Profile<T> bladeProfile(T length, T hinge, T arc, BladeModel model) {
  return model == BladeModel::ARC ? arcProfile(length, hinge, arc)
                                  : paperProfile(length, hinge, arc);
}

template Profile<float> bladeProfile(float, float, float, BladeModel);
template Profile<double> bladeProfile(double, double, double, BladeModel);

PlanePoint<double> hermitePoint(double length, double tip_x, double tip_z, double s) {
  const double s2 = s * s, s3 = s2 * s;
  const double at_tip = 3.0 * s2 - 2.0 * s3, along_root = s3 - 2.0 * s2 + s, along_tip = s3 - s2;
  const double end_x = 2.0 * tip_x, end_z = 2.0 * tip_z - length;  // 2 tip - up
  return {at_tip * tip_x + along_tip * end_x,
          at_tip * tip_z + along_root * length + along_tip * end_z};
}

double loweredTip(double length, double tip_x) {
  return std::sqrt(std::max(0.0, length * length - tip_x * tip_x));
}

}  // namespace vegetation_sim::grass
