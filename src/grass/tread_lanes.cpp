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
using Tag = hn::CappedTag<double, TreadRow::MOST>;
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
  const Lanes half = hn::Sqrt(hn::Max(room, none));
  const auto cut = hn::Or(place.start * place.start > room, place.end * place.end > room);
  const Lanes lo = hn::IfThenElse(cut, hn::Max(place.start, hn::Neg(half)), place.start);
  const Lanes hi = hn::IfThenElse(cut, hn::Min(place.end, half), place.end);
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

// Of the dose within this pass, or of the print of the foot, which crushes even where it stands.
HWY_INLINE Lanes tiltOf(const TreadLine& line, Lanes dose, Lanes square) {
  const Lanes none = hn::Zero(Tag()), one = all(1.0), radius = all(line.radius);
  const Lanes outside = (hn::Sqrt(square) - radius) / all(0.5 * line.radius);
  const Lanes u = hn::Min(one, hn::Max(none, outside));
  const Lanes print = one - u * u * (all(3.0) - all(2.0) * u);
  const Lanes part = dose * all(line.per_full);
  const auto printed = hn::And(dose < all(line.enough), square < all(2.25) * radius * radius);
  const Lanes most = hn::IfThenElse(printed, hn::Max(part, print), part);
  return all(BEND_LIMIT) * hn::Min(one, all(line.load) * most);
}

void measure(const TreadLine& line, const TreadGrid& grid, TreadRow& row) {
  const Tag tag;
  const int step = static_cast<int>(hn::Lanes(tag)), count = row.last - row.first + 1;
  const Lanes y = all(grid.y(row.row)), reach = all(line.field.square_reach);
  for (int i = 0; i < count; i += step) {
    const Lanes column = hn::Iota(tag, static_cast<double>(row.first + i));
    const LanesPlace place =
        placeOf(line.field, all(grid.origin_x) + column * all(grid.spacing), y);
    const Lanes before = hn::Load(tag, row.dose + i);
    // No dose crushes more than fully.
    const Lanes dose =
        hn::IfThenElse(before < all(line.enough), before + fieldAt(line.field, place), before);
    const auto stays = place.end * place.end + place.side * place.side < reach;
    hn::Store(dose, tag, row.dose + i);
    hn::Store(hn::IfThenElse(stays, dose, hn::Zero(tag)), tag, row.kept + i);
    hn::Store(place.square, tag, row.square + i);
    hn::Store(place.side, tag, row.side + i);
    hn::Store(tiltOf(line, dose, place.square), tag, row.tilt + i);
  }
}

}  // namespace
}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::grass {

HWY_EXPORT(measure);

void measureRow(const TreadLine& line, const TreadGrid& grid, TreadRow& row) {
  HWY_DYNAMIC_DISPATCH(measure)(line, grid, row);
}

}  // namespace vegetation_sim::grass
#endif
