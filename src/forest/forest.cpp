// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/forest.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/forest/contact_finder.h"

namespace vegetation_sim::forest {
namespace {

constexpr double SMALLEST_SCALE = 0.7, LARGEST_SCALE = 1.3;  // of trees in tiles, seedInTile

// A level table speaks of the worst tip of the worst tree across the wind; in a picture, a forest
// shows so much of that. Measured: forest_test, PredictedErrorIsTheMeasuredOne.
constexpr double SEEN = 0.57;

// Pixels per metre of table of the eye that sees a disc best: the finest wins.
double finestView(const std::map<std::string, Viewer>& viewers, const Vec3& centre, double reach) {
  double out = 0.0;
  for (const auto& entry : viewers) {
    const Eye& eye = entry.second.eye;
    if (!sees(eye, centre, 2.0 * reach)) continue;  // twice: the whole tree, and a margin
    const double distance = length(eye.position - centre) - reach;
    out = std::max(out, SEEN * pixelsPerMetre(eye, distance));
  }
  return out;
}

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
}

Forest::Forest(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain, Settings settings)
    : contacts_(std::make_shared<ContactFinder>()) {
  memory_.settings = settings;
  setLayout(std::move(layout), std::move(terrain));
}

void Forest::setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain) {
  Faults faults;
  layout.terrain_hash = terrain->hash();
  check(layout, faults);
  faults.throwIfAny();
  const bool same_trees = layout.treeCount() == layout_.treeCount();
  // What is on its way goes on from where it is, at the new layout's pace.
  memory_.levels.anchor(memory_.stamp, layout_.motion.transition);
  layout_ = std::move(layout);
  layout_hash_ = layout_.hash();
  terrain_ = std::move(terrain);
  measure();
  if (!same_trees)
    reset();
  else
    memory_.physics.clear();  // its wood may be another
}

void Forest::reset() {
  memory_.viewers.clear();
  const int level = std::min(memory_.settings.fixed_level, memory_.settings.highest_level);
  memory_.levels.reset(LevelState::settled(level));
  memory_.stamp = 0;
  memory_.physics.clear();
  memory_.changed.clear();
  memory_.sequence = 0;
}

void Forest::measureSpecies(std::size_t species, double scale) {
  tables_[species].measure(layout_.species[species], layout_.motion, scale);
  const LevelTable table = tables_[species].at(scale);
  extent_ = std::max(extent_, table.reach + table.height);
  largest_omission_ = std::max(largest_omission_, table.omitted[0]);
  slowest_reference_ = std::min(slowest_reference_, layout_.species[species].reference_speed);
}

