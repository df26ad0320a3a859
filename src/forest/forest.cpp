// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/forest.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

constexpr int MOST_NEW_MODES = 4;  // computed for trees that lose branches in one tick

}  // namespace

Forest::Forest(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain, Settings settings,
               const std::optional<Shard>& shard) {
  Faults faults;
  check(shard.value_or(Shard()), faults);
  faults.throwIfAny();
  shard_ = shard;
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
  for (TreeDetail* detail : details())
    detail->levels.anchor(snapshot_.stamp, layout_.motion.transition);
  layout_ = std::move(layout);
  layout_hash_ = layout_.hash();
  grid_ = TreeGrid(layout_);
  owners_ = TreeOwners(layout_, shard_.value_or(Shard()));
  terrain_ = std::move(terrain);
  errors_.measure(layout_, *terrain_, owners_);
  for (TreeDetail* detail : details()) {  // the wood may have changed
    detail->modes.clear();
    detail->request.reset();
  }
  worker_.clear();
  snapshot_.sensed.offsets.clear();
  snapshot_.view.offsets.clear();
  if (!same_trees)
    reset();
  else
    snapshot_.physics.clear();
}

void Forest::reset() {
  const int level = std::min(snapshot_.settings.fixed_level, snapshot_.settings.highest_level);
  snapshot_.world.reset(level);
  snapshot_.sensed.reset(level);
  snapshot_.view.reset(level);
  snapshot_.sensors.clear();
  snapshot_.viewers.clear();
  snapshot_.stamp = 0;
  snapshot_.physics.clear();
}

std::array<TreeDetail*, 3> Forest::details() {
  return {&snapshot_.world, &snapshot_.sensed.trees, &snapshot_.view.trees};
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
          owners_,
          shard_.has_value(),
          snapshot_.stamp};
}

void Forest::advance(Nanoseconds stamp) {
  const Nanoseconds before = snapshot_.stamp;
  advancePhysics(stamp);
  removeSilentSensors();
  chooseDetail(before);
  snapshot_.world.forgetChanges();  // no message contains the detail of the world
}

void Forest::removeSilentSensors() {
  auto& sensors = snapshot_.sensors;
  for (auto it = sensors.begin(); it != sensors.end();)
    it = snapshot_.stamp - it->second.stamp > SENSOR_LIFE ? sensors.erase(it) : std::next(it);
}

// Runs before the choice of levels: the present levels hold since the last tick.
void Forest::advancePhysics(Nanoseconds stamp) {
  const std::vector<std::uint32_t> physical = physicalTrees();
  for (ListenerDetail* listener : {&snapshot_.sensed, &snapshot_.view})
    listener->trees.changed.insert(physical.begin(), physical.end());
  for (TreeDetail* detail : details())
    detail->modes.advance(snapshot_.wind, snapshot_.stamp, stamp);
  snapshot_.physics.advance(stepContext(), stamp);
  snapshot_.stamp = stamp;
  loseBranches();
  updateOffsets(snapshot_.sensed);
  updateOffsets(snapshot_.view);
}

// Trees in modes swing on in those that they have now. Computing modes takes some milliseconds;
// trees for which there is no time start anew.
void Forest::loseBranches() {
  std::set<std::uint32_t> trees;
  for (const Break& broken : snapshot_.physics.breaks()) trees.insert(broken.tree);
  const ModalContext at{layout_, *terrain_, snapshot_.wind, &snapshot_.physics.broken()};
  int computed = 0;
  for (const std::uint32_t tree : trees) {
    const ModalTreeState* like = nullptr;
    for (TreeDetail* detail : details()) {
      const bool in_time = like || computed < MOST_NEW_MODES;
      const ModalTreeState* modes = detail->loseBranches(in_time ? &at : nullptr, tree, like);
      if (modes && !like) ++computed;
      if (modes) like = modes;
    }
  }
}

