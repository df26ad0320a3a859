// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "forest/detail/detail_chooser.h"
#include "forest/detail/listener_detail.h"
#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {

/// The complete state of a forest: copy it to save, assign it to restore (N6). What follows has the
/// same bits, messages included.
struct ForestSnapshot {
  Nanoseconds stamp{0};
  Settings settings;
  wind::Field wind;
  TreeDetail world;
  ForestPhysics physics;
  // For listeners only, and in no hash:
  std::map<std::string, Sensor> sensors;
  std::vector<Viewpoint> viewers;
  ListenerDetail sensed, view;
};

/// The animated forest. Inputs take effect at the next tick; between ticks it does not change, and
/// the poses of any stamp follow from layout, wind and levels. Trees have three details: that of
/// the world, which physics and the hash know, that which sensors perceive and that which displays
/// draw. The last two affect nothing else. Not thread-safe.
///
/// A forest of a shard animates its own trees. Those of other shards stay at the base level, never
/// become physical and have no modes; requests for them throw InvalidInput that names tree and
/// owner. All shards get the same layout, wind, settings, bodies and listeners; each tree then has
/// the same bits as in the only shard of a count of 1, as long as no limit binds that the trees of
/// a forest share: Budget and PhysicsSettings::most_branches, the numbers of grabs, pushes and
/// cuts, and that modes start for one tree per tick. These limits apply to each shard.
///
/// In a shard, each tree has its own times at which its physical branches are reviewed. In a forest
/// without one, a grab, a push or a break of any tree restarts the reviews of all.
class Forest {
 public:
  /// @throws InvalidInput for a layout or a shard that check() refuses.
  Forest(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain, Settings settings,
         const std::optional<Shard>& shard = {});

  const Layout& layout() const { return layout_; }
  std::uint64_t layoutHash() const { return layout_hash_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  const ForestSnapshot& snapshot() const { return snapshot_; }
  const TreeGrid& grid() const { return grid_; }
  /// Returns the shard; the only one if the forest is not a shard.
  const Shard& shard() const { return owners_.shard(); }
  const TreeOwners& owners() const { return owners_; }

  void setWind(const wind::Field& wind) { snapshot_.wind = wind; }
  void setSensor(const Sensor& sensor) { snapshot_.sensors[sensor.id] = sensor; }
  void setViewers(std::vector<Viewpoint> viewers) { snapshot_.viewers = std::move(viewers); }
  void setSettings(const Settings& settings) { snapshot_.settings = settings; }
  /// Replaces the layout. Levels restart if the number of trees changes.
  void setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain);
  void restore(ForestSnapshot memory) { snapshot_ = std::move(memory); }
  /// The snapshot as bytes, and back with all stamps moved by `shift`. Reading needs the same
  /// layout and terrain. @throws InvalidInput for bytes that are no state of this layout and shard.
  std::string archived() const;
  ForestSnapshot readArchived(std::string bytes, Nanoseconds shift = 0) const;
  /// Computes now what the first tick with a listener nearby would otherwise compute.
  void precompute() { errors_.precompute(layout_); }
  /// Resets the state and makes broken trees whole; keeps layout, wind and settings.
  void reset();

  /// Advances one tick: steps physics and modes, then chooses the tiers of every tree from wind,
  /// listeners and their tolerances.
  void advance(Nanoseconds stamp);

  // Inputs of physics. All throw InvalidInput that names field, value and range, and then change
  // nothing.
  /// Adds a grab and returns its id.
  std::uint32_t addGrab(const Grab& grab);
  /// Sets the target of a grab at the next tick; renews its lease.
  void moveGrab(std::uint32_t id, const Vec3& target, const Pose& holder = {});
  void renewGrab(std::uint32_t id);
  void release(std::uint32_t id);
  void push(const Push& push);
  void cut(const BranchCut& cut);
  void setBody(const Body& body);
  void removeBody(const std::string& id);
  void setPhysics(const PhysicsSettings& settings);
  /// Sets the number of threads that step physical trees. It changes no result.
  void setThreads(int threads) { threads_ = std::make_shared<ThreadPool>(threads); }
  /// Replaces the finder of contacts by one that reports intermediate results.
  void setContactFinder(std::shared_ptr<const ContactFinder> finder) {
    contacts_ = std::move(finder);
  }

