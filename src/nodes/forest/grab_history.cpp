// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/grab_history.h"

#include <utility>

#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

const char* describe(std::uint8_t reason) {
  switch (reason) {
    case GrabStatus::RELEASED:
      return " has been released";
    case GrabStatus::LEASE_EXPIRED:
      return " has ended: its lease expired";
    case GrabStatus::TREES_CHANGED:
      return " has ended: the trees were grown anew";
    case GrabStatus::RESET:
      return " has ended by a reset";
    case GrabStatus::REFUSED:
      return " never began: see forest/grabs";
    case GrabStatus::BRANCH_BROKEN:
      return " has ended: the branch, or one that bears it, broke or was cut off";
    default:
      return "";
  }
}

}  // namespace

void GrabHistory::explainAll(std::uint8_t reason) {
  for (const auto& entry : held_) explain(entry.first, reason);
}

void GrabHistory::addEnded(GrabStatus status) {
  ended_.push_back(std::move(status));
  if (ended_.size() > MOST_ENDED) ended_.pop_front();
  changed_ = true;
}

void GrabHistory::addUnheld(std::uint32_t id, std::uint8_t reason, Nanoseconds stamp) {
  const auto explained = reasons_.find(id);
  GrabStatus status;
  status.status = explained != reasons_.end() ? explained->second : reason;
  status.grab.id = id;
  status.until = toStamp(stamp);
  addEnded(std::move(status));
}

bool GrabHistory::update(const forest::HeldGrabs& held, Nanoseconds stamp) {
  for (auto entry = held_.begin(); entry != held_.end();) {
    const auto& [id, last] = *entry;
    if (held.count(id) && !reasons_.count(id)) {
      ++entry;
      continue;
    }
    const auto reason = reasons_.find(id);
    GrabStatus status;
    status.status =
        reason != reasons_.end() ? reason->second : std::uint8_t{GrabStatus::LEASE_EXPIRED};
    status.grab = toMsg(last.grab);
    status.since = toStamp(last.since);
    status.until = toStamp(stamp);
    addEnded(std::move(status));
    entry = held_.erase(entry);
  }
  reasons_.clear();
  for (const auto& [id, grab] : held) {
    const auto [entry, begins] = held_.insert({id, {grab, stamp}});
    entry->second.grab = grab;
    changed_ = changed_ || begins;
  }
  return std::exchange(changed_, false);
}

std::string GrabHistory::describeEnd(std::uint32_t id) const {
  for (const GrabStatus& status : ended_)
    if (status.grab.id == id) return describe(status.status);
  return {};
}

GrabHistory::State GrabHistory::state() const {
  State out;
  for (const auto& [id, held] : held_) out.since[id] = held.since;
  out.ended.assign(ended_.begin(), ended_.end());
  return out;
}

void GrabHistory::restore(const State& state, const forest::HeldGrabs& held) {
  held_.clear();
  reasons_.clear();
  for (const auto& [id, since] : state.since)
    if (held.count(id)) held_.insert({id, {held.at(id), since}});
  ended_.assign(state.ended.begin(), state.ended.end());
  changed_ = true;
}

GrabStatuses GrabHistory::message(Nanoseconds stamp) const {
  GrabStatuses out;
  out.header.stamp = toStamp(stamp);
  for (const auto& entry : held_) {
    const Held& held = entry.second;
    GrabStatus status;
    status.status = GrabStatus::HELD;
    status.grab = toMsg(held.grab);
    status.since = toStamp(held.since);
    status.until = toStamp(held.grab.renewed + fromSeconds(held.grab.lease));
    out.held.push_back(std::move(status));
  }
  out.ended.assign(ended_.begin(), ended_.end());
  return out;
}

}  // namespace vegetation_sim
