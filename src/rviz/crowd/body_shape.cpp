// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_shape.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using crowd::Part;
using P = crowd::Proportions;

enum class Paint { SKIN, FACE, HAIR, SHIRT, SLEEVE, BELT, TROUSERS, SHOES };

// A ring of a grown body in shares of its height. Edges of clothes are two rings at one place.
struct Form {
  double along, broad, deep;
  double forward{0.0};
  Paint paint{Paint::SKIN};
  bool fine{false};
};

// From the hips up the spine. Waists and hips depend on the build as well.
constexpr Form TRUNK[] = {{-0.055, 0.030, 0.034, 0.000, Paint::TROUSERS, true},
                          {-0.040, 0.075, 0.056, -0.003, Paint::TROUSERS, true},
                          {-0.010, 0.096, 0.066, -0.004, Paint::TROUSERS},
                          {0.020, 0.092, 0.063, -0.003, Paint::TROUSERS, true},
                          {0.050, 0.083, 0.055, 0.000, Paint::TROUSERS},
                          {0.050, 0.085, 0.057, 0.000, Paint::BELT, true},
                          {0.062, 0.084, 0.056, 0.000, Paint::BELT, true},
                          {0.062, 0.086, 0.058, 0.000, Paint::SHIRT},
                          {0.100, 0.081, 0.053, 0.003, Paint::SHIRT, true},
                          {0.150, 0.090, 0.059, 0.006, Paint::SHIRT, true},
                          {0.205, 0.099, 0.066, 0.008, Paint::SHIRT, true},
                          {0.250, 0.108, 0.062, 0.002, Paint::SHIRT},
                          {0.280, 0.103, 0.051, -0.004, Paint::SHIRT, true},
                          {0.300, 0.070, 0.040, -0.005, Paint::SHIRT},
                          {0.312, 0.038, 0.036, -0.003, Paint::SHIRT, true},
                          {0.312, 0.034, 0.033, -0.003, Paint::SKIN},
                          {0.335, 0.030, 0.033, 0.000, Paint::SKIN, true},
                          {0.365, 0.031, 0.034, 0.004, Paint::SKIN}};
// The head is measured from the neck along the spine, and is listed from the chin up.
constexpr Form HEAD[] = {{-0.006, 0.016, 0.020, 0.026, Paint::FACE, true},
                         {0.002, 0.030, 0.036, 0.015, Paint::FACE},
                         {0.022, 0.039, 0.046, 0.008, Paint::FACE, true},
                         {0.040, 0.042, 0.050, 0.006, Paint::FACE, true},
                         {0.056, 0.044, 0.053, 0.004, Paint::FACE},
                         {0.066, 0.044, 0.053, 0.004, Paint::FACE, true},
                         {0.088, 0.045, 0.054, 0.003, Paint::FACE, true},
                         {0.088, 0.046, 0.055, 0.003, Paint::HAIR},
                         {0.108, 0.043, 0.052, 0.001, Paint::HAIR, true},
                         {0.123, 0.033, 0.041, -0.001, Paint::HAIR},
                         {0.131, 0.018, 0.023, -0.002, Paint::HAIR, true},
                         {0.134, 0.003, 0.004, -0.002, Paint::HAIR, true}};
constexpr std::size_t NOSE_RING = 3, EYE_RING = 5;
// The arm is measured from the shoulder. The hand is flat with the thumb in front.
constexpr Form ARM[] = {{-0.024, 0.010, 0.012, 0.0, Paint::SHIRT, true},
                        {-0.012, 0.026, 0.030, 0.0, Paint::SHIRT, true},
                        {0.010, 0.032, 0.035, 0.0, Paint::SHIRT},
                        {0.060, 0.029, 0.033, 0.0, Paint::SHIRT, true},
                        {0.120, 0.027, 0.029, 0.0, Paint::SHIRT},
                        {0.120, 0.022, 0.024, 0.0, Paint::SLEEVE},
                        {0.172, 0.021, 0.023, 0.0, Paint::SLEEVE, true},
                        {0.205, 0.021, 0.024, 0.0, Paint::SLEEVE, true},
                        {0.260, 0.018, 0.020, 0.0, Paint::SLEEVE, true},
                        {0.318, 0.015, 0.018, 0.0, Paint::SLEEVE},
                        {0.318, 0.012, 0.015, 0.0, Paint::SKIN, true},
                        {0.340, 0.011, 0.022, 0.003, Paint::SKIN},
                        {0.370, 0.010, 0.022, 0.004, Paint::SKIN, true},
                        {0.400, 0.009, 0.018, 0.003, Paint::SKIN, true},
                        {0.424, 0.006, 0.009, 0.004, Paint::SKIN}};
// The leg is measured from the hip.
constexpr Form LEG[] = {{-0.045, 0.020, 0.024, 0.000, Paint::TROUSERS, true},
                        {-0.025, 0.040, 0.046, 0.000, Paint::TROUSERS, true},
                        {0.005, 0.047, 0.054, 0.000, Paint::TROUSERS},
                        {0.060, 0.049, 0.055, 0.000, Paint::TROUSERS, true},
                        {0.130, 0.044, 0.050, 0.003, Paint::TROUSERS},
                        {0.210, 0.038, 0.042, 0.002, Paint::TROUSERS, true},
                        {0.245, 0.036, 0.040, 0.003, Paint::TROUSERS},
                        {0.285, 0.034, 0.039, -0.002, Paint::TROUSERS, true},
                        {0.330, 0.034, 0.040, -0.006, Paint::TROUSERS},
                        {0.410, 0.030, 0.034, -0.004, Paint::TROUSERS, true},
                        {0.478, 0.029, 0.033, 0.000, Paint::TROUSERS}};
