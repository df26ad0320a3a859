// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads the parts of a snapshot that are specific to the node. SavedNode keeps the
// events that wait.
#include "core/archive/archive.h"
#include "core/config/field_values.h"
#include "nodes/canopy/canopy_animator.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LONGEST_NAME = 4096;

}  // namespace

void CanopyAnimator::archive(Archive& a, std::optional<Seen>& viewer) {
  bool seen = viewer.has_value();
  a.flag("has a viewer", seen);
  if (!seen) return viewer.reset();
  if (!viewer) viewer.emplace();
  a.text("viewer", viewer->id, LONGEST_NAME);
  a.stamp("stamp of the viewer", viewer->stamp);
}

// The tuning can change while the node runs.
std::uint64_t CanopyAnimator::sceneHash() const {
  canopy::Layout layout = canopy_.layout();
  layout.motion = withTuning(layout.motion, CanopyTuning());
  return layout.hash();
}

void CanopyAnimator::writeState(Archive& a) const {
  NamedValues tuning = namedValues(tuningOf(canopy_.layout().motion));
  archiveNames(a, tuning);
  std::string state = canopy_.archived();
  a.text("canopy", state, LARGEST_SNAPSHOT);
  std::optional<Seen> viewer = viewer_;
  archive(a, viewer);
  RobotBodies::Seen bodies = bodies_.seen();
  RobotBodies::archive(a, bodies);
  CutterFollower::State cutters = cutters_.state();
  CutterFollower::archive(a, cutters);
}

CheckedState CanopyAnimator::readState(Archive& a) {
  NamedValues named;
  archiveNames(a, named);
  std::string state;
  a.text("canopy", state, LARGEST_SNAPSHOT);
  std::optional<Seen> viewer;
  archive(a, viewer);
  RobotBodies::Seen bodies;
  RobotBodies::archive(a, bodies);
  CutterFollower::State cutters;
  CutterFollower::archive(a, cutters);
  const canopy::Motion motion =
      withTuning(canopy_.layout().motion, fromNamedValues<CanopyTuning>(named));
  const canopy::Canopy::Archived read = canopy_.readArchived(std::move(state), a.shift());
  canopy::Layout layout = canopy_.layout();
  layout.motion = motion;
  canopy::Canopy(layout).restore(read.snapshot);  // checks both
  return {read.snapshot.hash(), [=] {
            canopy_.setMotion(motion);
            canopy_.restore(read.snapshot);
            canopy_.setWind(read.wind);
            canopy_.setViewer(read.viewer);
            winds_.keep(read.wind.hash(), read.wind);
            viewer_ = viewer;
            bodies_.restore(bodies);
            cutters_.restore(cutters);
            people_.forgetLater(read.snapshot.stamp);
            begun_ = true;
            publishLayout();
            queueNewerWind();
          }};
}

// The wind that is published now stays in force.
void CanopyAnimator::queueNewerWind() {
  CanopyEvent event;
  event.kind = CanopyEvent::WIND;
  event.wind_hash = heard_wind_;
  if (heard_wind_ != 0 && heard_wind_ != canopy_.windHash()) inputs_.add(event);
}

std::string CanopyAnimator::inputOf(const CanopyEvent& event) const {
  return windInputOf(winds_, event);
}

std::function<void()> CanopyAnimator::readInput(CanopyEvent& event, const std::string& bytes,
                                                Nanoseconds shift) {
  return readWindInput(winds_, event, bytes, shift);
}

}  // namespace vegetation_sim
