// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "forest/physics/forest_physics.h"
#include "tree/lod/level_table.h"
#include "tree/lod/tree_tiers.h"
#include "vegetation_sim/tree/state/level_map.h"
#include "vegetation_sim/tree/state/viewer.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// Settings that can change at run time.
struct Settings {
  double tolerance{1.0};  ///< error that a viewer may see [pixel]
  int fixed_level{2};     ///< of every tree while there are no viewers
  int highest_level{MAX_DEPTHS};
  double robot_tolerance{0.05};  ///< error near the bodies of robots [m]
  double robot_range{3.0};       ///< distance to a body within which robot_tolerance holds [m]
  Budget budget;
};
void describe(FieldVisitor& visitor, Settings& settings);

/// The complete state of a forest: copy it to save, assign it to restore (N6). What follows has the
/// same bits, messages included.
struct ForestSnapshot {
  Nanoseconds stamp{0};
  Settings settings;
  wind::Field wind;
  std::map<std::string, Viewer> viewers;
  LevelMap levels;
  ModalForest modes;
  ForestPhysics physics;
  std::set<std::uint32_t> changed;  ///< trees of the next update
  std::set<std::uint32_t>
      begun;                  ///< of these, trees with new modes; the update has their amplitudes
  std::uint32_t sequence{0};  ///< of the next update
};

/// The animated forest. Inputs take effect at the next tick; between ticks it does not change, and
/// the poses of any stamp follow from layout, wind and levels. Not thread-safe.
class Forest {
 public:
  /// @throws InvalidInput for a layout that check() refuses.
  Forest(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain, Settings settings);

  const Layout& layout() const { return layout_; }
  std::uint64_t layoutHash() const { return layout_hash_; }
  const terrain::HeightMap& terrain() const { return *terrain_; }
  const ForestSnapshot& snapshot() const { return snapshot_; }

  void setWind(const wind::Field& wind) { snapshot_.wind = wind; }
  void setViewer(const Viewer& viewer) { snapshot_.viewers[viewer.id] = viewer; }
  void setSettings(const Settings& settings) { snapshot_.settings = settings; }
  /// Replaces the layout. Levels restart if the number of trees changes.
  void setLayout(Layout layout, std::shared_ptr<const terrain::HeightMap> terrain);
  void restore(ForestSnapshot memory) { snapshot_ = std::move(memory); }
  /// Computes the response errors of all species now, some 30 ms for each of a few sizes, instead
  /// of at the first tick with a viewer nearby.
  void precompute();
  /// Resets the state; keeps layout, wind and settings.
  void reset();

  /// Advances one tick: steps physics and modes, then chooses the tier of every tree from wind,
  /// viewers and tolerance.
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
  /// Grabs whose lease ran out at the last tick.
  const std::vector<Grab>& ended() const { return snapshot_.physics.ended(); }
  /// Reactions on bodies that hold or touch branches, at the end of the last tick.
  const std::vector<Reaction>& reactions() const { return snapshot_.physics.reactions(); }
  PhysicsFigures physicsFigures() const;
  /// Returns the physical joints of a tree at the last tick; `branches` is empty if there are none.
  PromotedTree promoted(std::uint32_t tree) const;
  /// Returns the ids of the trees with physical joints, sorted.
  std::vector<std::uint32_t> physicalTrees() const;
  /// Returns the modal state of a tree, or nullptr if it has none.
  const ModalTreeState* modalState(std::uint32_t tree) const { return snapshot_.modes.find(tree); }
  /// Figures of the tier allocation at the last tick.
  const GovernorFigures& governor() const { return governor_; }
  /// The trees of that allocation with their predicted errors; empty if there are very many.
  const std::vector<Plant>& plants() const { return plants_; }
  /// Returns the pose of every branch in the tree's frame, physical joints and modes included, in
  /// double precision.
  std::vector<Pose> pose(const Tree& tree, std::uint32_t id, Nanoseconds stamp) const;

  /// Returns the complete state, or the changes since the last update of either kind.
  StateUpdate update(bool key_frame);
  /// Returns a hash of all state that determines the future, viewers included, but not the numbers
  /// of updates, so that late subscribers compute the same.
  std::uint64_t hash() const;

 private:
  struct Region {
    Vec3 centre;
    double reach;  // [m] around the centre, including the reach of trees
    std::uint32_t first, count;
  };
  StepContext stepContext() const;
  void advancePhysics(Nanoseconds stamp);
  /// Calls `visit` for the sizes of all trees; for tiles, for the range of their sizes.
  void forEachSize(const std::function<void(std::size_t species, double scale)>& look) const;
  void measure();
  void measureSpecies(std::size_t species, double scale);
  double bendingSpeed(double speed, double reference_speed) const;
  double pixelsPerMetreAt(const Vec3& centre, double reach) const;
  void chooseLevels();
  void chooseRegion(const Region& region);
  void chooseTree(std::uint32_t tree);
  void predict(const TreeSeed& seed, const LevelTable& table, double view, Plant& plant);
  void requestModes(const PredictedError& off, Plant& plant) const;
  PredictedError responseErrorOf(const TreeSeed& seed, const wind::GustSpectrum& spectrum,
                                 double bending, double pixels);
  bool haveModes() const;
  void applyTiers();
  void startModes();
  void setTreeLevel(std::uint32_t tree, int level);

  Layout layout_;
  std::uint64_t layout_hash_{0};
  std::shared_ptr<const terrain::HeightMap> terrain_;
  TreeGrid grid_;
  std::vector<LevelScales> tables_;  // per species
  double extent_{0.0};               // height plus reach of the largest tree [m]
  double largest_omission_{0.0};     // of any tree with all joints fixed [m per m/s]
  double slowest_reference_{1.0};    // reference speed of any species [m/s]
  std::vector<Region> regions_;
  std::shared_ptr<const ContactFinder> contacts_{std::make_shared<ContactFinder>()};
  std::shared_ptr<ThreadPool> threads_{std::make_shared<ThreadPool>()};
  ForestSnapshot snapshot_;
  wind::Instant now_;
  wind::GustSpectrumField swinging_;  // now
  bool fine_due_{false};              // one tree may get fine modes in this tick
  int last_base_{0};                  // level of the trees that were not held before this tick
  std::vector<Plant> plants_;
  GovernorFigures governor_;
};

}  // namespace vegetation_sim::forest
