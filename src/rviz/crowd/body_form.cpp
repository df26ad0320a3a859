// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_form.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using crowd::Part;
using P = crowd::Proportions;
using Kind = FormTube::Kind;

constexpr double HIP = P::THIGH + P::SHANK + P::ANKLE;  // height of the hips
constexpr double ARM_OUT = 0.25;                        // sine of the angle of the arms
constexpr double ARM_DROP = 0.018;  // from the top of the shoulder, where skeletons have the joint

// From the hips up the spine. The shirt hangs over the trousers.
const FormRing TRUNK[] = {{-0.055, 0.030, 0.034, 0.000, Cover::TROUSERS, true},
                          {-0.040, 0.074, 0.058, -0.004, Cover::TROUSERS, true},
                          {-0.012, 0.094, 0.068, -0.007, Cover::TROUSERS},
                          {-0.006, 0.098, 0.071, -0.007, Cover::SHIRT},
                          {0.020, 0.093, 0.066, -0.005, Cover::SHIRT, true},
                          {0.050, 0.086, 0.059, 0.000, Cover::SHIRT, true},
                          {0.075, 0.081, 0.055, 0.002, Cover::SHIRT, true},
                          {0.105, 0.080, 0.055, 0.004, Cover::SHIRT},
                          {0.150, 0.088, 0.060, 0.006, Cover::SHIRT, true},
                          {0.200, 0.096, 0.066, 0.007, Cover::SHIRT, true},
                          {0.235, 0.103, 0.064, 0.003, Cover::SHIRT, true},
                          {0.262, 0.106, 0.056, -0.001, Cover::SHIRT},
                          {0.283, 0.094, 0.048, -0.004, Cover::SHIRT, true},
                          {0.301, 0.064, 0.042, -0.005, Cover::SHIRT},
                          {0.313, 0.041, 0.038, -0.004, Cover::COLLAR, true},
                          {0.324, 0.035, 0.036, -0.003, Cover::COLLAR},
                          {0.327, 0.031, 0.032, -0.003, Cover::SKIN, true},
                          {0.345, 0.029, 0.031, 0.000, Cover::SKIN},
                          {0.372, 0.030, 0.033, 0.004, Cover::SKIN}};
// The head and the neck, listed from the chin along the spine.
const FormRing HEAD[] = {{-0.008, 0.014, 0.016, 0.030, Cover::FACE, true},
                         {0.000, 0.025, 0.030, 0.020, Cover::FACE},
                         {0.012, 0.034, 0.041, 0.012, Cover::FACE, true},
                         {0.024, 0.038, 0.047, 0.009, Cover::FACE, true},
                         {0.038, 0.041, 0.050, 0.006, Cover::FACE},
                         {0.050, 0.043, 0.052, 0.004, Cover::FACE, true},
                         {0.062, 0.044, 0.053, 0.003, Cover::FACE, true},
                         {0.072, 0.0445, 0.054, 0.003, Cover::FACE, true},
                         {0.088, 0.046, 0.055, 0.001, Cover::FACE},
                         {0.097, 0.048, 0.057, -0.001, Cover::HAIR, true},
                         {0.113, 0.044, 0.053, -0.003, Cover::HAIR},
                         {0.126, 0.033, 0.041, -0.004, Cover::HAIR, true},
                         {0.133, 0.016, 0.021, -0.004, Cover::HAIR, true},
                         {0.135, 0.003, 0.004, -0.004, Cover::HAIR}};
// Behind the head, from the neck up.
const FormRing LONG_HAIR[] = {{-0.052, 0.030, 0.012, 0.000, Cover::HAIR, true},
                              {-0.040, 0.042, 0.019, 0.000, Cover::HAIR},
                              {0.000, 0.044, 0.026, 0.004, Cover::HAIR},
                              {0.050, 0.047, 0.034, 0.010, Cover::HAIR, true},
                              {0.095, 0.047, 0.034, 0.014, Cover::HAIR},
                              {0.122, 0.026, 0.018, 0.018, Cover::HAIR, true}};
