// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "crowd/agents/crowd.h"
#include "crowd/body/gait.h"
#include "reference/crowd/paper_decision.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double PATIENCE = 4.0;        // time without progress before a detour [s]
constexpr double LONG_PATIENCE = 10.0;  // the same where only trunks can be in the way [s]
constexpr Nanoseconds LOOK_PERIOD = NANOSECONDS_PER_SECOND;
constexpr double NEARER = 0.5;            // distance that counts as progress [m]
constexpr double THRONG = 1.0;            // time in a throng before stepping aside [s]
constexpr double SLOW = 0.25;             // share of the wanted speed that counts as a throng
constexpr double ASIDE = -1.9;            // direction of stepping aside, relative to the goal [rad]
constexpr double GIVE_UP = 30.0;          // time without progress before another goal [s]
constexpr int DRAWS = 8;                  // attempts to draw a free goal
constexpr std::size_t FEW = 256;          // One thread steps fewer walkers.
constexpr std::size_t AHEAD = 4;          // walkers ahead for which memory is prefetched
constexpr double JUST_SAFE = 1.0 - 1e-9;  // share of a safe distance, for rounding
constexpr double GETTING_OUT = 0.1;       // step out of an overlap, as a share of the radius
constexpr double STANDS_STILL = 0.05;     // slower than this the body does not turn [m/s]

// Prefetches neighbours, which may be anywhere in memory.
void prefetch(const Walker& walker) {
  constexpr std::size_t LINE = 64;
  const char* begin = reinterpret_cast<const char*>(&walker);
  for (std::size_t at = 0; at < sizeof(Walker); at += LINE) __builtin_prefetch(begin + at, 1);
}

}  // namespace

/// Inputs of all walkers during a tick.
struct Crowd::Tick {
  Nanoseconds before{0}, stamp{0};
  double dt{0.0};
  Surroundings around;
};

template <class Each>
void Crowd::forAll(std::size_t count, Each each) const {
  const auto range = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) each(i);
  };
  if (count < FEW) return range(0, count);
  threads_->runRanges(count, range);
}

void Crowd::advance(Nanoseconds stamp) {
  const double dt = memory_.begun ? secondsBetween(memory_.stamp, stamp) : 0.0;
  if (memory_.begun && !(dt > 0.0)) return;
  const Tick tick{memory_.stamp, stamp, dt, {&still_, &grid_, &robots_}};
  memory_.stamp = stamp;
  memory_.begun = true;
  if (dt == 0.0) return;
  updateSurroundings();
  findAims();
  // Neighbours are processed one after the other, since they share data in the cache.
  const auto& spots = grid_.spots();
  const auto index_of = [&](std::size_t i) {
    return index_.empty() ? std::size_t{spots[i].index} : index_[spots[i].index];
  };
  forAll(spots.size(), [&](std::size_t i) {
    const std::size_t ahead = i + AHEAD < spots.size() ? index_of(i + AHEAD) : NOT_HERE;
    if (ahead != NOT_HERE) prefetch(memory_.walkers[ahead]);
    const std::size_t index = index_of(i);
    if (index != NOT_HERE) stepOne(index, spots[i].index, tick, memory_.walkers[index]);
  });
  memory_.ways = ways_.progress();
}

void Crowd::updateSurroundings() {
  mergeOthers();
  const std::vector<Walker>& walkers = index_.empty() ? memory_.walkers : all_;
  robots_.clear();
  for (const auto& entry : memory_.robots) robots_.push_back(obstacleOf(entry.second));
  double widest = 0.0;
  for (const Walker& w : walkers) widest = std::max(widest, w.radius);
  grid_.build(walkers, memory_.settings.sensor_range + 2.0 * widest);
}

// The order by ids is that of one crowd, which decides between obstacles at equal distances.
void Crowd::mergeOthers() {
  all_.clear();
  index_.clear();
  if (others_.empty()) return;
  std::size_t own = 0;
  const auto add_own = [&](std::uint32_t end) {
    for (; own < memory_.walkers.size() && memory_.walkers[own].id < end; ++own) {
      all_.push_back(memory_.walkers[own]);
      index_.push_back(own);
    }
  };
  for (const Walker& other : others_) {
    add_own(other.id);
    all_.push_back(other);
    index_.push_back(NOT_HERE);
  }
  add_own(UINT32_MAX);
}