// Notes by how much the joints that a listener gets differ from those of the world where branches
// have become physical in this tick.
void Forest::updateOffsets(ListenerDetail& listener) {
  const double transition = layout_.motion.transition;
  for (const auto& [id, last] : snapshot_.physics.beforePromotions()) {
    const auto differences = [&, id = id, &last = last] {
      const Tree& tree = snapshot_.physics.subtrees().at(id).tree();
      PromotedTree there = last;
      listener.offsets.addTo(id, transition, there);
      std::vector<JointAngles> out = anglesIn(listener.trees, tree, id, there);
      const auto base = anglesIn(snapshot_.world, tree, id, last);
      for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].first -= base[i].first;
        out[i].second -= base[i].second;
      }
      return out;
    };
    listener.offsets.update(id, last, promoted(id), differences);
  }
  listener.offsets.prune(snapshot_.stamp, transition);
}

// Modes of one tree are computed per tick. Those of the world are shared with sensors, which thus
// have the world's poses exactly where they require no other detail.
void Forest::chooseDetail(Nanoseconds before) {
  const Nanoseconds stamp = snapshot_.stamp;
  const Settings& settings = snapshot_.settings;
  const Bodies& bodies = snapshot_.physics.bodies();
  const double physical =
      1e-6 * settings.budget.physical_cost * static_cast<double>(snapshot_.physics.branchCount());
  const PredictionContext context{
      layout_, *terrain_, snapshot_.wind, settings, errors_, stamp, &snapshot_.physics.broken()};
  DetailChooser::Start start{ModalForest::fineDue(before, stamp), true, nullptr, &worker_};
  world_chooser_.choose(context, worldDemand(settings, bodies), physical, start, snapshot_.world);
  start.compute = !world_chooser_.hasComputed();
  start.known = &snapshot_.world.modes;
  DetailDemand sensors = sensorDemand(settings, bodies, snapshot_.sensors);
  DetailDemand viewers = viewDemand(settings, bodies, snapshot_.viewers);
  sensors.most_changes = viewers.most_changes = changesWithin(before, stamp);
  sensor_chooser_.choose(context, sensors, physical, start, snapshot_.sensed.trees);
  start.compute = start.compute && !sensor_chooser_.hasComputed();
  start.known = nullptr;
  view_chooser_.choose(context, viewers, physical, start, snapshot_.view.trees);
  std::set<ModesWorker::Key> awaited;
  for (const DetailChooser* chooser : {&world_chooser_, &sensor_chooser_, &view_chooser_})
    awaited.insert(chooser->awaited().begin(), chooser->awaited().end());
  worker_.retain(awaited);
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
void Forest::cut(const BranchCut& cut) {
  snapshot_.physics.cut(stepContext(), cut);
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

std::vector<Pose> Forest::poseFor(const ListenerDetail& listener, const Tree& tree,
                                  std::uint32_t id, Nanoseconds stamp) const {
  const TreeDetail& detail = listener.trees;
  return poseBranches(tree, snapshot_.wind.at(stamp).relativeTo(tree.foot),
                      weightsAt(detail.levels.of(id), stamp, layout_.motion), detail.modes.find(id),
                      promotedFor(listener, id), stamp);
}

PromotedTree Forest::promotedFor(const ListenerDetail& listener, std::uint32_t tree) const {
  PromotedTree out = promoted(tree);
  listener.offsets.addTo(tree, layout_.motion.transition, out);
  return out;
}

StateUpdate Forest::updateFor(ListenerDetail& listener, bool key_frame) const {
  StateUpdate out;
  out.stamp = snapshot_.stamp;
  out.key_frame = key_frame;
  out.layout_hash = layout_hash_;
  out.wind_hash = snapshot_.wind.hash();
  out.hash = hash();
  if (shard_) out.trees_hash = treesHash();
  out.shard = shard().index;
  out.shards = shard().count;
  out.blend = snapshot_.physics.settings().blend;
  listener.trees.addTo(out, physicalTrees(), snapshot_.physics.broken(),
                       [&](std::uint32_t id) { return promotedFor(listener, id); });
  return out;
}

StateUpdate Forest::update(bool key_frame) {
  return updateFor(snapshot_.sensed, key_frame);
}

StateUpdate Forest::updateView(bool key_frame) {
  return updateFor(snapshot_.view, key_frame);
}

}  // namespace vegetation_sim::forest