// From the shoulder. The hand is flat; its thumb is in front.
const FormRing ARM[] = {{-0.020, 0.014, 0.018, 0.0, Cover::SHIRT, true},
                        {-0.008, 0.026, 0.031, 0.0, Cover::SHIRT},
                        {0.016, 0.030, 0.035, 0.0, Cover::SHIRT, true},
                        {0.040, 0.029, 0.034, 0.0, Cover::SHIRT, true},
                        {0.075, 0.028, 0.032, 0.0, Cover::SHIRT, true},
                        {0.118, 0.027, 0.030, 0.0, Cover::SHIRT},
                        {0.124, 0.022, 0.025, 0.0, Cover::SLEEVE},
                        {0.155, 0.021, 0.024, 0.0, Cover::SLEEVE, true},
                        {0.180, 0.020, 0.023, -0.001, Cover::SLEEVE, true},
                        {0.208, 0.021, 0.024, 0.0, Cover::SLEEVE, true},
                        {0.260, 0.018, 0.020, 0.0, Cover::SLEEVE},
                        {0.314, 0.015, 0.018, 0.0, Cover::SLEEVE, true},
                        {0.320, 0.012, 0.016, 0.0, Cover::SKIN, true},
                        {0.338, 0.011, 0.021, 0.003, Cover::SKIN, true},
                        {0.358, 0.011, 0.025, 0.006, Cover::SKIN},
                        {0.378, 0.010, 0.020, 0.003, Cover::SKIN, true},
                        {0.402, 0.009, 0.016, 0.002, Cover::SKIN, true},
                        {0.424, 0.005, 0.008, 0.003, Cover::SKIN}};
// From the hip. Trousers are wider than calves and fall on the shoes.
const FormRing LEG[] = {{-0.045, 0.022, 0.026, -0.002, Cover::TROUSERS, true},
                        {-0.025, 0.042, 0.050, -0.004, Cover::TROUSERS, true},
                        {0.005, 0.048, 0.057, -0.004, Cover::TROUSERS},
                        {0.060, 0.049, 0.056, -0.002, Cover::TROUSERS, true},
                        {0.130, 0.045, 0.051, 0.002, Cover::TROUSERS},
                        {0.205, 0.039, 0.044, 0.003, Cover::TROUSERS, true},
                        {0.245, 0.037, 0.042, 0.003, Cover::TROUSERS},
                        {0.285, 0.035, 0.041, -0.001, Cover::TROUSERS, true},
                        {0.330, 0.035, 0.042, -0.006, Cover::TROUSERS},
                        {0.410, 0.032, 0.037, -0.004, Cover::TROUSERS, true},
                        {0.455, 0.031, 0.036, 0.000, Cover::TROUSERS},
                        {0.474, 0.031, 0.037, 0.002, Cover::TROUSERS, true}};
// Listed from the heel to the toes.
const FormRing SHOE[] = {
    {-0.018, 0.009, 0.010, 0.002, Cover::SHOES, true}, {-0.010, 0.021, 0.022, 0.004, Cover::SHOES},
    {0.012, 0.025, 0.030, 0.012, Cover::SHOES, true},  {0.040, 0.026, 0.034, 0.016, Cover::SHOES},
    {0.075, 0.028, 0.022, 0.004, Cover::SHOES, true},  {0.105, 0.030, 0.017, -0.001, Cover::SHOES},
    {0.128, 0.022, 0.012, -0.006, Cover::SHOES, true}, {0.139, 0.008, 0.006, -0.010, Cover::SHOES}};

template <std::size_t N>
std::vector<FormRing> listOf(const FormRing (&rings)[N]) {
  return {rings, rings + N};
}

// Returns the smaller of two distances, less around places where they are about equal.
double smoothMinimum(double a, double b, double reach) {
  const double part = saturate(0.5 + 0.5 * (b - a) / reach);
  return b + (a - b) * part - reach * part * (1.0 - part);
}

Vec3 armDirection(int side) {
  return {0.0, (side == 0 ? 1.0 : -1.0) * ARM_OUT, -std::sqrt(1.0 - ARM_OUT * ARM_OUT)};
}

Vec3 onSide(int side, double half, double z) {
  return {0.0, (side == 0 ? half : -half), z};
}

}  // namespace

double FormTube::distance(const Vec3& place) const {
  const Vec3 way = place - origin;
  const double s = dot(way, along);
  std::size_t next = 1;
  while (next + 1 < rings.size() && rings[next].along < s) ++next;
  const FormRing &a = rings[next - 1], &b = rings[next];
  const double part = saturate((s - a.along) / std::max(1e-9, b.along - a.along));
  const auto mixed = [&](double FormRing::*value) {
    return (1.0 - part) * a.*value + part * b.*value;
  };
  const double y = dot(way, left), x = dot(way, front) - mixed(&FormRing::forward);
  const double out = std::hypot(y / mixed(&FormRing::broad), x / mixed(&FormRing::deep));
  const double radius = out > 1e-6 ? std::hypot(x, y) / out
                                   : std::min(mixed(&FormRing::broad), mixed(&FormRing::deep));
  const double aside = (out - 1.0) * radius;
  const double beyond = std::max({0.0, rings.front().along - s, s - rings.back().along});
  return beyond > 0.0 ? std::hypot(beyond, std::max(0.0, aside)) : aside;
}