void Forest::measure() {
  tables_.assign(layout_.species.size(), LevelScales());
  extent_ = largest_omission_ = 0.0;
  slowest_reference_ = 1e9;
  for (const TreeSeed& seed : layout_.trees) measureSpecies(seed.species, seed.scale);
  for (std::size_t species = 0; species < tables_.size() && !layout_.tiles.empty(); ++species)
    for (const double scale : {SMALLEST_SCALE, 1.0, LARGEST_SCALE}) measureSpecies(species, scale);
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

// Speed that a bend is proportional to.
double Forest::bendingSpeed(double speed, double reference_speed) const {
  const bool linear = static_cast<Drag>(layout_.motion.drag) == Drag::LINEAR;
  return linear ? speed : speed * speed / reference_speed;
}

void Forest::advance(Nanoseconds stamp) {
  advancePhysics(stamp);
  memory_.stamp = stamp;
  for (auto it = memory_.viewers.begin(); it != memory_.viewers.end();)
    it = stamp - it->second.stamp > VIEWER_LIFE ? memory_.viewers.erase(it) : std::next(it);
  const Settings& settings = memory_.settings;
  const bool watched = !memory_.viewers.empty();
  const int base = watched ? 0 : std::min(settings.fixed_level, settings.highest_level);
  last_base_ = memory_.levels.base().level;
  memory_.levels.rebase(base, stamp, layout_.motion.transition);
  if (watched) {
    now_ = memory_.wind.at(stamp);
    for (const Region& region : regions_) chooseRegion(region);
  } else {
    // Copied: aim() changes the map.
    std::vector<std::uint32_t> held;
    for (const auto& entry : memory_.levels.held()) held.push_back(entry.first);
    for (const std::uint32_t tree : held) aim(tree, base);
  }
  memory_.levels.prune(stamp, layout_.motion.transition);
}

// A whole tile at a time: where even its nearest, largest tree may stand still, no tree is looked
// at.
void Forest::chooseRegion(const Region& region) {
  if (region.count == 1) return chooseTree(region.first);
  const double speed =
      bendingSpeed(now_.speedBound(region.centre, region.reach), slowest_reference_);
  const double view = finestView(memory_.viewers, region.centre, region.reach);
  const double error = largest_omission_ * speed * view;
  if (error > HYSTERESIS * memory_.settings.tolerance) {
    for (std::uint32_t i = 0; i < region.count; ++i) chooseTree(region.first + i);
    return;
  }
  std::vector<std::uint32_t> held;
  const auto& all = memory_.levels.held();
  for (auto it = all.lower_bound(region.first);
       it != all.end() && it->first < region.first + region.count; ++it)
    held.push_back(it->first);
  for (const std::uint32_t tree : held) aim(tree, 0);
}

void Forest::chooseTree(std::uint32_t tree) {
  const TreeSeed seed = seedOf(layout_, tree);
  const LevelTable table = tables_[seed.species].at(seed.scale);
  const Vec3 foot = footOf(seed, *terrain_);
  const double reach = 0.5 * table.reach;  // where most of its twigs are
  const double speed =
      bendingSpeed(now_.speedBound(foot, reach), layout_.species[seed.species].reference_speed);
  const Vec3 middle = foot + Vec3(0.0, 0.0, 0.5 * table.height);
  const double view = finestView(memory_.viewers, middle, reach);
  const auto held = memory_.levels.held().find(tree);
  const int current = held == memory_.levels.held().end() ? last_base_ : held->second.level;
  const int level = chooseLevel(table, speed, view, memory_.settings.tolerance, current);
  aim(tree, std::min(level, memory_.settings.highest_level));
}

void Forest::aim(std::uint32_t tree, int level) {
  LevelState state = memory_.levels.of(tree);
  if (state.level == level) return;
  setLevel(state, level, memory_.stamp, layout_.motion.transition);
  memory_.levels.set(tree, state);
  memory_.changed.insert(tree);
}

std::uint64_t Forest::hash() const {
  Hash out;
  out.add(layout_hash_);
  out.add(memory_.wind.hash());
  Settings settings = memory_.settings;
  FieldHasher hasher(out);
  describe(hasher, settings);
  for (const auto& entry : memory_.viewers) addTo(out, entry.second);
  memory_.levels.addTo(out, memory_.stamp, layout_.motion.transition);
  memory_.physics.addTo(out);
  return out.value();
}

StateUpdate Forest::update(bool key_frame) {
  StateUpdate out;
  out.stamp = memory_.stamp;
  out.sequence = memory_.sequence++;
  out.key_frame = key_frame;
  out.base = memory_.levels.base();
  out.layout_hash = layout_hash_;
  out.wind_hash = memory_.wind.hash();
  out.hash = hash();
  out.blend = memory_.physics.settings().blend;
  std::set<std::uint32_t> told;
  if (key_frame)
    for (const auto& entry : memory_.levels.held()) told.insert(entry.first);
  else
    told = memory_.changed;
  for (const std::uint32_t tree : physicalTrees()) told.insert(tree);
  for (const std::uint32_t tree : told)
    out.trees.push_back({tree, memory_.levels.of(tree), promoted(tree).branches});
  memory_.changed.clear();
  return out;
}

}  // namespace vegetation_sim::forest
