// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>

#include "nodes/canopy/canopy_animator.h"
#include "nodes/canopy/plants_in_area.h"
#include "nodes/canopy/pushing_bodies.h"
#include "nodes/cutters/cut_request.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double VIEWER_LIFE = 3.0;  // [s]
constexpr double CUTTER_GATE = 0.3;  // of a tool without its own, as of grass_field [m]

void check(CanopyTuning tuning) {
  Faults faults;
  FieldChecker checker("", faults);
  describe(checker, tuning);
  canopy::CutSettings cuts = tuning.cuts;
  cuts.near_end = cuts.mid_end = 1.0;  // the scenario's, checked before
  if (faults.empty()) canopy::check(cuts, "", faults);
  faults.throwIfAny();
}

CanopyEvent noViewerEvent() {
  CanopyEvent out;
  out.kind = CanopyEvent::VIEWER;
  out.gone = true;
  out.eye.orientation.w = 1.0;
  return out;
}

CanopyEvent windEvent(std::uint64_t hash) {
  CanopyEvent out;
  out.kind = CanopyEvent::WIND;
  out.wind_hash = hash;
  return out;
}

}  // namespace

void CanopyAnimator::onWind(const WindField& message) {
  acceptInput("wind", [&] {
    checkFrame(message.header.frame_id, options_.frame_id);
    const wind::Field wind = fromMsg(message);
    winds_.keep(wind.hash(), wind);
    heard_wind_ = wind.hash();
    forest_.setWind(wind);
    inputs_.add(windEvent(wind.hash()));
  });
}

// The crowns are a view of the forest: no state of the canopy depends on them.
void CanopyAnimator::updateCrowns() {
  if (!crowns_.update(canopy_.layout(), forest_)) return;
  canopy_.setCrowns(crowns_.boxes());
  markers_.updateCrowns();
}

// Takes robots at this tick and people at the one before.
void CanopyAnimator::followBodies(std::int64_t tick) {
  const Nanoseconds before = clock_.grid().timeOf(tick - 1);
  std::vector<forest::Body> present = bodies_.update(clock_.stamp());
  if (options_.walkers) {
    people_.advance(before);
    if (std::fabs(secondsBetween(people_.crowd().stamp(), before)) <= STALE_BODY)
      for (forest::Body& body : bodiesOf(people_.crowd())) present.push_back(std::move(body));
  }
  std::vector<BodyChange> changes = changesNearPlants(canopy_, present, bodies_left_out_);
  // The last one that is added is applied first.
  std::reverse(changes.begin(), changes.end());
  for (const BodyChange& change : changes) {
    CanopyEvent event;
    event.kind = change.gone ? CanopyEvent::REMOVE_BODY : CanopyEvent::BODY;
    if (change.gone)
      event.body.id = change.body.id;
    else
      event.body = vegetation_sim::toMsg(change.body);
    inputs_.addFirst(event);
  }
}

// It has all plants of the area: those that are lower now may be higher after a reset.
CanopyEvent CanopyAnimator::cutEvent(const grass::CutArea& area) const {
  CanopyEvent out;
  out.kind = CanopyEvent::CUT;
  out.cut_height = area.height;
  out.cut_plants = plantsIn(canopy_.layout().plants, area);
  return out;
}

std::uint32_t CanopyAnimator::countHigher(const CanopyEvent& cut) const {
  return static_cast<std::uint32_t>(
      std::count_if(cut.cut_plants.begin(), cut.cut_plants.end(),
                    [&](std::uint32_t plant) { return canopy_.canCut(plant, cut.cut_height); }));
}

void CanopyAnimator::followCutters(Nanoseconds stamp) {
  std::vector<grass::CutArea> areas =
      cutters_.update(stamp, *options_.scene.terrain, CUTTER_GATE, grass::TreadSettings());
  // The last one that is added is applied first.
  std::reverse(areas.begin(), areas.end());
  for (const grass::CutArea& area : areas)
    acceptInput("cutter", [&] {
      checkSwept(area);
      const CanopyEvent event = cutEvent(area);
      if (countHigher(event) > 0) inputs_.addFirst(event);
    });
}

// Layers are cut for one viewer (S3-W8): the one that is named, or else the first that is present.
void CanopyAnimator::onViewer(const Viewer& message) {
  if (options_.replay) return;
  const bool wanted = options_.viewer_id.empty() ? !viewer_ || viewer_->id == message.id
                                                 : message.id == options_.viewer_id;
  if (!wanted) {
    ++other_viewers_;
    return;
  }
  acceptInput("viewer", [&] {
    fromMsg(message);  // checks it
    CanopyEvent event;
    event.kind = CanopyEvent::VIEWER;
    event.viewer = message.id;
    event.eye = toMsg(compose(poseOf(message.header.frame_id), fromMsg(message.pose)));
    event.eye = eyeToMsg(eyeFromMsg(event.eye));
    inputs_.forget([](const CanopyEvent& e) { return e.kind == CanopyEvent::VIEWER; });
    inputs_.add(event);
    viewer_ = Seen{message.id, lastStamp()};
  });
}

void CanopyAnimator::onRecovered(const CanopyEvent& event) {
  if (event.kind == CanopyEvent::VIEWER) viewer_ = Seen{event.viewer, lastStamp()};
}

void CanopyAnimator::forgetViewer() {
  if (options_.replay || !viewer_) return;
  if (viewer_->stamp == 0) viewer_->stamp = clock_.stamp();  // received before the first tick
  if (secondsBetween(viewer_->stamp, clock_.stamp()) <= VIEWER_LIFE) return;
  viewer_.reset();
  inputs_.add(noViewerEvent());
}

// A replay gets the state at the beginning of this run from these events.
void CanopyAnimator::publishBeginning(Nanoseconds stamp) {
  CanopyEvent reset;
  reset.kind = CanopyEvent::RESET;
  const CanopyTuning tuning = tuningOf(canopy_.layout().motion);
  for (CanopyEvent event : {reset, noViewerEvent(), settingsEvent<CanopyEvent>(tuning),
                            windEvent(canopy_.windHash())}) {
    event.header.stamp = toStamp(stamp);
    publishEvent(event);
  }
}

void CanopyAnimator::showTuning(CanopyAnimatorConfig& config) const {
  toConfig(tuningOf(canopy_.layout().motion), config);
}

CanopyEvent CanopyAnimator::tuningEvent(const CanopyAnimatorConfig& config) const {
  const CanopyTuning tuning = fromConfig(config);
  check(tuning);  // the server's own clamp lets NaN pass
  return settingsEvent<CanopyEvent>(tuning);
}

}  // namespace vegetation_sim
