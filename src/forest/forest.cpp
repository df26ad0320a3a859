// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/forest.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

void addTo(Hash& hash, const Viewer& viewer) {
  hash.add(viewer.id);
  hash.add(static_cast<std::uint64_t>(viewer.stamp));
  hash.add(viewer.eye.position);
  hash.add(viewer.eye.forward);
  hash.add(viewer.eye.pixels_per_radian);
  hash.add(viewer.eye.cone_cosine);
}

}  // namespace

void describe(FieldVisitor& v, Settings& s) {
  v.number("tolerance", s.tolerance, "pixel", {0.01, 1000.0});
  v.integer("fixed_level", s.fixed_level, "", {0, MAX_DEPTHS});
  v.integer("highest_level", s.highest_level, "", {0, MAX_DEPTHS});
  v.number("robot_tolerance", s.robot_tolerance, "m", {1e-4, 10.0});
  v.number("robot_range", s.robot_range, "m", {0.0, 100.0});
  describe(v, s.budget);
}

Forest::Forest(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain,
               Settings settings) {
  snapshot_.settings = settings;
  setLayout(std::move(layout), std::move(terrain));
}

void Forest::setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain) {
  Faults faults;
  layout.terrain_hash = terrain->hash();
  check(layout, faults);
  faults.throwIfAny();
  const bool same_trees = layout.treeCount() == layout_.treeCount();
  // Transitions continue from their present blend with the duration of the new layout.
  snapshot_.levels.anchor(snapshot_.stamp, layout_.motion.transition);
  layout_ = std::move(layout);
  layout_hash_ = layout_.hash();
  grid_ = TreeGrid(layout_);
  terrain_ = std::move(terrain);
  measure();
  snapshot_.modes.clear();  // the wood may have changed
  if (!same_trees)
    reset();
  else
    snapshot_.physics.clear();
}

void Forest::reset() {
  snapshot_.viewers.clear();
  const int level = std::min(snapshot_.settings.fixed_level, snapshot_.settings.highest_level);
  snapshot_.levels.reset(LevelState::settled(level));
  snapshot_.stamp = 0;
  snapshot_.modes.clear();
  snapshot_.physics.clear();
  snapshot_.changed.clear();
  snapshot_.begun.clear();
  snapshot_.sequence = 0;
}

void Forest::measureSpecies(std::size_t species, double scale) {
  tables_[species].measure(layout_.species[species], layout_.motion, scale);
  const LevelTable table = tables_[species].at(scale);
  extent_ = std::max(extent_, table.reach + table.height);
  largest_omission_ = std::max(largest_omission_, table.omitted[0]);
  slowest_reference_ = std::min(slowest_reference_, layout_.species[species].reference_speed);
}

void Forest::forEachSize(const std::function<void(std::size_t, double)>& look) const {
  for (const TreeSeed& seed : layout_.trees) look(seed.species, seed.scale);
  for (std::size_t species = 0; species < tables_.size() && !layout_.tiles.empty(); ++species)
    for (const double scale : {SMALLEST_TILED_SCALE, 1.0, LARGEST_TILED_SCALE})
      look(species, scale);
}

void Forest::precompute() {
  forEachSize([this](std::size_t species, double scale) {
    tables_[species].responseErrorAt(layout_.species[species], layout_.motion, scale, {});
  });
}

void Forest::measure() {
  tables_.assign(layout_.species.size(), LevelScales());
  extent_ = largest_omission_ = 0.0;
  slowest_reference_ = 1e9;
  forEachSize([this](std::size_t species, double scale) { measureSpecies(species, scale); });
  const terrain::Bounds bounds = terrain_->bounds();
  const double relief = bounds.max_z - bounds.min_z;
  regions_.clear();
  for (std::uint32_t i = 0; i < layout_.trees.size(); ++i)
    regions_.push_back({footOf(layout_.trees[i], *terrain_), extent_, i, 1});
  for (const Tile& tile : layout_.tiles) {
    const double half = 0.5 * tile.size;
    const Vec3 centre(tile.x + half, tile.y + half, terrain_->height(tile.x + half, tile.y + half));
    regions_.push_back({centre, half * 1.5 + relief + extent_, tile.first_tree, tile.count});
  }
}

