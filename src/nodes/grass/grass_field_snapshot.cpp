// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Writes and reads the parts of a snapshot that are specific to the node. SavedNode keeps the
// events that wait.
#include "core/archive/archive.h"
#include "core/config/field_values.h"
#include "nodes/grass/grass_field.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t DISC_BYTES = 56;

void archiveColours(Archive& a, grass::ColourMasks& colours) {
  a.stamp("stamp of colours", colours.stamp);
  a.list("colours", colours.list, grass::ColourMasks::MOST, DISC_BYTES,
         [&a](grass::ColourMask& disc) { a.fields("colours", disc); });
}

// A camera sees the discs, so they count with the ground, as they are at the last tick.
std::uint64_t hashOfAll(const grass::TreadSnapshot& ground, const grass::ColourMasks& colours) {
  if (colours.list.empty()) return ground.hash();
  Hash hash;
  hash.add(ground.hash());
  FieldHasher fields(hash);
  for (grass::ColourMask& disc : colours.at(ground.stamp)) describe(fields, disc);
  return hash.value();
}

}  // namespace

// The law of sources can change while the node runs.
std::uint64_t GrassField::sceneHash() const {
  grass::Layout layout = field_->layout();
  layout.tread = grass::TreadLaw();
  Hash hash;
  hash.add(layout.hash());
  FieldHasher fields(hash);
  grass::TreadSettings treading = options_.scene.grass.treading;
  describe(fields, treading);
  if (options_.shard)
    for (const std::uint32_t part : {options_.shard->index, options_.shard->count})
      hash.add(std::uint64_t{part});
  return hash.value();
}

std::uint64_t GrassField::stateHash() const {
  return hashOfAll(field_->snapshot(), colours_);
}

void GrassField::writeState(Archive& a) const {
  NamedValues tuning = namedValues(tuning_);
  archiveNames(a, tuning);
  std::string state = field_->archived();
  a.text("grass", state, LARGEST_SNAPSHOT);
  std::uint64_t paths = paths_;
  a.integer("paths", paths);
  GrassSources::Published sources = sources_.published();
  GrassSources::archive(a, sources);
  CutterFollower::State cutters = cutters_.state();
  CutterFollower::archive(a, cutters);
  grass::ColourMasks colours = colours_;
  archiveColours(a, colours);
}

CheckedState GrassField::readState(Archive& a) {
  NamedValues named;
  archiveNames(a, named);
  const auto tuning = fromNamedValues<GrassTuning>(named);
  check(tuning);
  std::string state;
  a.text("grass", state, LARGEST_SNAPSHOT);
  std::uint64_t paths = 0;
  a.integer("paths", paths);
  GrassSources::Published sources;
  GrassSources::archive(a, sources);
  CutterFollower::State cutters;
  CutterFollower::archive(a, cutters);
  grass::ColourMasks colours;
  archiveColours(a, colours);
  const grass::TreadSnapshot read = field_->readArchived(std::move(state), a.shift());
  return {hashOfAll(read, colours), [=] {
            applyTuning(tuning);
            field_->restore(read);
            paths_ = paths;
            sources_.restore(sources);
            cutters_.restore(cutters);
            setColours(colours);
            key_frames_.demand();
            tread_senders_.onLoaded(read.stamp);
          }};
}

}  // namespace vegetation_sim
