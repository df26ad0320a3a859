// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/forest_inputs.h"

#include <algorithm>
#include <utility>

#include "core/config/field_values.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_WINDS = 256;

}  // namespace

void describe(FieldVisitor& v, ForestTuning& t) {
  describe(v, t.settings);
  describe(v, t.design);
  v.number("transition", t.transition, "s", {0.01, 60.0});
}

void toEvent(const ForestTuning& tuning, ForestEvent& event) {
  NamedValues named = namedValues(tuning);
  event.kind = ForestEvent::SETTINGS;
  event.names = std::move(named.names);
  event.values = std::move(named.values);
}

ForestTuning tuningOf(const ForestEvent& event) {
  return fromNamedValues<ForestTuning>({event.names, event.values});
}

// Only the last word of its kind, and of each viewer, counts at a tick.
void ForestInputs::addLast(const ForestEvent& event) {
  if (replay_) return;
  for (ForestEvent& waiting : waiting_) {
    if (waiting.kind != event.kind || waiting.viewer.id != event.viewer.id) continue;
    waiting = event;
    return;
  }
  // One of each other kind always finds room, however many requests wait.
  if (event.kind != ForestEvent::VIEWER || waiting_.size() < MOST_WAITING)
    waiting_.push_back(event);
  else
    ++losses_.lost;
}

void ForestInputs::addViewer(const Viewer& viewer_in_world) {
  ForestEvent event;
  event.kind = ForestEvent::VIEWER;
  event.viewer = viewer_in_world;
  addLast(event);
}

void ForestInputs::addTuning(const ForestTuning& tuning) {
  ForestEvent event;
  toEvent(tuning, event);
  addLast(event);
}

void ForestInputs::addReset() {
  ForestEvent event;
  event.kind = ForestEvent::RESET;
  addLast(event);
}

void ForestInputs::addInteraction(const ForestEvent& event) {
  if (replay_) return;
  if (event.kind == ForestEvent::MOVE || event.kind == ForestEvent::RENEW)
    for (ForestEvent& waiting : waiting_) {
      if (waiting.kind != event.kind || waiting.header.stamp != event.header.stamp ||
          waiting.grab.id != event.grab.id)
        continue;
      waiting = event;
      return;
    }
  if (waiting_.size() >= MOST_WAITING)
    throw InvalidInput(std::to_string(MOST_WAITING) + " requests wait for the next tick already");
  waiting_.push_back(event);
}

void ForestInputs::addFirst(const ForestEvent& event) {
  if (!replay_) waiting_.push_front(event);
}

void ForestInputs::forgetGrab(std::uint32_t id) {
  const auto about = [&](const ForestEvent& event) {
    return event.grab.id == id;  // 0 in all other kinds
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), about), waiting_.end());
}

void ForestInputs::addWind(wind::Field wind) {
  ForestEvent event;
  event.kind = ForestEvent::WIND;
  event.wind_hash = wind.hash();
  wind_order_.erase(std::remove(wind_order_.begin(), wind_order_.end(), event.wind_hash),
                    wind_order_.end());
  wind_order_.push_back(event.wind_hash);
  winds_[event.wind_hash] = std::move(wind);
  if (wind_order_.size() > MOST_WINDS) {
    winds_.erase(wind_order_.front());
    wind_order_.pop_front();
  }
  addLast(event);
}

void ForestInputs::addEvent(const ForestEvent& event) {
  if (!replay_) return;
  if (waiting_.size() >= MOST_WAITING) {
    waiting_.pop_front();
    ++losses_.lost;
  }
  waiting_.push_back(event);
}

void ForestInputs::startAnew(Nanoseconds now) {
  const auto outdated = [&](const ForestEvent& event) {
    if (replay_) return fromMsg(event.header.stamp) > now;
    return event.kind == ForestEvent::VIEWER || event.kind >= ForestEvent::GRAB;
  };
  waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), outdated), waiting_.end());
}

std::vector<ForestEvent> ForestInputs::take(Nanoseconds stamp) {
  std::vector<ForestEvent> out;
  std::deque<ForestEvent> later;
  for (ForestEvent& event : waiting_) {
    if (fromMsg(event.header.stamp) > stamp) {
      later.push_back(std::move(event));
      continue;
    }
    if (replay_ && fromMsg(event.header.stamp) < stamp) ++losses_.late;
    event.header.stamp = toStamp(stamp);
    out.push_back(std::move(event));
  }
  waiting_ = std::move(later);
  return out;
}

std::optional<wind::Field> ForestInputs::windOf(const ForestEvent& event) const {
  const auto found = winds_.find(event.wind_hash);
  if (found == winds_.end()) return std::nullopt;
  return found->second;
}

}  // namespace vegetation_sim
