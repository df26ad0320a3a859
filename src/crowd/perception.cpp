// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/crowd/perception.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::crowd {
namespace {

constexpr int MOST_CANDIDATES = 48;

// Without initial values: most of the list stays unused.
struct Candidate {
  double bound;              ///< of the gap, from circles
  double x, y, radius;       ///< of a disc, which has no obstacle here
  const Obstacle* obstacle;  ///< null: a disc
  Seen kind;
  std::uint32_t index;
};

bool isBefore(const Candidate& a, const Candidate& b) {
  if (a.bound != b.bound) return a.bound < b.bound;
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.index < b.index;
}

bool isBefore(const Sight& a, const Sight& b) {
  if (a.gap != b.gap) return a.gap < b.gap;
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.index < b.index;
}

// The nearest candidates in order; what does not fit is farther than `beyond`.
struct Candidates {
  std::array<Candidate, MOST_CANDIDATES> list;
  int count{0};
  double beyond;

  explicit Candidates(double range) : beyond(range) {}
  void add(const Candidate& fresh) {
    if (fresh.bound >= beyond) return;
    if (count == MOST_CANDIDATES) {
      beyond = std::max(fresh.bound, list.back().bound);
      if (!isBefore(fresh, list.back())) return;
      --count;
    }
    int at = count++;
    for (; at > 0 && isBefore(fresh, list[static_cast<std::size_t>(at - 1)]); --at)
      list[static_cast<std::size_t>(at)] = list[static_cast<std::size_t>(at - 1)];
    list[static_cast<std::size_t>(at)] = fresh;
  }
};

Sight sightOf(const Walker& walker, const Candidate& c, double enough) {
  Sight out;
  out.kind = c.kind;
  out.index = c.index;
  if (!c.obstacle) {
    const Point to = Point{c.x, c.y} - walker.position;
    const double apart = length(to);
    out.gap = out.lower = c.bound;
    out.is_disc = true;
    out.place = {c.x, c.y};
    out.radius = c.radius;
    if (apart > 0.0) out.normal = (1.0 / apart) * to;
    return out;
  }
  const Separation found = separation(walker.position, walker.radius, *c.obstacle, enough);
  out.gap = found.gap;
  out.lower = found.gap > 0.0 ? found.lower : found.gap;
  out.normal = {found.normal.x(), found.normal.y()};
  if (!found.cores_overlap) return out;
  const Point out_of = wayOut(walker.position, *c.obstacle);
  const double depth = length(out_of);
  out.gap = out.lower = -walker.radius - depth;
  if (depth > 0.0) out.normal = (-1.0 / depth) * out_of;
  return out;
}

// What is not kept is at least as far as its proof says.
void keep(const Sight& sight, int most, double range, View& view) {
  const bool full = view.count == most;
  if (sight.gap >= range || (full && !isBefore(sight, view.at(most - 1)))) {
    view.beyond = std::min(view.beyond, sight.lower);
    return;
  }
  if (full) {
    view.beyond = std::min(view.beyond, view.at(most - 1).lower);
    --view.count;
  }
  int at = view.count++;
  for (; at > 0 && isBefore(sight, view.at(at - 1)); --at)
    view.sights[static_cast<std::size_t>(at)] = view.at(at - 1);
  view.sights[static_cast<std::size_t>(at)] = sight;
}

}  // namespace

std::int64_t WalkerGrid::cellOf(double x) const {
  return static_cast<std::int64_t>(std::floor(x * per_metre_));
}

