// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vegetation_sim/canopy/flow/fluid.h"
#include "vegetation_sim/canopy/flow/oscillator.h"
#include "vegetation_sim/canopy/leaf_motion.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim {
class Archive;
}

namespace vegetation_sim::canopy {

class PlantPusher;

/// The state of a canopy, to be saved, restored and hashed (N6).
struct CanopySnapshot {
  Nanoseconds stamp{0};  ///< stamp of the last tick; 0: none
  std::uint64_t ticks{0};
  FluidState fluid;
  OscillatorState oscillator;
  History history{SMALLEST_FIELD, 2};
  Driver driver;
  CutState cuts;
  bool has_cuts{false};  ///< layers have been cut
  PushState push;
  /// Hash without the cuts and the driver of the front layer: they depend on the viewer, who
  /// changes nothing that sensors and bodies meet.
  std::uint64_t hash() const;
};

/// Update that lets a replica move every leaf as the animator does.
struct StateUpdate {
  Nanoseconds stamp{0};
  std::uint64_t sequence{0};  ///< number of ticks before this one
  MotionFrame frame;
  double front_share{1.0};
  CutState cuts;
  std::vector<BentCell> bent;      ///< all cells that lean
  std::optional<Stubble> stubble;  ///< all plants that have been cut; without a value: as before
  std::uint64_t layout_hash{0}, wind_hash{0};
  std::uint64_t hash{0};  ///< hash of the sender's state; 0: not computed
};

/// A piece that has come off a plant.
struct CutPiece {
  std::uint32_t plant{0};
  double length{0.0};  ///< from the cut to the top that the plant had [m]
};

/// Wind and leaves in the plane, tick by tick, and the layers that move with them (paper 3); and
/// plants that bodies push and tools cut. The core without ROS: time, wind, viewer and bodies are
/// inputs.
class Canopy {
 public:
  /// @throws InvalidInput with all faults of the layout.
  explicit Canopy(const Layout& layout);
  ~Canopy();
  Canopy(const Canopy&) = delete;  // Not copyable, since the foliage refers to the layout.
  Canopy& operator=(const Canopy&) = delete;

  const Layout& layout() const { return layout_; }
  std::uint64_t layoutHash() const { return layout_hash_; }
  void setWind(const wind::Field& wind) { wind_ = wind; }
  const wind::Field& windLaw() const { return wind_; }
  std::uint64_t windHash() const { return wind_.hash(); }  ///< hash of the wind field
  /// Sets the viewpoint that layers are cut for (S3-W8); without one it is that of the simulation
  /// plane.
  void setViewer(const std::optional<CutView>& viewer) { viewer_ = viewer; }
  const std::optional<CutView>& viewer() const { return viewer_; }
  /// Sets crowns that hang in the layers beside the plants. The state does not depend on them.
  void setCrowns(std::vector<LeafBox> crowns);

  /// Adds or moves a body that pushes plants from the next tick on. @throws InvalidInput for
  /// invalid numbers, and for one more than MOST_PUSHING.
  void setBody(const forest::Body& body);
  /// @throws InvalidInput for an unknown id.
  void removeBody(const std::string& id);
  const forest::Bodies& bodies() const { return memory_.push.bodies; }
  /// Returns whether a body may touch a plant soon.
  bool isNear(const forest::Body& body) const;
  /// Returns the forces of plants on bodies at the last tick.
  const std::vector<PushForce>& pushForces() const { return push_forces_; }
  /// Returns the number of times that a plant did not lean because too many cells do.
  std::uint64_t refusedPushes() const;

  /// Returns whether a plant of the layout is higher than this above its foot [m]. A trellis cannot
  /// be cut.
  bool canCut(std::uint32_t plant, double height) const;
  /// Cuts those plants that can be cut at a height. The lowest cut counts, and nothing grows again.
  /// Returns the pieces in the order of the plants. @throws InvalidInput for unknown plants and a
  /// height outside CUT_HEIGHTS.
  std::vector<CutPiece> cut(const std::vector<std::uint32_t>& plants, double height);

