// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vegetation_sim/canopy/flow/fluid.h"
#include "vegetation_sim/canopy/flow/oscillator.h"
#include "vegetation_sim/canopy/leaf_motion.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::canopy {

/// All that a canopy remembers: one structure that can be kept, restored and hashed (N6).
struct CanopySnapshot {
  Nanoseconds stamp{0};  ///< of the last tick; 0: none yet
  std::uint64_t ticks{0};
  FluidState fluid;
  OscillatorState oscillator;
  History history{SMALLEST_FIELD, 2};
  Driver driver;
  CutState cuts;
  bool looked{false};  ///< whether layers have been cut
  std::uint64_t hash() const;
};

/// What others need of one tick to move every leaf as the animator does.
struct StateUpdate {
  Nanoseconds stamp{0};
  std::uint64_t sequence{0};  ///< ticks before this one
  MotionFrame frame;
  double front_share{1.0};
  CutState cuts;
  std::uint64_t layout_hash{0}, wind_hash{0};
  std::uint64_t hash{0};  ///< of the sender's memory; 0: not told
};

/// Wind and leaves in the plane, tick by tick, and the layers that they carry (paper 3). Knows
/// nothing of ROS: time, wind and viewer are handed in.
class Canopy {
 public:
  /// @throws InvalidInput with all faults of the layout.
  explicit Canopy(const Layout& layout);
  Canopy(const Canopy&) = delete;  // the foliage looks at the layout
  Canopy& operator=(const Canopy&) = delete;

  const Layout& layout() const { return layout_; }
  std::uint64_t layoutHash() const { return layout_hash_; }
  void setWind(const wind::Field& wind) { wind_ = wind; }
  std::uint64_t windHash() const { return wind_.hash(); }  ///< of what blows
  /// The only eye that layers are cut for (S3-W8); none: that of the simulation plane.
  void setViewer(const std::optional<CutView>& viewer) { viewer_ = viewer; }
  /// Crowns that hang in the layers beside the plants; nothing that is remembered depends on them.
  void setCrowns(std::vector<LeafBox> crowns);

  /// Other sources, leaves, layers and warp from the next tick on; what moves goes on moving.
  /// @throws InvalidInput for faults, or another plane, grid, rate, memory or integrator: those
  /// need a fresh start. Nothing has changed then.
  void setMotion(const Motion& motion);

  /// One tick. Time that does not go on does nothing; a gap of more than LONGEST_GAP is not stepped
  /// through.
  void advance(Nanoseconds stamp);
  /// As fresh, with layout, wind and viewer as they are.
  void reset();

  const CanopySnapshot& snapshot() const { return memory_; }
  /// @throws InvalidInput for a memory of another layout, or what is no number.
  void restore(const CanopySnapshot& memory);
  /// @param hashed with the memory's hash, which costs as much as a tick.
  StateUpdate update(bool hashed) const;

  /// Layers of the last tick.
  const Foliage& foliage();
  /// The wind law on the plane at a stamp.
  PlaneAir airAt(Nanoseconds stamp) const;
  const PlaneField& wind() const { return fluid_.state().flow; }
  const Oscillator& oscillator() const { return oscillator_; }
  const FluidFigures& figures() const { return fluid_.figures(); }

  static constexpr double LONGEST_GAP = 10.0;  ///< [s]

 private:
  void step(Nanoseconds stamp, double dt);
  void look(Nanoseconds stamp);
  CutView view() const;

  Layout layout_;
  std::uint64_t layout_hash_;
  Plane plane_;
  Fluid fluid_;
  Oscillator oscillator_;
  CanopySnapshot memory_;  // fluid and oscillator hold their own parts between ticks
  wind::Field wind_;
  std::optional<CutView> viewer_;
  Foliage foliage_;
  bool stale_{true};
};

/// The same layers from messages. Exact once it has heard as many in a row as the history is long.
class Replica {
 public:
  /// @throws InvalidInput with all faults of the layout.
  explicit Replica(const Layout& layout);
  Replica(const Replica&) = delete;
  Replica& operator=(const Replica&) = delete;

  const Layout& layout() const { return layout_; }
  /// @throws InvalidInput for another layout or size; nothing has changed then.
  void apply(const StateUpdate& update);
  /// Whether the whole history has been heard.
  bool exact() const { return heard_ >= history_.frames(); }
  /// The same crowns as the animator's give the same layers.
  void setCrowns(std::vector<LeafBox> crowns);
  const Foliage& foliage();

 private:
  Layout layout_;
  std::uint64_t layout_hash_;
  History history_;
  StateUpdate last_;
  int heard_{0};
  Foliage foliage_;
  bool stale_{true};
};

}  // namespace vegetation_sim::canopy
