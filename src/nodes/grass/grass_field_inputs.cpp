// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "nodes/cutters/cut_request.h"
#include "nodes/grass/grass_field.h"
#include "nodes/grass/waiting_areas.h"
#include "ros/services/subscriptions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MOST_AHEAD = 10.0;  // of the cells of another shard [s]

}  // namespace

void GrassField::onWind(const WindField& message) {
  acceptInput("wind", [&] {
    checkFrame(message.header.frame_id, options_.frame_id);
    wind_ = fromMsg(message);
  });
}

TreadEvent GrassField::inWorld(const TreadEvent& message) const {
  TreadEvent out = message;
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != options_.frame_id && message.action != TreadEvent::LIFT) {
    const Pose to_world = poseOf(frame);
    out.start = toPoint(transformed(to_world, fromMsg(message.start)));
    out.position = toPoint(transformed(to_world, fromMsg(message.position)));
    out.velocity = toVector(rotate(to_world.orientation, fromMsg(message.velocity)));
  }
  out.header.frame_id = options_.frame_id;
  return out;
}

GrassEvent GrassField::treadEvent(const grass::TreadInput& input) const {
  GrassEvent event;
  event.kind = GrassEvent::TREAD;
  event.tread = toMsg(input);
  event.tread.header.frame_id = options_.frame_id;
  return event;
}

GrassEvent GrassField::coloursEvent(const grass::ColourMasks& colours) {
  GrassEvent event;
  event.kind = GrassEvent::COLOURS;
  event.colours = toMsg(colours).colours;
  return event;
}

void GrassField::onTread(const TreadEvent& message) {
  acceptInput("tread", [&] {
    TreadEvent tread = inWorld(message);
    const bool is_known = field_->sources().count(tread.source) > 0;
    const NearTreads::Use use = near_treads_->useOf(tread, is_known);
    if (use == NearTreads::Use::NONE) return;
    if (use == NearTreads::Use::LIFT) tread.action = TreadEvent::LIFT;
    const grass::TreadInput input = fromMsg(tread, tuning_.tread, tuning_.height_gate);
    if (input.action == grass::TreadAction::STROKE) field_->checkStroke(input);
    checkWorkToWait(inputs_, field_->workOf(input));
    if (use == NearTreads::Use::ALL) near_treads_->keep(tread);
    GrassEvent event = treadEvent(input);
    event.header.stamp = effectOf(message.header.stamp, clock_);
    if (isPart() && event.header.stamp.isZero() && !message.header.stamp.isZero()) ++late_treads_;
    inputs_.add(std::move(event));
  });
}

// The messages of shards are large, so they come only while the map is wanted.
void GrassField::followCoverParts(bool is_wanted) {
  if (is_wanted == static_cast<bool>(cover_parts_)) return;
  cover_parts_.shutdown();
  cover_parts_ = ros::Subscriber();
  covers_->clear();
  if (!is_wanted) return;
  cover_parts_ = subscribeToShards("grass/cover/parts", MOST_SHARDS, &GrassField::onCoverPart);
}

void GrassField::onCoverPart(const GrassCoverPart& message) {
  checkFrame(message.header.frame_id, options_.frame_id);
  const double ahead = secondsBetween(lastStamp(), fromMsg(message.header.stamp));
  if (ahead > MOST_AHEAD)
    throw InvalidInput("stamp is " + std::to_string(ahead) + " s ahead, allowed are " +
                       std::to_string(MOST_AHEAD) + " s");
  covers_->add(message);
  if (auto joined = covers_->take()) publishCover(std::move(*joined));
}

void GrassField::followWhole(Nanoseconds stamp) {
  whole_->follow(areMarkersWanted(), handle_, [this](const GrassState& message) {
    acceptInput("grass/state", [&] { whole_->apply(message); });
  });
  whole_->field().advance(stamp);
}

void GrassField::onTreads(const TreadEvents& message) {
  if (awaitsNodes() && !tread_senders_.hear(client(), fromMsg(message.header.stamp),
                                            fromMsg(message.complete_until), clock_.stamp()))
    return;
  for (const TreadEvent& event : message.events) onTread(event);
}

void GrassField::awaitTreads(Nanoseconds stamp) {
  if (!awaitsNodes()) return;
  awaitInputs(options_.frame_wait, [&] { return tread_senders_.areComplete(stamp); });
  unsent_treads_ += tread_senders_.endWait(stamp);
}

// Treads that act later wait in the queue, which is saved.
void GrassField::awaitInputsToSave() {
  if (awaitsNodes() && clock_.hasBegun())
    awaitInputs(options_.frame_wait, [this] { return tread_senders_.haveSent(clock_.stamp()); });
}

// Sensors affect what is sent to them, so they are no events.
void GrassField::onSensor(const SensorInterest& message) {
  acceptInput("sensor",
              [&] { sensors_.hear(message, tf_buffer_, options_.frame_id, lastStamp()); });
}

void GrassField::followSources(Nanoseconds stamp) {
  const auto report = [this](const std::string& what, const std::string& why) {
    refusals_.add(what, why);
  };
  for (const grass::TreadInput& input :
       sources_.update(stamp, tuning_.tread, tuning_.height_gate, report))
    acceptInput("source " + inQuotes(input.source), [&] {
      Faults faults;
      check(input, "source: ", faults);
      faults.throwIfAny();
      inputs_.add(treadEvent(input));
    });
}

void GrassField::followCutters(Nanoseconds stamp) {
  std::vector<grass::CutArea> areas =
      cutters_.update(stamp, field_->terrain(), tuning_.height_gate, options_.scene.grass.treading);
  // The last one that is added is applied first.
  std::reverse(areas.begin(), areas.end());
  for (const grass::CutArea& area : areas)
    acceptInput("cutter", [&] {
      checkSwept(area);
      GrassEvent event;
      event.kind = GrassEvent::CUT;
      event.cut = toMsg(area);
      inputs_.addFirst(event);
    });
}

GrassEvent GrassField::tuningEvent(const GrassFieldConfig& config) const {
  const GrassTuning tuning = fromConfig(config, tuning_.view);
  check(tuning);  // the server's own clamp lets NaN pass
  return settingsEvent<GrassEvent>(tuning);
}

}  // namespace vegetation_sim