void Crowd::findAims() {
  const std::vector<Walker>& walkers = memory_.walkers;
  const bool by_paper = memory_.settings.behaviour == Behaviour::PAPER;
  std::vector<std::size_t> asking;
  aims_.resize(walkers.size());
  queries_.clear();
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const Walker& w = walkers[i];
    aims_[i] = w.goal;
    if (by_paper || !w.detours || !w.has_goal || w.arrived) continue;
    WayQuery query;
    query.from = w.position;
    query.goal = w.goal;
    queries_.push_back(query);
    asking.push_back(i);
  }
  forAll(queries_.size(), [this](std::size_t i) { ways_.look(queries_[i]); });
  ways_.assign(queries_);
  forAll(queries_.size(), [this](std::size_t i) { ways_.follow(queries_[i]); });
  ways_.extend(queries_);
  for (std::size_t i = 0; i < queries_.size(); ++i) aims_[asking[i]] = queries_[i].aim;
}

void Crowd::chooseGoal(Walker& w) const {
  const Area& area = memory_.area;
  const Random random = Random(w.key).child(1 + std::uint64_t{w.goals});
  for (std::uint64_t i = 0; i < DRAWS; ++i) {
    w.goal = {random.uniform(2 * i, area.min_x, area.max_x),
              random.uniform(2 * i + 1, area.min_y, area.max_y)};
    const PlanRaster& raster = ways_.raster();
    if (raster.empty() || !raster.isBlocked(raster.cellAt(w.goal))) break;
  }
  ++w.goals;
  w.has_goal = true;
  w.arrived = w.detours = false;
  w.nearest_goal = 1e9;
  w.no_progress = 0.0;
}

// Returns the wanted motion before perception. Standing walkers keep their front.
Wish Crowd::wishOf(Walker& w, const Point& front, std::size_t index) const {
  Wish out{front, 0.0};
  const auto pace = [&] {
    return paceAt(w.position, out.direction, *terrain_, resistance_, memory_.settings);
  };
  const auto behaviour = static_cast<Behaviour>(memory_.settings.behaviour);
  if (!w.has_goal && w.wanders) {
    if (behaviour == Behaviour::GOAL)
      chooseGoal(w);
    else
      out.speed = w.speed;  // walkers of PAPER walk on
  }
  if (!w.has_goal || w.arrived) {
    out.speed *= pace();
    return out;
  }
  // A walker that has just chosen a goal makes no detour: aims_ still has the aim of the last goal.
  const Point to = (w.detours ? aims_[index] : w.goal) - w.position;
  const double way = length(to);
  if (way > 0.0) out.direction = (1.0 / way) * to;
  const double left = length(w.goal - w.position);
  if (w.held_up < 0.0) {
    const SinCos aside = sinCos(ASIDE);
    out.direction = {aside.cos * out.direction.x - aside.sin * out.direction.y,
                     aside.sin * out.direction.x + aside.cos * out.direction.y};
  }
  out.speed = std::min(w.speed * pace(), 2.0 * left);
  return out;
}

void Crowd::keepSide(int taken, double dt, Walker& w) const {
  if (taken != 0) {
    w.side = taken;
    w.side_left = memory_.settings.commitment;
    return;
  }
  w.side_left = std::max(0.0, w.side_left - dt);
  if (w.side_left == 0.0) w.side = 0;
}

// People who push from all sides block each other: each steps aside to the same hand for a while of
// its own length.
void Crowd::loosen(double wanted, const Tick& tick, Walker& w) const {
  if (w.held_up < 0.0) {
    w.held_up = std::min(0.0, w.held_up + tick.dt);
  } else if (length(w.velocity) < SLOW * wanted) {
    w.held_up += tick.dt;
    if (w.held_up > THRONG)
      w.held_up = -1.0 - 2.0 * Random(w.key).uniform(static_cast<std::uint64_t>(tick.stamp));
  } else {
    w.held_up = 0.0;
  }
}