// The shoe is measured from the heel to the toes; `forward` is upwards here.
constexpr Form SHOE[] = {
    {-0.018, 0.009, 0.010, 0.002, Paint::SHOES, true}, {-0.010, 0.021, 0.022, 0.004, Paint::SHOES},
    {0.012, 0.025, 0.030, 0.012, Paint::SHOES, true},  {0.040, 0.026, 0.034, 0.016, Paint::SHOES},
    {0.075, 0.028, 0.022, 0.004, Paint::SHOES, true},  {0.105, 0.030, 0.017, -0.001, Paint::SHOES},
    {0.128, 0.022, 0.012, -0.006, Paint::SHOES, true}, {0.139, 0.008, 0.006, -0.010, Paint::SHOES}};

Vec3 unit(const Vec3& v) {
  return v / std::max(1e-9, length(v));
}

class Shaper {
 public:
  Shaper(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes, const Vec3& left,
         std::vector<BodyRing>& out)
      : skeleton_(skeleton),
        clothes_(clothes),
        left_(left),
        height_(limbOf(skeleton, Part::HEAD).radius / P::HEAD),
        out_(out) {}

  void putTrunk() {
    const crowd::Limb& hips = limbOf(skeleton_, Part::PELVIS);
    const crowd::Limb& chest = limbOf(skeleton_, Part::CHEST);
    const Vec3 pelvis = 0.5 * (hips.from + hips.to), up = unit(chest.to - chest.from);
    begin();
    for (const Form& form : TRUNK) {
      BodyRing& ring = put(form, pelvis + form.along * height_ * up, up);
      // A broad build has shoulders, a slight one hips.
      const double high = saturate(form.along / 0.25);
      ring.broad *= 1.0 + clothes_.build * (0.16 * high - 0.08) - 0.04 * high;
    }
  }

  void putHead() {
    const crowd::Limb& head = limbOf(skeleton_, Part::HEAD);
    const Vec3 up = unit(head.to - head.from);
    begin();
    for (std::size_t i = 0; i < std::size(HEAD); ++i) {
      BodyRing& ring = put(HEAD[i], head.from + HEAD[i].along * height_ * up, up);
      if (i == NOSE_RING) ring.nose = 0.014 * height_;
      ring.eyes = i == EYE_RING;
    }
  }

  template <std::size_t N>
  void putLimb(const Form (&forms)[N], Part first, Part second, int side, double bend) {
    const crowd::Limb& a = limbOf(skeleton_, first, side);
    const crowd::Limb& b = limbOf(skeleton_, second, side);
    const double size = length(a.to - a.from);
    const Vec3 upper = unit(a.to - a.from), lower = unit(b.to - b.from);
    begin();
    for (const Form& form : forms) {
      const double way = form.along * height_;
      const double turned = smoothStep(saturate(0.5 + (way - size) / (bend * height_)));
      const Vec3 centre =
          way < size ? Vec3(a.from + way * upper) : Vec3(a.to + (way - size) * lower);
      put(form, centre, unit((1.0 - turned) * upper + turned * lower));
    }
  }

  void putShoe(int side) {
    const crowd::Limb& foot = limbOf(skeleton_, Part::FOOT, side);
    const Vec3 along = unit(foot.to - foot.from);
    begin();
    for (const Form& form : SHOE) put(form, foot.from + form.along * height_ * along, along);
  }

 private:
  void begin() { begins_ = true; }

  BodyRing& put(const Form& form, const Vec3& centre, const Vec3& along) {
    BodyRing ring;
    ring.along = along;
    ring.across = unit(left_ - dot(left_, along) * along);
    ring.back = cross(along, ring.across);
    // Along an arm or a leg the tube runs down, so that this vector points to the front.
    const double sign = along.z() < -0.3 ? 1.0 : -1.0;
    const double shift = form.paint == Paint::SHOES ? form.forward : sign * form.forward;
    ring.centre = centre + shift * height_ * ring.back;
    ring.broad = form.broad * height_;
    ring.deep = form.deep * height_;
    ring.colour = ring.behind = colourOf(form.paint);
    if (form.paint == Paint::FACE && (form.along > 0.03 || clothes_.long_hair))
      ring.behind = clothes_.hair;
    ring.fine = form.fine;
    ring.begins = begins_;
    begins_ = false;
    out_.push_back(ring);
    return out_.back();
  }

  Vec3 colourOf(Paint paint) const {
    switch (paint) {
      case Paint::HAIR:
        return clothes_.hair;
      case Paint::SHIRT:
        return clothes_.shirt;
      case Paint::SLEEVE:
        return clothes_.long_sleeves ? clothes_.shirt : clothes_.skin;
      case Paint::BELT:
        return 0.5 * clothes_.shoes + 0.15 * clothes_.trousers;
      case Paint::TROUSERS:
        return clothes_.trousers;
      case Paint::SHOES:
        return clothes_.shoes;
      default:
        return clothes_.skin;
    }
  }

  const crowd::Skeleton& skeleton_;
  const crowd::Clothes& clothes_;
  Vec3 left_;
  double height_;
  std::vector<BodyRing>& out_;
  bool begins_{true};
};

}  // namespace

void shapeBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes, const Vec3& left,
               std::vector<BodyRing>& out) {
  out.clear();
  Shaper shaper(skeleton, clothes, left, out);
  shaper.putTrunk();
  shaper.putHead();
  for (int side = 0; side < 2; ++side) {
    shaper.putLimb(ARM, Part::UPPER_ARM, Part::FOREARM, side, 0.06);
    shaper.putLimb(LEG, Part::THIGH, Part::SHANK, side, 0.09);
    shaper.putShoe(side);
  }
}

}  // namespace vegetation_sim::view
