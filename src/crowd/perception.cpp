// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/crowd/perception.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim::crowd {
namespace {

constexpr int MOST_CANDIDATES = 48;

// That is no disc. Without initial values: most of the list stays unused.
struct Candidate {
  double bound;  ///< of the gap, from circles
  const Obstacle* obstacle;
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

  std::array<Candidate, MOST_CANDIDATES> list;
  int count{0};
  double beyond;
};

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

// Collects what a walker sees. Discs are measured at once, the rest when all are known.
class Look {
 public:
  Look(const Walker& walker, double range, int most, View& view)
      : walker_(walker), range_(range), most_(most), view_(view), others_(range) {
    view_.beyond = range;
  }

  void disc(const Point& place, double radius, const Point& velocity, Seen kind,
            std::uint32_t index) {
    double gap;
    if (!isNear(place, radius, gap)) return;
    keep({kind, index, gap, gap, {}, velocity, nullptr, place, radius}, most_, range_, view_);
  }
  void other(const Obstacle& obstacle, const Point& place, double reach, Seen kind,
             std::uint32_t index) {
    double bound;
    if (isNear(place, reach, bound)) others_.add({bound, &obstacle, kind, index});
  }
  void finish() {
    for (int i = 0; i < view_.count; ++i) {
      Sight& sight = view_.sights[static_cast<std::size_t>(i)];
      const Point to = sight.place - walker_.position;
      const double apart = length(to);
      if (apart > 0.0) sight.normal = (1.0 / apart) * to;
    }
    view_.beyond = std::min(view_.beyond, others_.beyond);
    for (int i = 0; i < others_.count; ++i) {
      const Candidate& candidate = others_.list[static_cast<std::size_t>(i)];
      const bool full = view_.count == most_;
      if (full && candidate.bound > view_.at(most_ - 1).gap) {
        view_.beyond = std::min(view_.beyond, candidate.bound);
        break;
      }
      const double enough = full ? view_.at(most_ - 1).gap : range_;
      keep(sightOf(walker_, *candidate.obstacle, candidate.kind, candidate.index, enough), most_,
           range_, view_);
    }
  }

 private:
  // What is farther than what is known to be out of view changes nothing.
  bool isNear(const Point& place, double reach, double& gap) const {
    const double far = view_.beyond + walker_.radius + reach;
    const Point to = place - walker_.position;
    const double square = dot(to, to);
    if (square > far * far) return false;
    gap = std::sqrt(square) - walker_.radius - reach;
    return true;
  }

  const Walker& walker_;
  double range_;
  int most_;
  View& view_;
  Candidates others_;
};

}  // namespace

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
      // Columns are neighbours in memory too, up to where the grid repeats itself.
      const std::uint32_t first = bucketOf(c, r), left = mask_ + 1 - (first & mask_);
      const std::uint32_t run = std::min(static_cast<std::uint32_t>(column + 2 - c), left);
      for (std::uint32_t i = starts_[first]; i < starts_[first + run]; ++i) visit(spots_[i]);
      c += run;
    }
}

View perceive(const Walker& walker, std::uint32_t self, const Surroundings& around,
              double sensor_range, int most) {
  View out;
  Look look(walker, sensor_range, most, out);
  around.walkers->visitNear(walker.position, [&](const WalkerGrid::Spot& s) {
    if (s.index != self) look.disc(s.position, s.radius, s.velocity, Seen::WALKER, s.index);
  });
  const Obstacle* still = around.still->obstacles().data();
  around.still->visitNear(walker.position, sensor_range + walker.radius,
                          [&](const ObstacleGrid::Spot& s) {
                            if (s.is_disc)
                              look.disc(s.centre, s.reach, {}, Seen::STATIC, s.index);
                            else
                              look.other(still[s.index], s.centre, s.reach, Seen::STATIC, s.index);
                          });
  for (std::uint32_t i = 0; i < around.robots->size(); ++i) {
    const Obstacle& o = (*around.robots)[i];
    if (o.isDisc())
      look.disc(o.centre(), o.reach, o.velocity, Seen::ROBOT, i);
    else
      look.other(o, o.centre(), o.reach, Seen::ROBOT, i);
  }
  look.finish();
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
