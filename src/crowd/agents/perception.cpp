// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/agents/perception.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::crowd {
namespace {

constexpr Point STANDS{};

// A possible obstacle. Members have no initial values, since most of the list stays unused.
struct Candidate {
  double square;             ///< squared distance of the centre
  double bound;              ///< lower bound of the gap from circles; the gap itself for a disc
  const Obstacle* obstacle;  ///< null for a disc
  Point place;
  double radius;  ///< radius of the circle
  const Point* velocity;
  Seen kind;
  std::uint32_t index;
};

// Prefetches all of an obstacle.
void prefetchLines(const Obstacle* obstacle) {
  const char* at = reinterpret_cast<const char*>(obstacle);
  if (at)
    for (std::size_t i = 0; i < sizeof(Obstacle); i += 64) __builtin_prefetch(at + i);
}

bool isBefore(const Sight& a, const Sight& b) {
  if (a.gap != b.gap) return a.gap < b.gap;
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.index < b.index;
}

Sight sightOf(const Walker& walker, const Obstacle& obstacle, Seen kind, std::uint32_t index,
              double enough) {
  Sight out;
  out.kind = kind;
  out.index = index;
  out.velocity = obstacle.velocity;
  out.obstacle = obstacle.isDisc() ? nullptr : &obstacle;
  out.place = obstacle.centre();
  out.radius = obstacle.reach;
  const Separation found = separation(walker.position, walker.radius, obstacle, enough);
  out.gap = found.gap;
  out.lower = found.gap > 0.0 ? found.lower : found.gap;
  out.normal = {found.normal.x(), found.normal.y()};
  if (!found.cores_overlap || !out.obstacle) return out;
  const Point out_of = wayOut(walker.position, obstacle);
  const double depth = length(out_of);
  out.gap = out.lower = -walker.radius - depth;
  if (depth > 0.0) out.normal = (-1.0 / depth) * out_of;
  return out;
}

// Keeps the nearest; the others are at least as far as their bounds.
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

// Collects the candidates of a walker's view, then measures from the nearest on.
class CandidateList {
 public:
  CandidateList(const Walker& walker, double range)
      : walker_(walker), range_(range), room_(range + walker.radius), beyond_(range) {}

  // There is no branch on the distance, since it would be mispredicted. The velocity is read later.
  void offer(const Point& place, double reach, const Point& velocity, const Obstacle* obstacle,
             Seen kind, std::uint32_t index) {
    if (count_ == MOST) dropFarthest();
    const double far = room_ + reach;
    const Point to = place - walker_.position;
    const double square = dot(to, to);
    list_[count_] = {square, 0.0, obstacle, place, reach, &velocity, kind, index};
    count_ += square < far * far;
  }

  void measure(int most, View& view) {
    setBounds();
    view.beyond = beyond_;
    for (; count_ > 0; list_[nearest_] = list_[--count_]) {
      const Candidate& c = nearest();
      const bool full = view.count == most;
      if (full && c.bound > view.at(most - 1).gap) {
        view.beyond = std::min(view.beyond, c.bound);
        return;
      }
      const double enough = full ? view.at(most - 1).gap : range_;
      keep(c.obstacle ? sightOf(walker_, *c.obstacle, c.kind, c.index, enough) : discSight(c), most,
           range_, view);
    }
  }

 private:
  static constexpr std::size_t MOST = 48;

  void setBounds() {
    for (std::size_t i = 0; i < count_; ++i) {
      Candidate& c = list_[i];
      c.bound = std::sqrt(c.square) - walker_.radius - c.radius;
      prefetchLines(c.obstacle);
    }
  }
  const Candidate& nearest() {
    nearest_ = 0;
    double least = list_[0].bound;
    for (std::size_t i = 1; i < count_; ++i) {
      nearest_ = list_[i].bound < least ? i : nearest_;
      least = std::min(least, list_[i].bound);
    }
    return list_[nearest_];
  }
  void dropFarthest() {
    setBounds();
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < count_; ++i)
      if (list_[i].bound > list_[farthest].bound) farthest = i;
    beyond_ = std::min(beyond_, list_[farthest].bound);
    list_[farthest] = list_[--count_];
  }
  Sight discSight(const Candidate& c) const {
    const Point to = c.place - walker_.position;
    const double apart = length(to);
    const Point normal = apart > 0.0 ? (1.0 / apart) * to : Point();
    return {c.kind, c.index, c.bound, c.bound, normal, *c.velocity, nullptr, c.place, c.radius};
  }

  const Walker& walker_;
  double range_, room_, beyond_;
  std::array<Candidate, MOST> list_;
  std::size_t count_{0}, nearest_{0};
};

}  // namespace

void WalkerGrid::build(const std::vector<Walker>& walkers, double cell) {
  per_metre_ = 1.0 / cell;
  for (bits_ = 2; bits_ < 12 && (1ULL << (2 * bits_)) < 4 * walkers.size(); ++bits_) {
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
  // Filled from the back, so that the starts end at their final values.
  for (std::size_t i = walkers.size(); i-- > 0;) {
    const Walker& w = walkers[i];
    spots_[--starts_[buckets_[i] + 1]] = {w.position, w.velocity, w.radius,
                                          static_cast<std::uint32_t>(i)};
  }
  for (std::size_t i = 0; i + 1 < starts_.size(); ++i) starts_[i] = starts_[i + 1];
  starts_.back() = static_cast<std::uint32_t>(walkers.size());
}

template <class Visit>
void WalkerGrid::visitNear(const Point& place, Visit visit) const {
  const std::int64_t column = cellOf(place.x), row = cellOf(place.y);
  for (std::int64_t r = row - 1; r <= row + 1; ++r)
    for (std::int64_t c = column - 1; c <= column + 1;) {
      // Columns are neighbours in memory, too, up to the period of the grid.
      const std::uint32_t first = bucketOf(c, r), left = mask_ + 1 - (first & mask_);
      const std::uint32_t run = std::min(static_cast<std::uint32_t>(column + 2 - c), left);
      for (std::uint32_t i = starts_[first]; i < starts_[first + run]; ++i) visit(spots_[i]);
      c += run;
    }
}

View perceive(const Walker& walker, std::uint32_t self, const Surroundings& around,
              double sensor_range, int most) {
  CandidateList candidates(walker, sensor_range);
  around.walkers->visitNear(walker.position, [&](const WalkerGrid::Spot& s) {
    if (s.index != self)
      candidates.offer(s.position, s.radius, s.velocity, nullptr, Seen::WALKER, s.index);
  });
  const Obstacle* still = around.still->obstacles().data();
  around.still->visitNear(
      walker.position, sensor_range + walker.radius, [&](const ObstacleGrid::Spot& s) {
        candidates.offer(s.centre, s.reach, STANDS, s.is_disc ? nullptr : still + s.index,
                         Seen::STATIC, s.index);
      });
  for (std::uint32_t i = 0; i < around.robots->size(); ++i) {
    const Obstacle& o = (*around.robots)[i];
    candidates.offer(o.centre(), o.reach, o.velocity, o.isDisc() ? nullptr : &o, Seen::ROBOT, i);
  }
  View out;
  candidates.measure(most, out);
  return out;
}

View perceiveAll(const Walker& walker, std::uint32_t self, const std::vector<Walker>& walkers,
                 const Surroundings& around, double sensor_range, int most) {
  constexpr double ALL = std::numeric_limits<double>::infinity();
  View out;
  out.beyond = sensor_range;
  const auto offer = [&](const Obstacle& o, Seen kind, std::uint32_t index) {
    keep(sightOf(walker, o, kind, index, ALL), most, sensor_range, out);
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
