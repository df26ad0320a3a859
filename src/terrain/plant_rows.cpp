// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/plant_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::terrain {
namespace {

constexpr Range ANYWHERE{-1e6, 1e6};  // [m]
constexpr double ENDLESS = std::numeric_limits<double>::infinity();
constexpr double ROUNDING = 1e-9;  // [m] by which a place may be outside an interval
constexpr int HALVINGS = 50;       // of a step along a slope

enum RowDraw : std::uint64_t { GAP, ALONG, ACROSS, YAW, SCALE, GROWTH };

/// A number along or across the rows [m].
struct Interval {
  double low, high;
};

/// A row of the field, or a place of a row.
struct Line {
  int number;
  double at;  // [m]
};

std::uint64_t indexOf(int number) {
  return static_cast<std::uint64_t>(number < 0 ? -2LL * number - 1 : 2LL * number);
}

class Planter {
 public:
  Planter(const RowLaw& law, const HeightMap& ground, std::uint64_t seed, int most)
      : law_(law), ground_(ground), random_(seed), most_(most), turn_(sinCos(law.heading)) {
    for (const Vec3& corner : law.polygon) {
      const Vec3 off = corner - law.origin;
      corners_.push_back({dot(along(), off), dot(across(), off), 0.0});
    }
  }

  std::vector<RowPlant> place() {
    const Interval rows = rowsWithin();
    const int most_rows = corners_.empty() && !(law_.width > 0.0) ? law_.rows : MOST_ROW_PLACES;
    const Vec3 start = law_.headland * along();
    for (const Line& row : linesWithin(rows, corners_.empty() ? start : Vec3::Zero(), across(),
                                       law_.row_spacing, most_rows))
      plantRow(row);
    return std::move(out_);
  }

  int count() const { return count_; }
  bool visitedTooMany() const { return visited_ > MOST_ROW_PLACES; }

 private:
  Vec3 along() const { return {turn_.cos, turn_.sin, 0.0}; }
  Vec3 across() const { return {-turn_.sin, turn_.cos, 0.0}; }

  Interval rowsWithin() const {
    if (corners_.empty()) return {0.0, law_.width > 0.0 ? law_.width : ENDLESS};
    Interval out{ENDLESS, -ENDLESS};
    for (const Vec3& corner : corners_)
      out = {std::min(out.low, corner.y()), std::max(out.high, corner.y())};
    return out;
  }

  // Returns the parts of a row inside the field, without headlands.
  std::vector<Interval> placesWithin(double row) const {
    if (corners_.empty())
      return {{law_.headland, law_.length > 0.0 ? law_.length - law_.headland : ENDLESS}};
    std::vector<double> edges;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vec3 &a = corners_[i], &b = corners_[(i + 1) % corners_.size()];
      if ((a.y() <= row) == (b.y() <= row)) continue;
      edges.push_back(a.x() + (b.x() - a.x()) * (row - a.y()) / (b.y() - a.y()));
    }
    std::sort(edges.begin(), edges.end());
    std::vector<Interval> out;
    for (std::size_t i = 0; i + 1 < edges.size(); i += 2)
      out.push_back({edges[i] + law_.headland, edges[i + 1] - law_.headland});
    return out;
  }

  // Returns the lines within an interval along `direction`; line 0 is at `start`.
  std::vector<Line> linesWithin(const Interval& within, const Vec3& start, const Vec3& direction,
                                double spacing, int most) {
    const double zero = dot(start, direction);
    if (law_.spacing == RowSpacing::HORIZONTAL || ground_.isFlat())
      return evenLines(within, zero, spacing, most);
    std::vector<Line> out;
    const Vec3 foot = law_.origin + start - zero * direction;
    walk(within, {-1, zero}, spacing, most, foot, -direction, out);
    std::reverse(out.begin(), out.end());
    walk(within, {1, zero}, spacing, most, foot, direction, out);
    return out;
  }

  std::vector<Line> evenLines(const Interval& within, double zero, double spacing, int most) {
    const double first = std::ceil((within.low - zero - ROUNDING) / spacing);
    const double last =
        std::min(std::floor((within.high - zero + ROUNDING) / spacing), first + most - 1.0);
    std::vector<Line> out;
    if (!visit(last - first + 1.0)) return out;
    for (double i = first; i <= last; i += 1.0)
      out.push_back({static_cast<int>(i), zero + i * spacing});
    return out;
  }

  // Appends the lines from line 0 (way 1), or from line -1 downwards (way -1).
  void walk(const Interval& within, const Line& way, double spacing, int most, const Vec3& foot,
            const Vec3& direction, std::vector<Line>& out) {
    const double sign = way.number;
    double at = way.at;
    for (int number = 0; static_cast<int>(out.size()) < most; number += way.number) {
      if (sign * at > (sign > 0.0 ? within.high : -within.low) + ROUNDING || !visit(1.0)) return;
      const bool inside = at >= within.low - ROUNDING && at <= within.high + ROUNDING;
      if (inside && (number != 0 || sign > 0.0)) out.push_back({number, at});
      at += sign * stepOf(Vec3(foot + sign * at * direction), direction, spacing);
    }
  }

