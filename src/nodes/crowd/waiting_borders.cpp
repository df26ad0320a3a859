// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/waiting_borders.h"

#include <algorithm>
#include <utility>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_BORDERS = 100;  // of one shard that wait for their tick

}  // namespace

WaitingBorders::WaitingBorders(const Shard& shard) : shard_(shard) {
  for (std::uint32_t i = 0; i < shard_.count; ++i)
    if (i != shard_.index) expected_.insert(i);
}

void WaitingBorders::add(const CrowdBorder& message) {
  const std::uint32_t shard = message.shard;
  if (shard == shard_.index || shard >= shard_.count || message.shards != shard_.count) return;
  CrowdBorder newer = message, previous = message;
  newer.previous_stamp = previous.previous_stamp = ros::Time();
  newer.previous_border.clear();
  previous.header.stamp = message.previous_stamp;
  previous.border = std::exchange(previous.previous_border, {});
  // A clock that has jumped back sends older borders, which replace the newer.
  const auto last = newest_.find(shard);
  const bool is_first = last == newest_.end();
  const bool continues = is_first || last->second < fromMsg(previous.header.stamp);
  std::vector<CrowdBorder>& waiting = waiting_[shard];
  if (!previous.border.empty() && previous.header.stamp < newer.header.stamp && continues)
    waiting.push_back(std::move(previous));
  newest_[shard] = fromMsg(newer.header.stamp);
  waiting.push_back(std::move(newer));
  if (waiting.size() > MOST_BORDERS) waiting.erase(waiting.begin(), waiting.end() - MOST_BORDERS);
  expected_.insert(shard);
}

bool WaitingBorders::hasAll(Nanoseconds before) const {
  return std::all_of(expected_.begin(), expected_.end(), [&](std::uint32_t shard) {
    const auto found = newest_.find(shard);
    return found != newest_.end() && found->second >= before;
  });
}

std::size_t WaitingBorders::dropLate(Nanoseconds before) {
  std::size_t out = 0;
  for (auto shard = expected_.begin(); shard != expected_.end();) {
    const auto found = newest_.find(*shard);
    const bool has_come = found != newest_.end() && found->second >= before;
    out += has_come ? 0 : 1;
    shard = has_come ? std::next(shard) : expected_.erase(shard);
  }
  return out;
}

std::vector<CrowdBorder> WaitingBorders::take(Nanoseconds now) {
  std::vector<CrowdBorder> out;
  for (auto& [shard, waiting] : waiting_) {
    const auto later = std::find_if(waiting.begin(), waiting.end(), [&](const CrowdBorder& one) {
      return fromMsg(one.header.stamp) >= now;
    });
    if (later == waiting.begin()) continue;
    out.push_back(std::move(*std::prev(later)));
    waiting.erase(waiting.begin(), later);
  }
  return out;
}

}  // namespace vegetation_sim
