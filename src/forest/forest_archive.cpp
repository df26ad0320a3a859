// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The snapshot of a forest as bytes.
#include <map>

#include "core/archive/archive.h"
#include "forest/forest.h"
#include "wind/field_archive.h"

namespace vegetation_sim::forest {
namespace {

constexpr std::size_t MOST_LISTENERS = 4096, LONGEST_NAME = 4096;
constexpr std::size_t SENSOR_BYTES = 56, EYE_BYTES = 64, LEVEL_BYTES = 44;

void archive(Archive& a, LevelState& level) {
  a.integer("level", level.level, 0, MODAL_LEVEL);
  a.stamp("level since", level.since);
  for (float& blend : level.blend) a.number("blend", blend, {0.0, 1.0});
}

void archive(Archive& a, LevelMap& levels, std::size_t trees) {
  LevelState base = levels.base();
  std::map<std::uint32_t, LevelState> held = levels.held();
  archive(a, base);
  a.map(
      "levels", held, trees, LEVEL_BYTES,
      [&](std::uint32_t& tree) {
        a.integer<std::uint32_t>("tree", tree, 0, static_cast<std::uint32_t>(trees) - 1);
      },
      [&](std::uint32_t, LevelState& level) { archive(a, level); });
  if (!a.reads()) return;
  levels.reset(base);
  for (const auto& [tree, level] : held) levels.set(tree, level);
}

void archive(Archive& a, std::set<std::uint32_t>& ids, std::size_t trees) {
  std::vector<std::uint32_t> list(ids.begin(), ids.end());
  a.list("trees", list, trees, sizeof(std::uint32_t), [&](std::uint32_t& tree) {
    a.integer<std::uint32_t>("tree", tree, 0, static_cast<std::uint32_t>(trees) - 1);
  });
  if (a.reads()) ids = {list.begin(), list.end()};
}

void archive(Archive& a, Sensor& sensor) {
  a.text("sensor id", sensor.id, LONGEST_NAME);
  a.vector("sensor position", sensor.position);
  a.number("sensor range", sensor.range);
  a.number("sensor tolerance", sensor.tolerance);
  a.stamp("sensor stamp", sensor.stamp);
}

void archive(Archive& a, Viewpoint& eye) {
  a.vector("viewer position", eye.position);
  a.number("viewer pixels_per_radian", eye.pixels_per_radian);
  a.vector("viewer forward", eye.forward);
  a.number("viewer cone_cosine", eye.cone_cosine);
}

/// Grown trees and computed modes for a snapshot that is read. World, sensors and displays share
/// the modes of a tree, and modes that the forest holds already are not computed again.
class Grower {
 public:
  Grower(const Layout& layout, const terrain::HeightMap& terrain, const ForestSnapshot& present,
         const ForestSnapshot& read)
      : layout_(layout),
        terrain_(terrain),
        present_(present.physics),
        read_(read.physics),
        sources_{&present.world, &present.sensed.trees, &present.view.trees, &read.world,
                 &read.sensed.trees} {}

  std::shared_ptr<const Tree> tree(std::uint32_t id) const {
    return std::make_shared<const Tree>(
        growTree(layout_, id, terrain_, brokenOf(read_.broken(), id)));
  }
  ModalTreeState modes(std::uint32_t tree, std::size_t modes) const {
    const bool same = brokenOf(present_.broken(), tree) == brokenOf(read_.broken(), tree);
    for (std::size_t i = same ? 0 : PRESENT; i < sources_.size(); ++i) {
      const TreeDetail* source = sources_[i];
      const ModalTreeState* found = source->modes.find(tree);
      if (found && found->modes().size() == modes) return *found;
    }
    const wind::Field calm;
    return ModalForest::computeModes({layout_, terrain_, calm, &read_.broken()}, tree, modes);
  }

 private:
  const Layout& layout_;
  const terrain::HeightMap& terrain_;
  const ForestPhysics &present_, &read_;
  static constexpr std::size_t PRESENT = 3;  // sources that the forest holds already
  std::array<const TreeDetail*, 5> sources_;
};

void archive(Archive& a, TreeDetail& detail, std::size_t trees,
             const ModalForest::ModesOf& modes_of) {
  archive(a, detail.levels, trees);
  detail.modes.archive(a, trees, modes_of);
  archive(a, detail.changed, trees);
  archive(a, detail.begun, trees);
  a.integer("sequence", detail.sequence);
  bool is_requested = detail.request.has_value();
  a.flag("modes requested", is_requested);
  if (!is_requested) return;
  ModesRequest request = detail.request.value_or(ModesRequest{});
  a.integer<std::uint32_t>("requested tree", request.tree, 0,
                           static_cast<std::uint32_t>(trees) - 1);
  a.flag("requested fine", request.fine);
  a.stamp("request due", request.due);
  detail.request = request;
}

void archive(Archive& a, const Layout& layout, const Grower& grower, ForestSnapshot& snapshot) {
  const std::size_t trees = layout.treeCount();
  const auto modes_of = [&](std::uint32_t tree, std::size_t modes) {
    return grower.modes(tree, modes);
  };
  a.stamp("stamp", snapshot.stamp);
  a.fields("settings", snapshot.settings);
  wind::archive(a, snapshot.wind);
  a.map(
      "sensors", snapshot.sensors, MOST_LISTENERS, SENSOR_BYTES,
      [&a](std::string& id) { a.text("sensor", id, LONGEST_NAME); },
      [&a](const std::string&, Sensor& sensor) { archive(a, sensor); });
  snapshot.physics.archiveBroken(a, layout);
  archive(a, snapshot.world, trees, modes_of);
  snapshot.physics.archive(a, layout, [&](std::uint32_t tree) { return grower.tree(tree); });
  a.list("viewers", snapshot.viewers, MOST_LISTENERS, EYE_BYTES,
         [&a](Viewpoint& eye) { archive(a, eye); });
  for (ListenerDetail* listener : {&snapshot.sensed, &snapshot.view}) {
    archive(a, listener->trees, trees, modes_of);
    listener->offsets.archive(a, trees);
  }
}

}  // namespace

std::string Forest::archived() const {
  Archive a;
  ForestSnapshot copy = snapshot_;
  archive(a, layout_, Grower(layout_, *terrain_, snapshot_, copy), copy);
  return a.takeBytes();
}

ForestSnapshot Forest::readArchived(std::string bytes, Nanoseconds shift) const {
  Archive a = Archive::reading(std::move(bytes), shift);
  ForestSnapshot out;
  archive(a, layout_, Grower(layout_, *terrain_, snapshot_, out), out);
  a.finish();
  const auto require_owned = [&](std::uint32_t tree) { owners_.requireOwned("snapshot", tree); };
  for (const auto& entry : out.world.levels.held()) require_owned(entry.first);
  for (const auto& entry : out.physics.subtrees()) require_owned(entry.first);
  for (const auto& entry : out.physics.broken()) require_owned(entry.first);
  return out;
}

}  // namespace vegetation_sim::forest
