// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads the parts of a snapshot that are specific to the node, and the inputs to which
// events refer. SavedNode keeps the events that wait.
#include "core/archive/archive.h"
#include "core/config/field_values.h"
#include "nodes/forest/forest_animator.h"

namespace vegetation_sim {

std::uint64_t ForestAnimator::sceneHash() const {
  forest::Layout layout = options_.scene.layout;
  layout.terrain_hash = options_.scene.terrain->hash();
  const std::uint64_t whole = layout.hash();
  if (!options_.shard) return whole;
  Hash out;
  for (const std::uint64_t part :
       {whole, std::uint64_t{options_.shard->index}, std::uint64_t{options_.shard->count}})
    out.add(part);
  return out.value();
}

void ForestAnimator::writeState(Archive& a) const {
  NamedValues tuning = namedValues(tuning_);
  archiveNames(a, tuning);
  std::string state = forest_->archived();
  a.text("forest", state, LARGEST_SNAPSHOT);
  GrabManager::State grabs = grab_manager_.state();
  GrabManager::archive(a, grabs);
  RobotBodies::Seen bodies = bodies_.seen();
  RobotBodies::archive(a, bodies);
  CutterFollower::State cutters = cutters_.state();
  CutterFollower::archive(a, cutters);
}

CheckedState ForestAnimator::readState(Archive& a) {
  NamedValues named;
  archiveNames(a, named);
  const auto tuning = fromNamedValues<ForestTuning>(named);
  std::string state;
  a.text("forest", state, LARGEST_SNAPSHOT);
  GrabManager::State grabs;
  GrabManager::archive(a, grabs);
  RobotBodies::Seen bodies;
  RobotBodies::archive(a, bodies);
  CutterFollower::State cutters;
  CutterFollower::archive(a, cutters);
  const forest::Layout layout = designedLayout(tuning);
  // A state can be read by a forest of its layout only.
  std::optional<forest::Forest> other;
  if (layout.hash() != forest_->layoutHash())
    other.emplace(layout, options_.scene.terrain, tuning.settings, options_.shard);
  const forest::Forest& reader = other ? *other : *forest_;
  const auto read =
      std::make_shared<forest::ForestSnapshot>(reader.readArchived(std::move(state), a.shift()));
  return {reader.hashOf(*read), [=] {
            applyTuning(tuning);
            forest_->restore(*read);
            grab_manager_.restore(grabs);
            bodies_.restore(bodies);
            cutters_.restore(cutters);
            deepest_ = {};
            force_key_frame_ = true;
            winds_.keep(read->wind.hash(), read->wind);
            queueNewerWind();
          }};
}

// The wind that is published now stays in force.
void ForestAnimator::queueNewerWind() {
  ForestInput event;
  event.kind = ForestInput::WIND;
  event.wind_hash = heard_wind_;
  if (heard_wind_ != 0 && heard_wind_ != forest_->snapshot().wind.hash()) inputs_.add(event);
}

std::string ForestAnimator::inputOf(const ForestInput& event) const {
  return windInputOf(winds_, event);
}

std::function<void()> ForestAnimator::readInput(ForestInput& event, const std::string& bytes,
                                                Nanoseconds shift) {
  return readWindInput(winds_, event, bytes, shift);
}

}  // namespace vegetation_sim
