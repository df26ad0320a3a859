// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/forest_inputs.h"

#include <cmath>

#include <algorithm>

#include "vegetation_sim/ros/forest_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_WINDS = 256;

/// Copies fields out under their names, or in from them.
class FieldCopier : public FieldVisitor {
 public:
  explicit FieldCopier(std::map<std::string, double>& values, bool out)
      : values_(values), out_(out) {}
  void number(const char* name, double& value, const char*, Range) override { copy(name, value); }
  void integer(const char* name, int& value, const char*, Range) override {
    double number_value = value;
    copy(name, number_value);
    const bool whole = std::fabs(number_value) < 1e9 && std::floor(number_value) == number_value;
    value = whole ? static_cast<int>(number_value) : -1;  // below every range
  }
  void vector(const char*, Vec3&, const char*, Range) override {}
  void choice(const char*, int&, const std::vector<std::string>&) override {}

 private:
  void copy(const char* name, double& value) {
    const auto found = values_.find(name);
    if (out_)
      values_[name] = value;
    else if (found != values_.end())
      value = found->second;
  }
  std::map<std::string, double>& values_;
  bool out_;
};

}  // namespace

void describe(FieldVisitor& v, ForestTuning& t) {
  describe(v, t.settings);
  describe(v, t.design);
  v.number("transition", t.transition, "s", {0.01, 60.0});
}

void toEvent(const ForestTuning& tuning, ForestEvent& event) {
  std::map<std::string, double> values;
  FieldCopier copier(values, true);
  ForestTuning copy = tuning;
  describe(copier, copy);
  event.kind = ForestEvent::SETTINGS;
  for (const auto& [name, value] : values) {
    event.names.push_back(name);
    event.values.push_back(value);
  }
}

ForestTuning tuningOf(const ForestEvent& event) {
  if (event.names.size() != event.values.size())
    throw InvalidInput("event: " + std::to_string(event.names.size()) + " names for " +
                       std::to_string(event.values.size()) + " values");
  ForestTuning out;
  std::map<std::string, double> known, values;
  FieldCopier reader(known, true);
  describe(reader, out);
  Faults faults;
  for (std::size_t i = 0; i < event.names.size(); ++i) {
    if (!known.count(event.names[i])) faults.add("event: " + event.names[i] + " is not known");
    values[event.names[i]] = event.values[i];
  }
  FieldCopier writer(values, false);
  describe(writer, out);
  FieldChecker checker("event: ", faults);
  describe(checker, out);
  faults.throwIfAny();
  return out;
}

// Only the last word of its kind, and of each viewer, counts at a tick.
void ForestInputs::addLast(const ForestEvent& event) {
  if (replay_) return;
  for (ForestEvent& waiting : waiting_) {
    if (waiting.kind != event.kind || waiting.viewer.id != event.viewer.id) continue;
    waiting = event;
    return;
  }
  if (waiting_.size() < MOST_WAITING)
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
  if (event.kind == ForestEvent::MOVE || event.kind == ForestEvent::BODY)
    for (ForestEvent& waiting : waiting_) {
      if (waiting.kind != event.kind || waiting.header.stamp != event.header.stamp ||
          waiting.grab.id != event.grab.id || waiting.body.id != event.body.id)
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
    return event.kind >= ForestEvent::GRAB && event.kind <= ForestEvent::RELEASE &&
           event.grab.id == id;
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