  // Returns the horizontal distance of the point whose straight distance on the ground is
  // `spacing`.
  double stepOf(const Vec3& from, const Vec3& direction, double spacing) const {
    const double height = ground_.height(from.x(), from.y());
    double low = 0.0, high = spacing;
    for (int i = 0; i < HALVINGS; ++i) {
      const double middle = 0.5 * (low + high);
      const Vec3 there = from + middle * direction;
      const double rise = ground_.height(there.x(), there.y()) - height;
      (middle * middle + rise * rise < spacing * spacing ? low : high) = middle;
    }
    return high;
  }

  void plantRow(const Line& row) {
    const bool counted = corners_.empty() && !(law_.length > 0.0);
    const Vec3 start = row.at * across() + (corners_.empty() ? law_.headland : 0.0) * along();
    const Random random = random_.child(indexOf(row.number));
    for (const Interval& part : placesWithin(row.at))
      for (const Line& place : linesWithin(part, start, along(), law_.plant_spacing,
                                           counted ? law_.plants : MOST_ROW_PLACES))
        plant(row, place, random.child(indexOf(place.number)));
  }

  void plant(const Line& row, const Line& place, const Random& random) {
    if (random.uniform(GAP) < law_.gaps || ++count_ > most_) return;
    RowPlant out;
    out.row = row.number;
    out.place = place.number;
    out.position = law_.origin +
                   (place.at + law_.jitter_along * random.uniform(ALONG, -1.0, 1.0)) * along() +
                   (row.at + law_.jitter_across * random.uniform(ACROSS, -1.0, 1.0)) * across();
    out.yaw = law_.heading + law_.turn * random.uniform(YAW, -1.0, 1.0);
    out.scale = random.uniform(SCALE, law_.smallest, law_.largest);
    out.seed = random.bits(GROWTH);
    out_.push_back(out);
  }

  // Returns false if too many places have been visited.
  bool visit(double places) {
    visited_ += std::max(0.0, places);
    return visited_ <= MOST_ROW_PLACES;
  }

  const RowLaw& law_;
  const HeightMap& ground_;
  Random random_;
  int most_, count_{0};
  SinCos turn_;
  double visited_{0.0};
  std::vector<Vec3> corners_;  // along and across the rows, from the origin [m]
  std::vector<RowPlant> out_;
};

void refuse(YamlSection& section, std::initializer_list<const char*> keys, const char* other) {
  for (const char* key : keys)
    if (section.has(key) && section.has(other))
      section.fault(key, std::string("and ") + other + " are both given; only one is allowed");
}

std::vector<Vec3> readPolygon(YamlSection& section) {
  std::vector<Vec3> out;
  for (YamlSection& entry : section.sections("polygon")) {
    Vec3 corner = Vec3::Zero();
    entry.number("x", corner.x(), "m", ANYWHERE);
    entry.number("y", corner.y(), "m", ANYWHERE);
    entry.finish();
    out.push_back(corner);
  }
  if (section.has("polygon") && (out.size() < 3 || out.size() > MOST_CORNERS))
    section.fault("polygon", "has " + std::to_string(out.size()) + " corners; allowed are 3 to " +
                                 std::to_string(MOST_CORNERS));
  return out;
}

}  // namespace

void describe(FieldVisitor& v, RowLaw& law) {
  v.vector("origin", law.origin, "m", ANYWHERE);
  v.number("heading", law.heading, "rad", {-1000.0, 1000.0});
  v.number("row_spacing", law.row_spacing, "m", {0.05, 1000.0});
  v.number("plant_spacing", law.plant_spacing, "m", {0.01, 1000.0});
  v.choice("spacing", law.spacing, {"horizontal", "slope"});
  v.integer("rows", law.rows, "", {1, 65536});
  v.integer("plants", law.plants, "", {1, 65536});
  v.number("width", law.width, "m", {0.0, 1e5});
  v.number("length", law.length, "m", {0.0, 1e5});
  v.number("headland", law.headland, "m", {0.0, 1000.0});
  v.number("gaps", law.gaps, "", {0.0, 1.0});
  v.number("jitter_along", law.jitter_along, "m", {0.0, 100.0});
  v.number("jitter_across", law.jitter_across, "m", {0.0, 100.0});
  v.number("turn", law.turn, "rad", {0.0, 3.1416});
  v.number("smallest", law.smallest, "", {0.05, 20.0});
  v.number("largest", law.largest, "", {0.05, 20.0});
}

RowLaw readRowLaw(YamlSection& section) {
  RowLaw out;
  describe(section, out);
  out.polygon = readPolygon(section);
  refuse(section, {"rows", "plants", "width", "length"}, "polygon");
  refuse(section, {"rows"}, "width");
  refuse(section, {"plants"}, "length");
  if (out.largest < out.smallest)
    section.fault(rangeFault("largest", out.largest, "", {out.smallest, 20.0}));
  return out;
}

std::vector<RowPlant> placeInRows(const RowLaw& law, const HeightMap& ground, std::uint64_t seed,
                                  int most, YamlSection& section) {
  Planter planter(law, ground, seed, most);
  std::vector<RowPlant> out = planter.place();
  if (planter.visitedTooMany())
    section.fault("has more than " + std::to_string(MOST_ROW_PLACES) +
                  " places in its rows; allowed are 0 to " + std::to_string(MOST_ROW_PLACES));
  else if (planter.count() > most)
    section.fault("has " + std::to_string(planter.count()) +
                  " plants in its rows; allowed are 0 to " + std::to_string(most));
  return out;
}

}  // namespace vegetation_sim::terrain