// Checks whether the goal is reached, and whether the straight way leads there.
void Crowd::reach(const Tick& tick, Walker& w) const {
  if (!w.has_goal || w.arrived) return;
  const double left = length(w.goal - w.position);
  if (left <= memory_.settings.arrival) {
    w.arrived = !w.wanders;
    w.has_goal = !w.wanders;
    return;
  }
  w.no_progress += tick.dt;
  if (left < w.nearest_goal - NEARER) {
    w.nearest_goal = left;
    w.no_progress = 0.0;
  }
  if (w.wanders && w.no_progress > GIVE_UP) w.has_goal = false;
  // The straight way is checked once a second, each walker at another time.
  const auto second = [&](Nanoseconds stamp) {
    return (stamp + static_cast<Nanoseconds>(w.key % static_cast<std::uint64_t>(LOOK_PERIOD))) /
           LOOK_PERIOD;
  };
  const PlanRaster& raster = ways_.raster();
  if (raster.empty() || second(tick.stamp) == second(tick.before)) return;
  const bool is_stuck = w.no_progress > (raster.hasLarge() ? PATIENCE : LONG_PATIENCE);
  w.detours = is_stuck || (raster.hasLarge() && !raster.isClear(w.position, w.goal, true));
}

void Crowd::stepOne(std::size_t index, std::uint32_t rank, const Tick& tick, Walker& w) const {
  const CrowdSettings& s = memory_.settings;
  const bool by_paper = s.behaviour == Behaviour::PAPER;
  const Point front = frontOf(w);
  const Wish wish = wishOf(w, front, index);
  const View view = perceive(w, rank, tick.around, s.sensor_range, s.neighbours);
  int side = 0;
  const Command command = by_paper ? decideByPaper(w, view, s, wish, tick.stamp)
                                   : decideByGoal(w, view, s, wish, tick.stamp, side);
  keepSide(side, tick.dt, w);
  std::array<Limit, View::MOST> limits;
  const int count = limitsOf(rank, view, s, tick.dt, limits);
  const Point velocity = followed(w, front, command, s, tick.dt);
  // A walker that overlaps others moves out by small steps, regardless of other obstacles.
  const bool overlaps = view.count > 0 && view.at(0).gap < 0.0;
  const double farthest =
      std::max(0.5 * JUST_SAFE * view.beyond, overlaps ? GETTING_OUT * w.radius : 0.0);
  const Point step = safeStep(tick.dt * velocity, limits, count, farthest);
  w.position = w.position + step;
  w.velocity = (1.0 / tick.dt) * step;
  const double fastest = 2.0 * w.speed, speed = length(w.velocity);
  // Limits a velocity by pushing.
  if (speed > fastest) w.velocity = (fastest / speed) * w.velocity;
  if (speed > STANDS_STILL) turnTowards(command.direction, front, s, tick.dt, w);
  advanceGait(std::min(length(step), fastest * tick.dt), w);
  if (!by_paper) loosen(wish.speed, tick, w);
  reach(tick, w);
}

double Crowd::deepestOverlap() const {
  double out = 0.0;
  std::vector<Obstacle> robots;
  for (const auto& entry : memory_.robots) robots.push_back(obstacleOf(entry.second));
  WalkerGrid grid;
  double widest = 0.0;
  for (const Walker& w : memory_.walkers) widest = std::max(widest, w.radius);
  grid.build(memory_.walkers, 0.5 + 2.0 * widest);
  const Surroundings around{&still_, &grid, &robots};
  for (std::size_t i = 0; i < memory_.walkers.size(); ++i) {
    const View view = perceive(memory_.walkers[i], static_cast<std::uint32_t>(i), around, 0.5, 1);
    if (view.count > 0) out = std::max(out, -view.at(0).gap);
  }
  return out;
}

}  // namespace vegetation_sim::crowd
