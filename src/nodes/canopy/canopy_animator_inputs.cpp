// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <tf2/exceptions.h>

#include "core/config/field_values.h"
#include "nodes/canopy/canopy_animator.h"
#include "ros/services/requests.h"
#include "vegetation_sim/ros/conversions/canopy_conversions.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double VIEWER_LIFE = 3.0;  // [s]
constexpr std::size_t MOST_WINDS = 16;

void check(CanopyTuning tuning) {
  Faults faults;
  FieldChecker checker("", faults);
  describe(checker, tuning);
  canopy::CutSettings cuts = tuning.cuts;
  cuts.near_end = cuts.mid_end = 1.0;  // the scenario's, checked before
  if (faults.empty()) canopy::check(cuts, "", faults);
  faults.throwIfAny();
}

CanopyEvent settingsEvent(const CanopyTuning& tuning) {
  NamedValues named = namedValues(tuning);
  CanopyEvent out;
  out.kind = CanopyEvent::SETTINGS;
  out.names = std::move(named.names);
  out.values = std::move(named.values);
  return out;
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
  try {
    checkFrame(message.header.frame_id, options_.frame_id);
    winds_.push_back(fromMsg(message));
    forest_.setWind(winds_.back());
    if (winds_.size() > MOST_WINDS) winds_.pop_front();
    inputs_.add(windEvent(winds_.back().hash()));
  } catch (const InvalidInput& error) {
    refusals_.add("wind", error.what());
  }
}

// The crowns are a view of the forest: no state of the canopy depends on them.
void CanopyAnimator::updateCrowns() {
  if (!crowns_.update(canopy_->layout(), forest_)) return;
  canopy_->setCrowns(crowns_.boxes());
  markers_.setCrowns(canopy_->layout(), crowns_);
}

// Layers are cut for one eye (S3-W8): the one that is named, or who came first and still looks.
void CanopyAnimator::onViewer(const Viewer& message) {
  const bool wanted = options_.viewer_id.empty() ? !viewer_ || viewer_->id == message.id
                                                 : message.id == options_.viewer_id;
  if (!wanted) {
    ++counts_.other_viewers;
    return;
  }
  try {
    fromMsg(message);  // checks it
    CanopyEvent event;
    event.kind = CanopyEvent::VIEWER;
    event.eye = toMsg(compose(poseInWorld(tf_buffer_, options_.frame_id, message.header.frame_id),
                              fromMsg(message.pose)));
    event.eye = eyeToMsg(eyeFromMsg(event.eye));
    inputs_.forget([](const CanopyEvent& e) { return e.kind == CanopyEvent::VIEWER; });
    inputs_.add(event);
    viewer_ = Seen{message.id, clock_.hasBegun() ? clock_.stamp() : 0};
  } catch (const InvalidInput& error) {
    refusals_.add("viewer", error.what());
  }
}

void CanopyAnimator::forgetViewer() {
  if (options_.replay || !viewer_) return;
  if (viewer_->stamp == 0) viewer_->stamp = clock_.stamp();  // spoke before the first tick
  if (secondsBetween(viewer_->stamp, clock_.stamp()) <= VIEWER_LIFE) return;
  viewer_.reset();
  inputs_.add(noViewerEvent());
}

// A replay does not know when this run began: it becomes what this run was then.
void CanopyAnimator::publishBeginning(Nanoseconds stamp) {
  CanopyEvent reset;
  reset.kind = CanopyEvent::RESET;
  const CanopyTuning tuning = tuningOf(canopy_->layout().motion);
  for (CanopyEvent event :
       {reset, noViewerEvent(), settingsEvent(tuning), windEvent(canopy_->windHash())}) {
    event.header.stamp = toStamp(stamp);
    event.header.frame_id = options_.frame_id;
    events_publisher_.publish(event);
  }
}

void CanopyAnimator::lookFromFrame() {
  if (options_.viewer_frame.empty() || options_.replay) return;
  Viewer viewer;
  viewer.id = options_.viewer_id.empty() ? "tf:" + options_.viewer_frame : options_.viewer_id;
  viewer.header.frame_id = options_.viewer_frame;
  viewer.pose.orientation.w = 1.0;
  viewer.field_of_view = 0.8;  // not asked for
  viewer.height = 900;
  onViewer(viewer);
}

void CanopyAnimator::onTuning(CanopyAnimatorConfig& config) {
  if (!shown_) {
    toConfig(tuningOf(canopy_->layout().motion), config);  // some may come from the scenario
    shown_ = config;
    return;
  }
  try {
    if (options_.replay) throw InvalidInput("a replay follows its recorded events only");
    const CanopyTuning tuning = fromConfig(config);
    check(tuning);  // the server's own clamp lets NaN pass
    inputs_.add(settingsEvent(tuning));
    shown_ = config;
  } catch (const InvalidInput& error) {
    refusals_.add("settings", error.what());
    config = *shown_;
  }
}

}  // namespace vegetation_sim
