// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/forest.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

void addTo(Hash& hash, const Sensor& sensor) {
  hash.add(sensor.id);
  hash.add(static_cast<std::uint64_t>(sensor.stamp));
  hash.add(sensor.position);
  hash.add(sensor.range);
  hash.add(sensor.tolerance);
}

}  // namespace

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
  for (TreeDetail* detail : {&snapshot_.world, &snapshot_.view})
    detail->levels.anchor(snapshot_.stamp, layout_.motion.transition);
  layout_ = std::move(layout);
  layout_hash_ = layout_.hash();
  grid_ = TreeGrid(layout_);
  terrain_ = std::move(terrain);
  errors_.measure(layout_, *terrain_);
  for (TreeDetail* detail : {&snapshot_.world, &snapshot_.view})
    detail->modes.clear();  // the wood may have changed
  snapshot_.offsets.clear();
  if (!same_trees)
    reset();
  else
    snapshot_.physics.clear();
}

void Forest::reset() {
  const int level = std::min(snapshot_.settings.fixed_level, snapshot_.settings.highest_level);
  for (TreeDetail* detail : {&snapshot_.world, &snapshot_.view}) detail->reset(level);
  snapshot_.sensors.clear();
  snapshot_.viewers.clear();
  snapshot_.stamp = 0;
  snapshot_.physics.clear();
  snapshot_.offsets.clear();
}

StepContext Forest::stepContext() const {
  return {layout_,
          layout_hash_,
          *terrain_,
          snapshot_.wind,
          snapshot_.world.levels,
          snapshot_.world.modes,
          *contacts_,
          grid_,
          *threads_,
          snapshot_.stamp};
}

void Forest::advance(Nanoseconds stamp) {
  const Nanoseconds before = snapshot_.stamp;
  advancePhysics(stamp);
  auto& sensors = snapshot_.sensors;
  for (auto it = sensors.begin(); it != sensors.end();)
    it = stamp - it->second.stamp > SENSOR_LIFE ? sensors.erase(it) : std::next(it);
  chooseDetail(before);
}

// Runs before the choice of levels: the present levels hold since the last tick.
void Forest::advancePhysics(Nanoseconds stamp) {
  const std::vector<std::uint32_t> physical = physicalTrees();
  for (TreeDetail* detail : {&snapshot_.world, &snapshot_.view}) {
    detail->changed.insert(physical.begin(), physical.end());
    detail->modes.advance(snapshot_.wind, snapshot_.stamp, stamp);
  }
  snapshot_.physics.advance(stepContext(), stamp);
  snapshot_.stamp = stamp;
  noteOffsets();
}

// Notes by how much drawn joints differ from those of the world where branches have become physical
// in this tick.
void Forest::noteOffsets() {
  const double duration = layout_.motion.transition;
  std::map<std::uint32_t, PromotedTree> views;
  for (const auto& [id, world] : snapshot_.physics.beforePromotions())
    snapshot_.offsets.addTo(id, duration, views[id] = world);
  snapshot_.offsets.prune(snapshot_.stamp, duration);
  for (const auto& [id, world] : snapshot_.physics.beforePromotions()) {
    const auto differences = [&, id = id, &world = world] {
      const Tree& tree = snapshot_.physics.subtrees().at(id).tree();
      std::vector<JointAngles> out = anglesIn(snapshot_.view, tree, id, views[id]);
      const auto base = anglesIn(snapshot_.world, tree, id, world);
      for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].first -= base[i].first;
        out[i].second -= base[i].second;
      }
      return out;
    };
    snapshot_.offsets.update(id, world, promoted(id), differences);
  }
}

// The displays' choice comes second and starts modes only if the world's has not, so that a tick
// computes modes once.
void Forest::chooseDetail(Nanoseconds before) {
  const Nanoseconds stamp = snapshot_.stamp;
  const Settings& settings = snapshot_.settings;
  const Bodies& bodies = snapshot_.physics.bodies();
  const double physical =
      1e-6 * settings.budget.physical_cost * static_cast<double>(snapshot_.physics.branchCount());
  const PredictionContext context{layout_, *terrain_, snapshot_.wind, settings, errors_, stamp};
  using Start = DetailChooser::Start;
  const Start due = ModalForest::fineDue(before, stamp) ? Start::ANY : Start::PLAIN;
  world_chooser_.choose(context, worldDemand(settings, bodies, snapshot_.sensors), physical, due,
                        snapshot_.world);
  view_chooser_.choose(context, viewDemand(settings, bodies, snapshot_.viewers), physical,
                       world_chooser_.started() ? Start::NONE : due, snapshot_.view);
}

// Returns the angles of all joints at the last tick.
std::vector<JointAngles> Forest::anglesIn(const TreeDetail& detail, const Tree& tree,
                                          std::uint32_t id, const PromotedTree& promoted) const {
  const Nanoseconds stamp = snapshot_.stamp;
  std::vector<JointAngles> out = modalAngles(tree, snapshot_.wind.at(stamp).relativeTo(tree.foot),
                                             weightsAt(detail.levels.of(id), stamp, layout_.motion),
                                             detail.modes.find(id), stamp);
  overlay(promoted, stamp, out);
  return out;
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

std::vector<Pose> Forest::poseInView(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
  const TreeDetail& view = snapshot_.view;
  return poseBranches(tree, snapshot_.wind.at(stamp).relativeTo(tree.foot),
                      weightsAt(view.levels.of(id), stamp, layout_.motion), view.modes.find(id),
                      promotedInView(id), stamp);
}

PromotedTree Forest::promotedInView(std::uint32_t tree) const {
  PromotedTree out = promoted(tree);
  snapshot_.offsets.addTo(tree, layout_.motion.transition, out);
  return out;
}

std::uint64_t Forest::hashOf(const ForestSnapshot& snapshot) const {
  Hash out;
  out.add(layout_hash_);
  out.add(snapshot.wind.hash());
  Settings settings = snapshot.settings;
  FieldHasher hasher(out);
  describe(hasher, settings);
  for (const auto& entry : snapshot.sensors) addTo(out, entry.second);
  snapshot.world.levels.addTo(out, snapshot.stamp, layout_.motion.transition);
  snapshot.world.modes.addTo(out);
  snapshot.physics.addTo(out);
  return out.value();
}

StateUpdate Forest::updateHead(bool key_frame) const {
  StateUpdate out;
  out.stamp = snapshot_.stamp;
  out.key_frame = key_frame;
  out.layout_hash = layout_hash_;
  out.wind_hash = snapshot_.wind.hash();
  out.hash = hash();
  out.blend = snapshot_.physics.settings().blend;
  return out;
}

StateUpdate Forest::update(bool key_frame) {
  StateUpdate out = updateHead(key_frame);
  snapshot_.world.addTo(out, physicalTrees(), [this](std::uint32_t id) { return promoted(id); });
  return out;
}

StateUpdate Forest::updateView(bool key_frame) {
  StateUpdate out = updateHead(key_frame);
  snapshot_.view.addTo(out, physicalTrees(),
                       [this](std::uint32_t id) { return promotedInView(id); });
  return out;
}

}  // namespace vegetation_sim::forest
