// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread_lanes.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grass/tread_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 16>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes all(double value) {
  return hn::Set(Tag(), value);
}

// Where nodes are beside the segment.
struct LanesPlace {
  Lanes start, end, side, square;
};

HWY_INLINE LanesPlace placeOf(const CompactField::Parts& field, Lanes x, Lanes y) {
  const Lanes ax = all(field.p0.x) - x, ay = all(field.p0.y) - y;
  LanesPlace out;
  out.start = ax * all(field.along.x) + ay * all(field.along.y);
  out.end = out.start + all(field.length);
  out.side = ax * all(field.along.y) - ay * all(field.along.x);
  const Lanes beyond = hn::Max(hn::Zero(Tag()), hn::Max(out.start, hn::Neg(out.end)));
  out.square = out.side * out.side + beyond * beyond;
  return out;
}

// kernelIntegral() less its value at the reach.
HWY_INLINE Lanes fieldAt(const CompactField::Parts& field, const LanesPlace& place) {
  const Lanes none = hn::Zero(Tag());
  const Lanes beside = place.side * place.side, room = all(field.square_reach) - beside;
  Lanes lo = place.start, hi = place.end;
  // Both ends within reach, as in most short steps, need no cut.
  const auto cut = hn::Or(lo * lo > room, hi * hi > room);
  if (!hn::AllFalse(Tag(), cut)) {
    const Lanes half = hn::Sqrt(hn::Max(room, none));
    lo = hn::IfThenElse(cut, hn::Max(lo, hn::Neg(half)), lo);
    hi = hn::IfThenElse(cut, hn::Min(hi, half), hi);
  }
  const Lanes square = beside + all(field.square_softness);
  const Lanes r0 = hn::Sqrt(square + lo * lo), r1 = hn::Sqrt(square + hi * hi);
  const auto straddles = hn::And(lo<none, hi> none);
  const Lanes both = hn::Abs(hi) * r0 + hn::Abs(lo) * r1;
  const Lanes above = hn::IfThenElse(straddles, hi * r0 - lo * r1, (hi - lo) * hn::Abs(hi + lo));
  const Lanes below = r0 * r1 * hn::IfThenElse(straddles, square, both);
  const Lanes sum = above / below - (hi - lo) * all(field.edge);
  const auto within = hn::And(hi > lo, place.square < all(field.square_reach));
  return hn::IfThenElse(within, sum, none);
}

// Of the print of a foot, which crushes even where it stands.
HWY_INLINE Lanes printOf(const TreadLine& line, Lanes square) {
  const Lanes none = hn::Zero(Tag()), one = all(1.0);
  const Lanes outside = (hn::Sqrt(square) - all(line.radius)) / all(0.5 * line.radius);
  const Lanes u = hn::Min(one, hn::Max(none, outside));
  return one - u * u * (all(3.0) - all(2.0) * u);
}

// Of the dose within this pass, or of the print.
HWY_INLINE Lanes tiltOf(const TreadLine& line, Lanes dose, Lanes square) {
  const Lanes radius = all(line.radius);
  Lanes part = dose * all(line.per_full);
  const auto printed = hn::And(dose < all(line.enough), square < all(2.25) * radius * radius);
  if (!hn::AllFalse(Tag(), printed))
    part = hn::IfThenElse(printed, hn::Max(part, printOf(line, square)), part);
  return all(BEND_LIMIT) * hn::Min(all(1.0), all(line.load) * part);
}

void measure(const TreadLine& line, TreadNodes& nodes) {
  const Tag tag;
  const int step = static_cast<int>(hn::Lanes(tag));
  const Lanes reach = all(line.field.square_reach);
  for (int i = 0; i < nodes.count; i += step) {
    const LanesPlace place =
        placeOf(line.field, hn::Load(tag, nodes.x + i), hn::Load(tag, nodes.y + i));
    Lanes dose = hn::Load(tag, nodes.dose + i);
    // No dose crushes more than fully.
    const auto grows = hn::And(dose < all(line.enough), place.square < reach);
    if (!hn::AllFalse(tag, grows))
      dose = hn::IfThenElse(grows, dose + fieldAt(line.field, place), dose);
    const auto stays = place.end * place.end + place.side * place.side < reach;
    hn::Store(dose, tag, nodes.dose + i);
    hn::Store(hn::IfThenElse(stays, dose, hn::Zero(tag)), tag, nodes.kept + i);
    hn::Store(place.square, tag, nodes.square + i);
    hn::Store(place.side, tag, nodes.side + i);
    hn::Store(tiltOf(line, dose, place.square), tag, nodes.tilt + i);
  }
}

}  // namespace
}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::grass {

HWY_EXPORT(measure);

void measureNodes(const TreadLine& line, TreadNodes& nodes) {
  // Lanes beyond the last node repeat it.
  constexpr int WIDEST = 16;
  for (int i = nodes.count; i % WIDEST != 0; ++i) {
    nodes.x[i] = nodes.x[nodes.count - 1];
    nodes.y[i] = nodes.y[nodes.count - 1];
    nodes.dose[i] = nodes.dose[nodes.count - 1];
  }
  HWY_DYNAMIC_DISPATCH(measure)(line, nodes);
}

}  // namespace vegetation_sim::grass
#endif
