// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/shards/waiting_borders.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_BORDERS = 100;  // of one shard that wait for their tick

Nanoseconds stampOf(const CrowdBorder& border) {
  return fromMsg(border.header.stamp);
}

std::size_t bytesOf(const std::vector<CrowdBorder>& borders) {
  std::size_t out = 0;
  for (const CrowdBorder& one : borders) out += one.border.size();
  return out;
}

// The border of a message, and before it that after the tick before, if it has a later stamp than
// `last`.
std::vector<CrowdBorder> split(const CrowdBorder& message, std::optional<Nanoseconds> last) {
  std::vector<CrowdBorder> out;
  CrowdBorder newer = message, previous = message;
  newer.previous_stamp = previous.previous_stamp = ros::Time();
  newer.previous_border.clear();
  previous.header.stamp = message.previous_stamp;
  previous.border = std::exchange(previous.previous_border, {});
  const bool continues = !last || *last < stampOf(previous);
  if (!previous.border.empty() && stampOf(previous) < stampOf(newer) && continues)
    out.push_back(std::move(previous));
  out.push_back(std::move(newer));
  return out;
}

// Appends borders after those that are older.
void append(std::vector<CrowdBorder> borders, std::vector<CrowdBorder>& all) {
  const Nanoseconds first = stampOf(borders.front());
  while (!all.empty() && stampOf(all.back()) >= first) all.pop_back();
  all.insert(all.end(), std::make_move_iterator(borders.begin()),
             std::make_move_iterator(borders.end()));
  if (all.size() > MOST_BORDERS) all.erase(all.begin(), all.end() - MOST_BORDERS);
}

}  // namespace

WaitingBorders::WaitingBorders(const Shard& shard, std::size_t most_bytes)
    : shard_(shard), most_bytes_(most_bytes) {
  for (std::uint32_t i = 0; i < shard_.count; ++i)
    if (i != shard_.index) expected_.insert(i);
}

void WaitingBorders::beginTick(Nanoseconds before, Nanoseconds now) {
  before_ = before;
  now_ = now;
}

void WaitingBorders::add(const CrowdBorder& message) {
  const std::uint32_t shard = message.shard;
  if (shard == shard_.index || shard >= shard_.count || message.shards != shard_.count) return;
  const Nanoseconds stamp = stampOf(message);
  if (now_ != 0 && stamp > now_ + fromSeconds(MOST_AHEAD)) return;
  if (message.border.size() + message.previous_border.size() > most_bytes_) {
    ++dropped_;
    return;
  }
  Sent& sent = sent_[shard];
  std::vector<CrowdBorder> borders = split(message, sent.newest);
  if (sent.has_to_jump && stampOf(borders.front()) >= now_) return;
  sent.has_to_jump = false;
  if (sent.newest && stamp < *sent.newest && stamp < before_) {
    append(split(message, {}), sent.after_jump);
    while (dropOneTooMany()) {
    }
    return;
  }
  sent.after_jump.clear();
  sent.newest = stamp;
  append(std::move(borders), sent.waiting);
  expected_.insert(shard);
  while (dropOneTooMany()) {
  }
}

// Drops the oldest border of the shard with most bytes, so that none takes the room of the others.
bool WaitingBorders::dropOneTooMany() {
  std::size_t all = 0, most = 0;
  std::vector<CrowdBorder>* largest = nullptr;
  for (auto& entry : sent_)
    for (auto* borders : {&entry.second.waiting, &entry.second.after_jump}) {
      const std::size_t bytes = bytesOf(*borders);
      all += bytes;
      if (bytes > most) largest = borders;
      most = std::max(most, bytes);
    }
  if (all <= most_bytes_ || !largest) return false;
  largest->erase(largest->begin());
  ++dropped_;
  return true;
}

bool WaitingBorders::hasCome(std::uint32_t shard) const {
  const auto found = sent_.find(shard);
  return found != sent_.end() && found->second.newest && *found->second.newest >= before_;
}

bool WaitingBorders::hasAll() const {
  return std::all_of(expected_.begin(), expected_.end(),
                     [this](std::uint32_t shard) { return hasCome(shard); });
}

bool WaitingBorders::isAnyAhead() const {
  return std::any_of(sent_.begin(), sent_.end(), [this](const auto& entry) {
    return entry.second.newest && *entry.second.newest > now_;
  });
}

std::size_t WaitingBorders::dropLate() {
  std::size_t out = 0;
  for (auto shard = expected_.begin(); shard != expected_.end();) {
    const bool has_come = hasCome(*shard);
    out += has_come ? 0 : 1;
    shard = has_come ? std::next(shard) : expected_.erase(shard);
  }
  return out;
}

std::vector<CrowdBorder> WaitingBorders::take() {
  std::vector<CrowdBorder> out;
  for (auto& entry : sent_) {
    std::vector<CrowdBorder>& waiting = entry.second.waiting;
    const auto later = std::find_if(waiting.begin(), waiting.end(), [this](const CrowdBorder& one) {
      return stampOf(one) >= now_;
    });
    if (later == waiting.begin()) continue;
    out.push_back(std::move(*std::prev(later)));
    waiting.erase(waiting.begin(), later);
  }
  return out;
}

void WaitingBorders::jumpBack() {
  for (std::uint32_t i = 0; i < shard_.count; ++i) {
    if (i == shard_.index) continue;
    expected_.insert(i);
    Sent& sent = sent_[i];
    const bool had_sent = sent.newest.has_value();
    sent.waiting = std::exchange(sent.after_jump, {});
    sent.newest.reset();
    if (!sent.waiting.empty()) sent.newest = stampOf(sent.waiting.back());
    sent.has_to_jump = had_sent && sent.waiting.empty();
  }
}

}  // namespace vegetation_sim
