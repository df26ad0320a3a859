// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread/tread_tilt.h"

#include <algorithm>
#include <cmath>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "grass/tread/tread_tilt.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef VEGETATION_SIM_GRASS_TREAD_TILT_ONCE
#define VEGETATION_SIM_GRASS_TREAD_TILT_ONCE
namespace vegetation_sim::grass {

/// Packs row and column; adding 1 gives the next column.
inline std::uint64_t packed(int row, int column) {
  return (static_cast<std::uint64_t>(row) << 32) + static_cast<std::uint64_t>(column);
}

/// Returns the columns of a band's row that may be within reach; all of a row that is one vector
/// wide.
inline TreadSpan spanIn(const TreadBand& band, const TreadLine& line, const TreadGrid& grid,
                        int row) {
  const TreadSpan all{band.first_column, band.first_column + band.pitch - 1};
  if (band.pitch <= TreadBand::PITCH) return all;
  const TreadSpan span = line.spanOf(grid, row);
  return {std::max(span.first, all.first), std::min(span.last, all.last)};
}

}  // namespace vegetation_sim::grass
#endif

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::grass::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_SCALAR

// Plain version of the row, which the vectorised one equals, and which runs without vectors.
void measureRow(const TreadLine& line, const TreadGrid& grid, const TreadBand& band, int row,
                TreadPresses& out) {
  const TreadSpan span = spanIn(band, line, grid, row);
  const TreadLine own = line;  // a copy, which writes cannot change
  const TreadRow beside(own.field.parts(), grid, row);
  const double reach = own.field.parts().square_reach;
  double* const doses = band.dosesOf(row) - band.first_column;
  std::uint64_t* const places = out.places.data();
  double* const tilts = out.tilts.data();
  std::size_t count = out.count;
  int touched = 0;
  const int last = std::min(span.last, grid.last_column);
  for (int column = std::max(0, span.first); column <= last; ++column) {
    const CompactField::Place place = own.field.placeOf(beside.start + column * beside.start_step,
                                                        beside.side + column * beside.side_step);
    if (place.square_distance >= reach) {
      doses[column] = 0.0;
      continue;
    }
    ++touched;
    double dose = doses[column];
    if (dose < own.enough) dose += own.field.fieldAt(place);
    const double tilt = own.tiltOf(dose, place.square_distance);
    const bool stays = place.end * place.end + place.side * place.side < reach;
    doses[column] = stays ? dose : 0.0;
    places[count] = packed(row, column);
    tilts[count] = tilt;
    count += tilt >= double{CRUNCHED};
  }
  out.touched += touched;
  out.count = count;
}

#else

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, TreadBand::PITCH>;
using Lanes = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE Lanes all(double value) {
  return hn::Set(Tag(), value);
}

// Positions of nodes relative to the segment.
struct LanesPlace {
  Lanes start, end, side, square;
};

HWY_INLINE LanesPlace placeOf(const TreadRow& row, double length, Lanes column) {
  LanesPlace out;
  out.start = all(row.start) + column * all(row.start_step);
  out.end = out.start + all(length);
  out.side = all(row.side) + column * all(row.side_step);
  const Lanes beyond = hn::Max(hn::Zero(Tag()), hn::Max(out.start, hn::Neg(out.end)));
  out.square = out.side * out.side + beyond * beyond;
  return out;
}

// CompactField::fieldAt() within reach.
HWY_INLINE Lanes fieldAt(const CompactField::Parts& field, const LanesPlace& place) {
  const Lanes none = hn::Zero(Tag());
  const Lanes beside = place.side * place.side, room = all(field.square_reach) - beside;
  const Lanes square = beside + all(field.square_softness);
  const Lanes lo2 = place.start * place.start, hi2 = place.end * place.end;
  const auto cut_lo = hn::And(lo2 > room, place.start < none);
  const auto cut_hi = hn::And(hi2 > room, place.end > none);
  const Lanes a = hn::Sqrt(hn::IfThenElse(cut_lo, room, square + lo2));
  const Lanes b = hn::Sqrt(hn::IfThenElse(cut_hi, room, square + hi2));
  const Lanes lo = hn::IfThenElse(cut_lo, hn::Neg(a), place.start);
  const Lanes hi = hn::IfThenElse(cut_hi, b, place.end);
  const Lanes r0 = hn::IfThenElse(cut_lo, all(field.end), a);
  const Lanes r1 = hn::IfThenElse(cut_hi, all(field.end), b);
  const auto straddles = hn::And(lo<none, hi> none);
  const Lanes both = hn::Abs(hi) * r0 + hn::Abs(lo) * r1;
  const Lanes above = hn::IfThenElse(straddles, hi * r0 - lo * r1, (hi - lo) * hn::Abs(hi + lo));
  const Lanes below = r0 * r1 * hn::IfThenElse(straddles, square, both);
  const Lanes sum = above / below - (hi - lo) * all(field.edge);
  return hn::IfThenElse(hi > lo, sum, none);
}

// Returns the tilt of a foot print, which crushes even without motion.
HWY_INLINE Lanes printOf(const TreadLine& line, Lanes square) {
  const Lanes none = hn::Zero(Tag()), one = all(1.0);
  const Lanes outside = (square - all(line.square_radius)) * all(line.per_print);
  const Lanes u = hn::Min(one, hn::Max(none, outside));
  return one - u * u * (all(3.0) - all(2.0) * u);
}

// Returns the tilt by the dose of this pass or by the print.
HWY_INLINE Lanes tiltOf(const TreadLine& line, Lanes dose, Lanes square) {
  Lanes part = dose * all(line.per_full);
  const auto printed = hn::And(dose < all(line.enough), square < all(line.square_print));
  if (!hn::AllFalse(Tag(), printed))
    part = hn::IfThenElse(printed, hn::Max(part, printOf(line, square)), part);
  return all(BEND_LIMIT) * hn::Min(all(1.0), all(line.load) * part);
}

