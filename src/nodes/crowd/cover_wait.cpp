// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/cover_wait.h"

#include "ros/time/tick_clock.h"

namespace vegetation_sim {

void CoverWait::begin(Nanoseconds tick) {
  if (!first_) first_ = tick;
}

bool CoverWait::hear(Nanoseconds stamp, Nanoseconds now) {
  if (has_jumped_back_ && stamp > now) return false;
  has_jumped_back_ = false;
  if (loaded_ && stamp > *loaded_ - LEAD && stamp <= *loaded_) return false;
  newest_ = stamp;
  backoff_.onMessage();
  return true;
}

bool CoverWait::hasMapOf(Nanoseconds tick) const {
  if (!backoff_.isAwaited() || !first_ || tick < *first_) return true;
  return newest_ && periodOfMap(*newest_) >= periodOfMap(tick);
}

void CoverWait::jumpBack() {
  has_jumped_back_ = true;
  first_.reset();
  newest_.reset();
  loaded_.reset();
}

void CoverWait::onLoaded(Nanoseconds tick) {
  loaded_ = newest_ = tick;
  first_ = grid_.timeOf(grid_.tickAt(tick) + 1);
}

std::int64_t CoverWait::periodOfMap(Nanoseconds stamp) const {
  return periodOf(grid_.tickAt(stamp), rate_, grid_.rate());
}

}  // namespace vegetation_sim
