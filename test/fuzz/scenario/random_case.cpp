// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/scenario/random_case.h"

#include <cmath>
#include <vector>

#include "fuzz/scenario/simulation.h"

namespace vegetation_sim::fuzz {
namespace {

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;
constexpr int KEY_FRAME_EVERY = 8;

std::vector<std::unique_ptr<Simulation>> makeWorld(Draw& draw, int threads) {
  std::vector<std::unique_ptr<Simulation>> out;
  while (out.empty()) {
    if (draw.chance(0.5)) out.push_back(makeForest(draw, threads));
    if (draw.chance(0.3)) out.push_back(makeMeadow(draw));
    if (draw.chance(0.2)) out.push_back(makeCanopy(draw));
    if (draw.chance(0.4)) out.push_back(makeCrowd(draw, threads));
  }
  return out;
}

/// A clock with a random rate that stands, jumps ahead or jumps back now and then.
class RandomClock {
 public:
  explicit RandomClock(const Random& random)
      : draw_(random), period_(NANOSECONDS_PER_SECOND / (10 + 10 * draw_.below(10))) {}
  /// @return whether time has jumped back. While the clock stands, nodes do nothing.
  bool advance() {
    const double choice = draw_.between(0.0, 1.0);
    stands_ = choice < 0.04;
    if (stands_) return false;
    if (choice < 0.08) stamp_ += fromSeconds(draw_.between(0.0, 3.0));
    if (choice > 0.98) {
      stamp_ -= fromSeconds(draw_.between(0.2, 5.0));
      return true;
    }
    stamp_ += period_;
    return false;
  }
  bool stands() const { return stands_; }
  Nanoseconds stamp() const { return stamp_; }

 private:
  bool stands_{false};
  Draw draw_;
  Nanoseconds period_, stamp_{START};
};

void act(Simulation& simulation, Draw& draw, Nanoseconds stamp, CaseOutcome& outcome) {
  ++outcome.requests;
  try {
    simulation.act(draw, stamp);
  } catch (const InvalidInput&) {
    ++outcome.rejected;
  }
}

}  // namespace

void requireWithin(double value, double limit, const char* what) {
  if (!(std::fabs(value) <= limit))
    throw Divergence(std::string(what) + " = " + std::to_string(value) + " is outside +- " +
                     std::to_string(limit));
}

CaseOutcome runCase(std::uint64_t seed, std::uint64_t number, int threads) {
  const Random random = Random(seed).child(number);
  Draw layout(random.child(0)), events(random.child(1)), losses(random.child(2));
  RandomClock clock(random.child(3));
  const auto world = makeWorld(layout, threads);
  CaseOutcome out;
  Hash hash;
  bool windy = false;
  const int ticks = 15 + events.below(25);
  for (; out.ticks < ticks; ++out.ticks) {
    if (clock.advance())
      for (const auto& part : world) part->restart();
    if (clock.stands()) continue;
    if (!windy || events.chance(0.05)) {
      windy = true;
      const wind::Field wind = randomWind(events, clock.stamp());
      for (const auto& part : world) part->setWind(wind);
    }
    for (const auto& part : world) {
      while (events.chance(0.4)) act(*part, events, clock.stamp(), out);
      part->advance(clock.stamp(), out.ticks % KEY_FRAME_EVERY == 0, losses.chance(0.1));
      part->verify();
      hash.add(part->hash());
    }
  }
  out.hash = hash.value();
  return out;
}

}  // namespace vegetation_sim::fuzz