// Appends the pressed nodes with masks, since branches on them would be mispredicted.
HWY_INLINE void append(Mask pressed, std::uint64_t place, Lanes tilt, TreadPresses& out) {
  const Tag tag;
  HWY_ALIGN double tilts[TreadBand::PITCH];
  std::uint8_t bits[8] = {};
  hn::Store(tilt, tag, tilts);
  hn::StoreMaskBits(tag, pressed, bits);
  std::uint64_t* const places = out.places.data();
  double* const all_tilts = out.tilts.data();
  std::size_t count = out.count;
  for (std::size_t i = 0; i < hn::Lanes(tag); ++i) {
    places[count] = place + i;
    all_tilts[count] = tilts[i];
    count += bits[0] >> i & 1;
  }
  out.count = count;
}

void measureRow(const TreadLine& line, const TreadGrid& grid, const TreadBand& band, int row,
                TreadPresses& out) {
  const Tag tag;
  const CompactField::Parts& field = line.field.parts();
  const int step = static_cast<int>(hn::Lanes(tag)), first = band.first_column;
  const TreadSpan span = spanIn(band, line, grid, row);
  const TreadRow beside(field, grid, row);
  const Lanes reach = all(field.square_reach), most = all(grid.last_column);
  const Lanes steps = hn::Iota(tag, 0.0);
  double* const doses = band.dosesOf(row);
  for (int i = (span.first - first) / step * step; i <= span.last - first; i += step) {
    const Lanes column = all(first + i) + steps;
    const LanesPlace place = placeOf(beside, field.length, column);
    const auto on_map = hn::And(column >= hn::Zero(tag), column <= most);
    const auto touched = hn::And(place.square < reach, on_map);
    if (hn::AllFalse(tag, touched)) {
      hn::StoreU(hn::Zero(tag), tag, doses + i);
      continue;
    }
    Lanes dose = hn::LoadU(tag, doses + i);
    // A dose above `enough` does not increase the tilt.
    const auto grows = hn::And(dose < all(line.enough), touched);
    if (!hn::AllFalse(tag, grows)) dose = hn::IfThenElse(grows, dose + fieldAt(field, place), dose);
    const auto ends = place.end * place.end + place.side * place.side < reach;
    const auto stays = hn::And(touched, ends);
    hn::StoreU(hn::IfThenElseZero(stays, dose), tag, doses + i);
    const Lanes tilt = tiltOf(line, dose, place.square);
    const auto pressed = hn::And(touched, tilt >= all(double{CRUNCHED}));
    out.touched += static_cast<int>(hn::CountTrue(tag, touched));
    append(pressed, packed(row, first + i), tilt, out);
  }
}

#endif

void measure(const TreadLine& line, const TreadGrid& grid, const TreadBand& band,
             TreadPresses& out) {
  for (int row = band.first_row; row < band.first_row + band.rows; ++row)
    measureRow(line, grid, band, row, out);
}

}  // namespace
}  // namespace vegetation_sim::grass::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::grass {

HWY_EXPORT(measure);

TreadLine::TreadLine(const CompactField& segment, const TreadLaw& law, double full)
    : field(segment),
      per_full(1.0 / full),
      enough(full / std::max(law.load, 1e-9)),
      load(law.load),
      square_radius(law.radius * law.radius),
      square_print(2.25 * square_radius),
      per_print(1.0 / (square_print - square_radius)) {
  const CompactField::Parts& f = field.parts();
  const Point p0 = f.p0, p1{p0.x + f.length * f.along.x, p0.y + f.length * f.along.y};
  low = {std::min(p0.x, p1.x), std::min(p0.y, p1.y)};
  high = {std::max(p0.x, p1.x), std::max(p0.y, p1.y)};
  constexpr double FLAT = 1e-3;  // a segment this flat lies in its row
  const bool is_steep = std::fabs(f.along.y) > FLAT;
  slant = is_steep ? f.along.x / f.along.y : 0.0;
  widening = is_steep ? std::sqrt(f.square_reach) / std::fabs(f.along.y) : 1e9;
}

TreadSpan TreadLine::spanOf(const TreadGrid& grid, int row) const {
  constexpr double HAIR = 1e-9;  // margin for rounding
  const double y = grid.y(row);
  const double over = std::max(0.0, std::max(low.y - y, y - high.y));
  const double half = std::sqrt(std::max(0.0, field.parts().square_reach - over * over)) + HAIR;
  const double middle = field.parts().p0.x + (y - field.parts().p0.y) * slant;
  const double first = std::max(low.x - half, middle - widening - HAIR);
  const double last = std::min(high.x + half, middle + widening + HAIR);
  return {std::max(0, floorOf((first - grid.origin_x) * grid.per_spacing)),
          std::min(grid.last_column, floorOf((last - grid.origin_x) * grid.per_spacing) + 1)};
}

void measureBand(const TreadLine& line, const TreadGrid& grid, const TreadBand& band,
                 TreadPresses& out) {
  // There is room for one more vector, since whole ones are written.
  const std::size_t room = static_cast<std::size_t>(band.rows) * band.pitch + TreadBand::PITCH;
  if (out.places.size() < room) {
    out.places.resize(room);
    out.tilts.resize(room);
  }
  out.count = 0;
  out.touched = 0;
  HWY_DYNAMIC_DISPATCH(measure)(line, grid, band, out);
}

}  // namespace vegetation_sim::grass
#endif