void WalkerGrid::build(const std::vector<Walker>& walkers, double cell) {
  per_metre_ = 1.0 / cell;
  for (bits_ = 2; bits_ < 12 && (1ULL << (2 * bits_)) < walkers.size(); ++bits_) {
  }
  mask_ = (1U << bits_) - 1;
  starts_.assign((std::size_t{1} << (2 * bits_)) + 1, 0);
  buckets_.resize(walkers.size());
  spots_.resize(walkers.size());
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const Walker& w = walkers[i];
    buckets_[i] = bucketOf(cellOf(w.position.x), cellOf(w.position.y));
    ++starts_[buckets_[i] + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  // Filled from the back, so that the starts end up where they began.
  for (std::size_t i = walkers.size(); i-- > 0;) {
    const Walker& w = walkers[i];
    spots_[--starts_[buckets_[i] + 1]] = {w.position, w.radius, static_cast<std::uint32_t>(i)};
  }
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) starts_[i] = starts_[i + 1];
  starts_.back() = static_cast<std::uint32_t>(walkers.size());
}

template <class Visit>
void WalkerGrid::visitNear(const Point& place, Visit visit) const {
  const std::int64_t column = cellOf(place.x), row = cellOf(place.y);
  for (std::int64_t r = row - 1; r <= row + 1; ++r)
    for (std::int64_t c = column - 1; c <= column + 1; ++c) {
      const std::uint32_t bucket = bucketOf(c, r);
      for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i) visit(spots_[i]);
    }
}

View perceive(const Walker& walker, std::uint32_t self, const Surroundings& around,
              double sensor_range, int most) {
  Candidates candidates(sensor_range);
  const auto offer = [&](const Point& centre, double reach, bool is_disc, const Obstacle* obstacle,
                         Seen kind, std::uint32_t index) {
    const double far = sensor_range + walker.radius + reach;
    const Point to = centre - walker.position;
    const double square = dot(to, to);
    if (square < far * far)
      candidates.add({std::sqrt(square) - walker.radius - reach, centre.x, centre.y, reach,
                      is_disc ? nullptr : obstacle, kind, index});
  };
  const Obstacle* still = around.still->obstacles().data();
  around.still->visitNear(
      walker.position, sensor_range + walker.radius, [&](const ObstacleGrid::Spot& s) {
        offer(s.centre, s.reach, s.is_disc, still + s.index, Seen::STATIC, s.index);
      });
  around.walkers->visitNear(walker.position, [&](const WalkerGrid::Spot& s) {
    if (s.index != self) offer(s.position, s.radius, true, nullptr, Seen::WALKER, s.index);
  });
  for (std::uint32_t i = 0; i < around.robots->size(); ++i) {
    const Obstacle& o = (*around.robots)[i];
    offer(o.centre(), o.reach, o.isDisc(), &o, Seen::ROBOT, i);
  }
  View out;
  out.beyond = candidates.beyond;
  for (int i = 0; i < candidates.count; ++i) {
    const Candidate& candidate = candidates.list[static_cast<std::size_t>(i)];
    const bool full = out.count == most;
    if (full && candidate.bound > out.at(most - 1).gap) {
      out.beyond = std::min(out.beyond, candidate.bound);
      break;
    }
    const Sight sight = sightOf(walker, candidate, full ? out.at(most - 1).gap : sensor_range);
    keep(sight, most, sensor_range, out);
  }
  return out;
}

View perceiveAll(const Walker& walker, std::uint32_t self, const std::vector<Walker>& walkers,
                 const Surroundings& around, double sensor_range, int most) {
  View out;
  out.beyond = sensor_range;
  const auto offer = [&](const Obstacle& o, Seen kind, std::uint32_t index) {
    const Sight sight = sightOf(walker, {0.0, 0.0, 0.0, 0.0, &o, kind, index},
                                std::numeric_limits<double>::infinity());
    keep(sight, most, sensor_range, out);
  };
  const auto& still = around.still->obstacles();
  for (std::uint32_t i = 0; i < still.size(); ++i) offer(still[i], Seen::STATIC, i);
  for (std::uint32_t i = 0; i < around.robots->size(); ++i)
    offer((*around.robots)[i], Seen::ROBOT, i);
  for (std::uint32_t i = 0; i < walkers.size(); ++i)
    if (i != self) offer(discObstacle(walkers[i].position, walkers[i].radius), Seen::WALKER, i);
  return out;
}

}  // namespace vegetation_sim::crowd