BodyForm::BodyForm(bool long_hair) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  tubes_.push_back({Kind::TRUNK, 1, Vec3(0.0, 0.0, HIP), z, y, x, listOf(TRUNK)});
  tubes_.push_back({Kind::HEAD, 1, Vec3(0.0, 0.0, P::NECK), z, y, x, listOf(HEAD)});
  if (long_hair)
    tubes_.push_back({Kind::LONG_HAIR, 1, Vec3(-0.034, 0.0, P::NECK), z, y, x, listOf(LONG_HAIR)});
  for (int side = 0; side < 2; ++side) {
    const Vec3 down = armDirection(side);
    tubes_.push_back({Kind::ARM, side, onSide(side, P::SHOULDER_HALF, P::SHOULDER - ARM_DROP), down,
                      cross(x, down), x, listOf(ARM)});
    tubes_.push_back({Kind::LEG, side, onSide(side, P::HIP_HALF, HIP), -z, y, x, listOf(LEG)});
    tubes_.push_back({Kind::SHOE, side, onSide(side, P::HIP_HALF, P::SOLE) - P::FOOT_BACK * x, x, y,
                      z, listOf(SHOE)});
  }
}

double BodyForm::distance(const Vec3& place, const FormTube* without) const {
  constexpr double FAR = 1e6;
  double trunk = FAR, head = FAR, arms = FAR, legs[2] = {FAR, FAR}, shoes[2] = {FAR, FAR};
  for (const FormTube& tube : tubes_) {
    if (&tube == without) continue;
    const double own = tube.distance(place);
    const auto side = static_cast<std::size_t>(tube.side);
    switch (tube.kind) {
      case Kind::TRUNK:
        trunk = own;
        break;
      case Kind::HEAD:
        head = smoothMinimum(head, own, 0.012);
        break;
      case Kind::LONG_HAIR:
        head = smoothMinimum(head, own, 0.012);
        break;
      case Kind::ARM:
        arms = std::min(arms, own);
        break;
      case Kind::LEG:
        legs[side] = own;
        break;
      case Kind::SHOE:
        shoes[side] = own;
        break;
    }
  }
  double out = smoothMinimum(trunk, arms, 0.045);
  const double left = smoothMinimum(legs[0], shoes[0], 0.012);
  const double right = smoothMinimum(legs[1], shoes[1], 0.012);
  out = smoothMinimum(out, std::min(left, right), 0.04);
  return smoothMinimum(out, head, 0.02);
}

Vec3 BodyForm::normal(const Vec3& place) const {
  constexpr double STEP = 2e-3;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    Vec3 low = place, high = place;
    low[i] -= STEP;
    high[i] += STEP;
    out[i] = distance(high) - distance(low);
  }
  return out / std::max(1e-12, length(out));
}

crowd::Skeleton formSkeleton() {
  crowd::Skeleton out;
  const auto put = [&](Part part, int side, const Vec3& from, const Vec3& to) {
    out[static_cast<std::size_t>(part) + static_cast<std::size_t>(side)] = {from, to, 0.0};
  };
  const Vec3 up = Vec3::UnitZ(), pelvis = HIP * up, chest = P::SHOULDER * up, neck = P::NECK * up;
  put(Part::PELVIS, 0, onSide(0, 0.04, HIP), onSide(1, 0.04, HIP));
  put(Part::CHEST, 0, pelvis + 0.05 * up, chest - 0.03 * up);
  put(Part::SHOULDERS, 0, onSide(0, 0.075, P::SHOULDER), onSide(1, 0.075, P::SHOULDER));
  put(Part::NECK, 0, chest, neck);
  put(Part::HEAD, 0, neck, neck + 0.06 * up);
  for (int side = 0; side < 2; ++side) {
    const Vec3 hip = onSide(side, P::HIP_HALF, HIP), knee = hip - P::THIGH * up;
    const Vec3 ankle = knee - P::SHANK * up, sole(0.0, hip.y(), P::SOLE);
    put(Part::THIGH, side, hip, knee);
    put(Part::SHANK, side, knee, ankle);
    put(Part::FOOT, side, sole - P::FOOT_BACK * Vec3::UnitX(),
        sole + P::FOOT_FRONT * Vec3::UnitX());
    const Vec3 shoulder = onSide(side, P::SHOULDER_HALF, P::SHOULDER);
    const Vec3 elbow = shoulder + P::UPPER_ARM * armDirection(side);
    put(Part::UPPER_ARM, side, shoulder, elbow);
    put(Part::FOREARM, side, elbow, elbow + P::FOREARM * armDirection(side));
  }
  return out;
}

}  // namespace vegetation_sim::view