  /// Replaces the settings of sources, leaves, layers and warp from the next tick on. @throws
  /// InvalidInput for faults, and for another plane, grid, rate, memory or integrator, which need a
  /// fresh start. Nothing has changed then.
  void setMotion(const Motion& motion);

  /// Advances by one tick. A stamp that is not later does nothing; a gap of more than LONGEST_GAP
  /// is skipped.
  void advance(Nanoseconds stamp);
  /// Starts again with the present layout, wind and viewer.
  void reset();

  const CanopySnapshot& snapshot() const { return memory_; }
  /// @throws InvalidInput for the state of another layout, or if a value is not finite.
  void restore(const CanopySnapshot& memory);
  /// The snapshot as bytes, with wind and viewer, and back with all stamps moved by `shift`.
  /// Reading needs the same layout.
  /// @throws InvalidInput for bytes that are no state of this layout.
  struct Archived {
    CanopySnapshot snapshot;
    wind::Field wind;
    std::optional<CutView> viewer;
  };
  std::string archived() const;
  Archived readArchived(std::string bytes, Nanoseconds shift = 0) const;
  /// @param hashed adds the hash of the state, which costs as much as a tick. @param with_stubble
  /// adds the plants that have been cut.
  StateUpdate update(bool hashed, bool with_stubble = true) const;

  /// Returns the layers of the last tick.
  const Foliage& foliage();
  /// Returns the wind on the plane at a stamp.
  PlaneAir airAt(Nanoseconds stamp) const;
  const PlaneField& wind() const { return fluid_.state().flow; }
  const Oscillator& oscillator() const { return oscillator_; }
  const FluidFigures& figures() const { return fluid_.figures(); }

  static constexpr double LONGEST_GAP = 10.0;  ///< [s]

 private:
  void archive(Archive& a, Archived& state) const;
  void step(Nanoseconds stamp, double dt);
  void updateCuts(Nanoseconds stamp);
  CutView view() const;

  Layout layout_;
  std::uint64_t layout_hash_;
  Plane plane_;
  Fluid fluid_;
  Oscillator oscillator_;
  CanopySnapshot memory_;  // between ticks, fluid and oscillator hold their own parts of it
  wind::Field wind_;
  std::optional<CutView> viewer_;
  Foliage foliage_;
  std::unique_ptr<PlantPusher> pusher_;
  std::vector<PushForce> push_forces_;
  bool stale_{true};
};

/// Computes the same layers from messages. It is exact after as many messages in a row as the
/// history has frames.
class Replica {
 public:
  /// @throws InvalidInput with all faults of the layout.
  explicit Replica(const Layout& layout);
  Replica(const Replica&) = delete;
  Replica& operator=(const Replica&) = delete;

  const Layout& layout() const { return layout_; }
  /// @throws InvalidInput for another layout or size; nothing has changed then.
  void apply(const StateUpdate& update);
  /// Returns whether the whole history and the plants that have been cut have been received.
  bool exact() const { return received_ >= history_.frames() && knows_stubble_; }
  /// Sets the crowns; the same crowns as the animator's give the same layers.
  void setCrowns(std::vector<LeafBox> crowns);
  const Foliage& foliage();
  /// Returns the layers of the plants as the simulation plane's own view cuts them, driven by the
  /// front. They do not depend on viewers, so sensors perceive the same with and without them.
  const Foliage& foliageOfPlane();
  std::uint64_t layoutHash() const { return layout_hash_; }
  /// Returns the height at which a plant has been cut, or UNCUT [m].
  double cutHeight(std::size_t plant) const { return foliage_.cutHeight(plant); }

 private:
  Layout layout_;
  std::uint64_t layout_hash_;
  History history_;
  StateUpdate last_;
  Stubble stubble_;
  bool knows_stubble_{false};
  int received_{0};
  Foliage foliage_, plane_foliage_;
  bool stale_{true}, plane_stale_{true};
};

}  // namespace vegetation_sim::canopy