StepContext Forest::stepContext() const {
  return {layout_,         layout_hash_, *terrain_, snapshot_.wind, snapshot_.levels,
          snapshot_.modes, *contacts_,   grid_,     *threads_,      snapshot_.stamp};
}

// Runs before the choice of levels: the present levels hold since the last tick.
void Forest::advancePhysics(Nanoseconds stamp) {
  for (const std::uint32_t tree : physicalTrees()) snapshot_.changed.insert(tree);
  snapshot_.modes.advance(snapshot_.wind, snapshot_.stamp, stamp);
  snapshot_.physics.advance(stepContext(), stamp);
}

std::uint32_t Forest::addGrab(const Grab& grab) {
  return snapshot_.physics.addGrab(stepContext(), grab);
}
void Forest::moveGrab(std::uint32_t id, const Vec3& target, const Pose& holder) {
  snapshot_.physics.moveGrab(id, target, holder);
}
void Forest::renewGrab(std::uint32_t id) {
  snapshot_.physics.renewGrab(id);
}
void Forest::release(std::uint32_t id) {
  snapshot_.physics.release(id);
}
void Forest::push(const Push& push) {
  snapshot_.physics.push(stepContext(), push);
}
void Forest::setBody(const Body& body) {
  snapshot_.physics.setBody(body);
}
void Forest::removeBody(const std::string& id) {
  snapshot_.physics.removeBody(id);
}
void Forest::setPhysics(const PhysicsSettings& settings) {
  snapshot_.physics.setSettings(settings, snapshot_.stamp);
}

PhysicsFigures Forest::physicsFigures() const {
  PhysicsFigures out = snapshot_.physics.figures();
  out.bytes += contacts_->bytes();
  return out;
}

PromotedTree Forest::promoted(std::uint32_t tree) const {
  return snapshot_.physics.promoted(tree, snapshot_.stamp);
}

std::vector<std::uint32_t> Forest::physicalTrees() const {
  std::vector<std::uint32_t> out;
  for (const auto& [tree, subtree] : snapshot_.physics.subtrees())
    if (!subtree.empty()) out.push_back(tree);
  return out;
}

std::vector<Pose> Forest::pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  return snapshot_.physics.pose(stepContext(), tree, id, stamp);
}

std::uint64_t Forest::hash() const {
  Hash out;
  out.add(layout_hash_);
  out.add(snapshot_.wind.hash());
  Settings settings = snapshot_.settings;
  FieldHasher hasher(out);
  describe(hasher, settings);
  for (const auto& entry : snapshot_.viewers) addTo(out, entry.second);
  snapshot_.levels.addTo(out, snapshot_.stamp, layout_.motion.transition);
  snapshot_.modes.addTo(out);
  snapshot_.physics.addTo(out);
  return out.value();
}

StateUpdate Forest::update(bool key_frame) {
  StateUpdate out;
  out.stamp = snapshot_.stamp;
  out.sequence = snapshot_.sequence++;
  out.key_frame = key_frame;
  out.base = snapshot_.levels.base();
  out.layout_hash = layout_hash_;
  out.wind_hash = snapshot_.wind.hash();
  out.hash = hash();
  out.blend = snapshot_.physics.settings().blend;
  std::set<std::uint32_t> published;
  if (key_frame)
    for (const auto& entry : snapshot_.levels.held()) published.insert(entry.first);
  else
    published = snapshot_.changed;
  for (const std::uint32_t tree : physicalTrees()) published.insert(tree);
  for (const std::uint32_t tree : published) {
    const bool amplitudes = modalState(tree) && (key_frame || snapshot_.begun.count(tree));
    out.trees.push_back({tree, snapshot_.levels.of(tree), promoted(tree).branches,
                         amplitudes ? modalState(tree)->state() : physics::ModalState()});
  }
  snapshot_.changed.clear();
  snapshot_.begun.clear();
  return out;
}

}  // namespace vegetation_sim::forest