  const PhysicsSettings& physicsSettings() const { return snapshot_.physics.settings(); }
  const HeldGrabs& grabs() const { return snapshot_.physics.grabs(); }
  const Bodies& bodies() const { return snapshot_.physics.bodies(); }
  /// Grabs that ended at the last tick by their lease or with their branch.
  const std::vector<EndedGrab>& ended() const { return snapshot_.physics.ended(); }
  /// Returns the branches that have come off the trees, and those that did so at the last tick.
  const BrokenTrees& broken() const { return snapshot_.physics.broken(); }
  const std::vector<Break>& breaks() const { return snapshot_.physics.breaks(); }
  /// Reactions on bodies that hold or touch branches, at the end of the last tick.
  const std::vector<Reaction>& reactions() const { return snapshot_.physics.reactions(); }
  PhysicsFigures physicsFigures() const;
  /// Returns the physical joints of a tree at the last tick; `branches` is empty if there are none.
  PromotedTree promoted(std::uint32_t tree) const;
  /// Returns the ids of the trees with physical joints, sorted.
  std::vector<std::uint32_t> physicalTrees() const;
  /// The detail of the world, that which sensors perceive, and that which displays draw.
  const TreeDetail& world() const { return snapshot_.world; }
  const TreeDetail& sensed() const { return snapshot_.sensed.trees; }
  const TreeDetail& view() const { return snapshot_.view.trees; }
  /// The choices of the last tick.
  const DetailChooser& worldChoice() const { return world_chooser_; }
  const DetailChooser& sensorChoice() const { return sensor_chooser_; }
  const DetailChooser& viewChoice() const { return view_chooser_; }
  /// Returns the pose of every branch of the world's tree in its frame, physical joints and modes
  /// included, in double precision.
  std::vector<Pose> pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const;
  /// Returns the pose as sensors perceive it.
  std::vector<Pose> poseForSensors(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
    return poseFor(snapshot_.sensed, tree, id, stamp);
  }
  /// Returns the pose as displays draw it.
  std::vector<Pose> poseInView(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const {
    return poseFor(snapshot_.view, tree, id, stamp);
  }

  /// Returns the complete state for sensors, or the changes since the last update of either kind.
  StateUpdate update(bool key_frame);
  /// Returns the same for displays.
  StateUpdate updateView(bool key_frame);
  /// Returns a hash of all state that determines the future of the world. Listeners are not in it,
  /// nor the numbers of updates.
  std::uint64_t hash() const { return hashOf(snapshot_); }
  std::uint64_t hashOf(const ForestSnapshot& snapshot) const;
  /// Returns the sum modulo 2^64 of a hash of each tree that has state of its own: level, modes,
  /// physical joints, grabs, pushes, cuts, contacts and what has come off. It depends neither on
  /// the order of the trees nor on ids of grabs, so that the sums of all shards add up to that of
  /// one forest with all trees. Layout, wind, settings and bodies are not in it.
  std::uint64_t treesHash() const;

 private:
  std::array<TreeDetail*, 3> details();
  StepContext stepContext() const;
  void advancePhysics(Nanoseconds stamp);
  void loseBranches();
  void updateOffsets(ListenerDetail& listener);
  void removeSilentSensors();
  void chooseDetail(Nanoseconds before);
  std::vector<JointAngles> anglesIn(const TreeDetail& detail, const Tree& tree, std::uint32_t id,
                                    const PromotedTree& promoted) const;
  std::vector<Pose> poseFor(const ListenerDetail& listener, const Tree& tree, std::uint32_t id,
                            Nanoseconds stamp) const;
  PromotedTree promotedFor(const ListenerDetail& listener, std::uint32_t tree) const;
  StateUpdate updateFor(ListenerDetail& listener, bool key_frame) const;

  std::optional<Shard> shard_;
  Layout layout_;
  std::uint64_t layout_hash_{0};
  std::shared_ptr<const terrain::HeightMap> terrain_;
  TreeGrid grid_;
  TreeOwners owners_;
  TreeErrors errors_;
  std::shared_ptr<const ContactFinder> contacts_{std::make_shared<ContactFinder>()};
  std::shared_ptr<ThreadPool> threads_{std::make_shared<ThreadPool>()};
  ModesWorker worker_;
  ForestSnapshot snapshot_;
  DetailChooser world_chooser_, sensor_chooser_, view_chooser_;
};

}  // namespace vegetation_sim::forest
